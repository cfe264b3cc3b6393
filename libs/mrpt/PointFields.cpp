#include "mrpt/PointFields.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/Text.h"

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

/// Whether times are shares of a scan, as some programs normalise them.
bool areShares(const PointField& field, double first, double last) {
    constexpr double kMinSpan = 0.9;
    const bool is_real = field.type >= NumberType::Float32;
    return is_real && first >= 0 && last <= 1 && last - first > kMinSpan;
}

/// The times of a counter of 32 bits that overflows during a scan.
void unwrap(const PointField& field, std::vector<double>& times) {
    constexpr double kHalf = 2147483648.0;
    if (field.type != NumberType::UInt32) return;
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    if (*last - *first <= kHalf) return;
    for (double& time : times) time += time < kHalf ? 2 * kHalf : 0;
}

const PointField* ringFieldOf(const PointTable& table) {
    return findField(table, {"ring", "channel", "line"});
}

}  // namespace

PointFieldValues<std::int32_t> ringsOf(const PointTable& table,
                                       const std::vector<std::uint32_t>& points) {
    PointFieldValues<std::int32_t> rings;
    const PointField* const field = ringFieldOf(table);
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

const PointField* intensityFieldOf(const PointTable& table) {
    return findField(table, {"intensity", "i", "reflectivity", "remission"});
}

std::vector<std::string> remarksOnLookAlikes(const PointTable& table) {
    struct Role {
        const PointField* field;
        const char* name;
        const char* what;
        std::vector<const char*> parts;  ///< of names
    };
    const Role roles[] = {
        {ringFieldOf(table), "ring", "beam numbers", {"ring", "laser", "channel", "beam", "line"}},
        {timeFieldOf(table), "time", "times", {"time", "stamp"}},
        {intensityFieldOf(table), "intensity", "intensities", {"intens", "reflect", "ampl"}}};
    std::vector<std::string> remarks;
    for (const Role& role : roles) {
        const bool are_beams = &role == roles;
        for (const PointField& field : table.fields) {
            const std::string name = base::lowerCase(field.name);
            const bool is_like =
                std::any_of(role.parts.begin(), role.parts.end(),
                            [&](const char* part) { return name.find(part) != std::string::npos; });
            if (role.field != nullptr || !is_like) continue;
            constexpr std::size_t kMinValues = 5;  // flags and return numbers have fewer
            std::set<double> values;
            bool are_whole = true;
            for (const double number : columnOf(table, field)) {
                if (!std::isfinite(number)) continue;
                are_whole &= number >= 0 && number <= kMaxRing && number == std::floor(number);
                if (values.size() < kMinValues) values.insert(number);
            }
            if (values.size() < kMinValues || (are_beams && !are_whole)) continue;
            remarks.push_back("the field '" + field.name + "' may contain " + role.what +
                              ", but is not used; rename it to '" + role.name + "'");
        }
    }
    return remarks;
}

PointFieldValues<float> timesOf(const PointTable& table, const std::vector<std::uint32_t>& points,
                                double period_s) {
    PointFieldValues<float> found;
    const PointField* const field = timeFieldOf(table);
    if (field == nullptr || points.empty()) return found;
    std::vector<double> times = columnOf(table, *field, points);
    unwrap(*field, times);
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    const bool are_finite =
        std::all_of(times.begin(), times.end(), [](double time) { return std::isfinite(time); });
    if (!are_finite) {
        found.remark = "the field '" + field->name + "' is not used: some times are not finite";
        return found;
    }
    double unit_s = timeUnit(table, *field, *last - *first);
    if (areShares(*field, *first, *last)) {
        constexpr double kMinPeriod_s = 0.04, kMaxPeriod_s = 0.25;
        if (period_s > kMinPeriod_s && period_s < kMaxPeriod_s) {
            unit_s = period_s;
        } else if (period_s < kMaxPeriod_s) {
            found.remark = "the field '" + field->name +
                           "' spans 0 to 1: read as seconds; if these are shares of a scan, "
                           "multiply them by its duration";
        }
    }
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
