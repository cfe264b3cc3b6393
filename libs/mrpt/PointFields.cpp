#include "mrpt/PointFields.h"

#include <algorithm>
#include <cmath>

namespace hagen::observations {
namespace {

constexpr double kMaxSpan_s = 2.0;
constexpr std::int32_t kMaxRing = 65535;

/// Guesses the unit [s] of times with this span.
double timeUnit(const PointTable& table, const PointField& field, double span) {
    if (&field == findField(table, {"gps_time", "gpstime"})) return 1.0;
    const bool is_integer = field.type < NumberType::Float32;
    if (is_integer) return span > 0 && span < 1e6 ? 1e-6 : 1e-9;
    for (const double unit : {1.0, 1e-3, 1e-6}) {
        if (span * unit <= kMaxSpan_s) return unit;
    }
    return 1e-9;
}

}  // namespace

PointFieldValues<std::int32_t> ringsOf(const PointTable& table,
                                       const std::vector<std::uint32_t>& points) {
    PointFieldValues<std::int32_t> rings;
    const PointField* const field = findField(table, {"ring", "channel", "line"});
    if (field == nullptr) return rings;
    for (const double ring : columnOf(table, *field, points)) {
        if (!(ring >= 0 && ring <= kMaxRing) || ring != std::floor(ring)) {
            rings.remark =
                "the field '" + field->name + "' is not used: some values are not beam numbers";
            rings.values.clear();
            return rings;
        }
        rings.values.push_back(static_cast<std::int32_t>(ring));
    }
    rings.field = field->name;
    return rings;
}

const PointField* timeFieldOf(const PointTable& table) {
    return findField(table, {"time", "t", "timestamp", "time_stamp", "offset_time", "time_offset",
                             "gps_time", "gpstime"});
}

PointFieldValues<float> timesOf(const PointTable& table, const std::vector<std::uint32_t>& points) {
    PointFieldValues<float> found;
    const PointField* const field = timeFieldOf(table);
    if (field == nullptr || points.empty()) return found;
    const std::vector<double> times = columnOf(table, *field, points);
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    const bool are_finite =
        std::all_of(times.begin(), times.end(), [](double time) { return std::isfinite(time); });
    if (!are_finite) {
        found.remark = "the field '" + field->name + "' is not used: some times are not finite";
        return found;
    }
    const double unit_s = timeUnit(table, *field, *last - *first);
    if ((*last - *first) * unit_s > kMaxSpan_s) {
        found.remark = "the field '" + field->name + "' is not used: the times span more than 2 s";
        return found;
    }
    const bool is_relative = std::max(std::abs(*first), std::abs(*last)) * unit_s <= kMaxSpan_s;
    const double start = is_relative ? 0.0 : *first;
    found.values.reserve(times.size());
    for (const double time : times) {
        found.values.push_back(static_cast<float>((time - start) * unit_s));
    }
    found.field = field->name;
    return found;
}

}  // namespace hagen::observations
