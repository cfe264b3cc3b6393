#include <hagen/mrpt/PointFields.h>

#include <algorithm>
#include <cmath>

namespace hagen::observations {
namespace {

constexpr double kLongestScan_s = 2.0;
constexpr std::int32_t kHighestRing = 65535;

bool isInteger(NumberType type) {
    return type != NumberType::Float32 && type != NumberType::Float64;
}

/// The unit of times that are `span` apart [s].
double timeUnit(const PointField& field, const std::string& lower_name, double span) {
    if (lower_name == "gps_time" || lower_name == "gpstime") return 1.0;
    if (isInteger(field.type)) return span > 0 && span < 1e6 ? 1e-6 : 1e-9;
    for (const double unit : {1.0, 1e-3, 1e-6}) {
        if (span * unit <= kLongestScan_s) return unit;
    }
    return 1e-9;
}

std::string lowerCase(std::string text) {
    for (char& letter : text) {
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    }
    return text;
}

std::vector<double> ofPoints(const PointTable& table, const PointField& field,
                             const std::vector<std::uint32_t>& points) {
    const std::vector<double> all = columnOf(table, field);
    std::vector<double> numbers;
    numbers.reserve(points.size());
    for (const std::uint32_t i : points) numbers.push_back(all[i]);
    return numbers;
}

}  // namespace

PointFieldValues<std::int32_t> ringsOf(const PointTable& table,
                                       const std::vector<std::uint32_t>& points) {
    PointFieldValues<std::int32_t> rings;
    const PointField* const field = findField(table, {"ring", "channel", "line"});
    if (field == nullptr) return rings;
    for (const double ring : ofPoints(table, *field, points)) {
        if (!(ring >= 0 && ring <= kHighestRing) || ring != std::floor(ring)) {
            rings.remark =
                "the field '" + field->name + "' is not a number of a beam, and is not used";
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
    const std::vector<double> times = ofPoints(table, *field, points);
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    const bool are_finite =
        std::all_of(times.begin(), times.end(), [](double time) { return std::isfinite(time); });
    if (!are_finite) {
        found.remark =
            "the field '" + field->name + "' has times that are not finite, and is not used";
        return found;
    }
    const double unit_s = timeUnit(*field, lowerCase(field->name), *last - *first);
    if ((*last - *first) * unit_s > kLongestScan_s) {
        found.remark = "the times of its points, in '" + field->name +
                       "', span more than 2 s: they are not used";
        return found;
    }
    const bool is_relative = std::max(std::abs(*first), std::abs(*last)) * unit_s <= kLongestScan_s;
    const double start = is_relative ? 0.0 : *first;
    found.values.reserve(times.size());
    for (const double time : times) {
        found.values.push_back(static_cast<float>((time - start) * unit_s));
    }
    found.field = field->name;
    return found;
}

}  // namespace hagen::observations
