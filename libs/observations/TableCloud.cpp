#include <hagen/observations/MrptCompat.h>
#include <hagen/observations/TableCloud.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace hagen::observations {
namespace {

constexpr double kLongestScan_s = 2.0;
constexpr double kFarthest_m = 1000.0;  // of any sensor
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

}  // namespace

TableCloud::TableCloud(std::shared_ptr<const PointTable> table) : table_(std::move(table)) {
    check(*table_);
    if (table_->points > std::numeric_limits<std::uint32_t>::max()) {
        throw std::runtime_error("it has more points than 32 bits can number");
    }
    const PointField* const x = findField(*table_, {"x"});
    const PointField* const y = findField(*table_, {"y"});
    const PointField* const z = findField(*table_, {"z"});
    if (x == nullptr || y == nullptr || z == nullptr) {
        throw std::runtime_error("its points have no fields x, y and z; they have: " +
                                 namesOf(*table_));
    }
    const std::vector<double> x_m = columnOf(*table_, *x), y_m = columnOf(*table_, *y),
                              z_m = columnOf(*table_, *z);
    std::size_t far = 0;
    const auto isFinite = [](double number) { return std::isfinite(static_cast<float>(number)); };
    for (std::uint32_t i = 0; i < table_->points; ++i) {
        if (!isFinite(x_m[i]) || !isFinite(y_m[i]) || !isFinite(z_m[i])) continue;
        point_of_return_.push_back(i);
        far += std::hypot(x_m[i], y_m[i], z_m[i]) > kFarthest_m;
    }
    checkMemoryFor(point_of_return_.size());
    setSize(point_of_return_.size());
    for (std::size_t k = 0; k < point_of_return_.size(); ++k) {
        const std::uint32_t i = point_of_return_[k];
        setPointFast(k, static_cast<float>(x_m[i]), static_cast<float>(y_m[i]),
                     static_cast<float>(z_m[i]));
    }
    if (2 * far > point_of_return_.size()) {
        remarks_.push_back(
            "most points are farther than 1 km from the origin: is it a map, or in millimetres? "
            "Coordinates must be in metres from the sensor");
    }
    takeIntensities();
    takeRings();
    takeTimes();
    mark_as_modified();
}

std::vector<double> TableCloud::ofReturns(const PointField& field) const {
    const std::vector<double> all = columnOf(*table_, field);
    std::vector<double> numbers;
    numbers.reserve(point_of_return_.size());
    for (const std::uint32_t i : point_of_return_) numbers.push_back(all[i]);
    return numbers;
}

void TableCloud::takeIntensities() {
    const PointField* const field =
        findField(*table_, {"intensity", "i", "reflectivity", "remission"});
    if (field == nullptr) return;
    const std::vector<double> intensities = ofReturns(*field);
    double full = 0.0;
    for (const double intensity : intensities) {
        if (std::isfinite(intensity)) full = std::max(full, intensity);
    }
    for (const double scale : {1.0, 255.0, 65535.0}) {
        if (full > scale) continue;
        full = scale;
        break;
    }
    for (std::size_t k = 0; k < intensities.size(); ++k) {
        const double share = std::isfinite(intensities[k]) ? intensities[k] / full : 0.0;
        setPointIntensity(k, static_cast<float>(std::clamp(share, 0.0, 1.0)));
    }
}

void TableCloud::takeRings() {
    const PointField* const field = findField(*table_, {"ring", "channel", "line"});
    if (field == nullptr) return;
    for (const double ring : ofReturns(*field)) {
        if (!(ring >= 0 && ring <= kHighestRing) || ring != std::floor(ring)) {
            remarks_.push_back("the field '" + field->name +
                               "' is not a number of a beam, and is not used");
            rings_.clear();
            return;
        }
        rings_.push_back(static_cast<std::int32_t>(ring));
    }
}

void TableCloud::takeTimes() {
    const PointField* const field =
        findField(*table_, {"time", "t", "timestamp", "time_stamp", "offset_time", "time_offset",
                            "gps_time", "gpstime"});
    if (field == nullptr || point_of_return_.empty()) return;
    const std::vector<double> times = ofReturns(*field);
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    const bool are_finite =
        std::all_of(times.begin(), times.end(), [](double time) { return std::isfinite(time); });
    if (!are_finite) {
        remarks_.push_back("the field '" + field->name +
                           "' has times that are not finite, and is not used");
        return;
    }
    const double unit_s = timeUnit(*field, lowerCase(field->name), *last - *first);
    if ((*last - *first) * unit_s > kLongestScan_s) {
        remarks_.push_back("the times of its points, in '" + field->name +
                           "', span more than 2 s: they are not used");
        return;
    }
    const bool is_relative = std::max(std::abs(*first), std::abs(*last)) * unit_s <= kLongestScan_s;
    const double start = is_relative ? 0.0 : *first;
    times_s_.reserve(times.size());
    for (const double time : times) {
        times_s_.push_back(static_cast<float>((time - start) * unit_s));
    }
}

mrpt::obs::CObservationPointCloud::Ptr observationOf(std::shared_ptr<const PointTable> table,
                                                     const std::string& label,
                                                     mrpt::Clock::time_point time) {
    auto observation = mrpt::obs::CObservationPointCloud::Create();
    observation->timestamp = time;
    observation->sensorLabel = label;
    observation->pointcloud = std::make_shared<TableCloud>(std::move(table));
    return observation;
}

const TableCloud* tableCloudOf(const mrpt::obs::CObservation& observation) {
    const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation);
    return cloud == nullptr ? nullptr : dynamic_cast<const TableCloud*>(cloud->pointcloud.get());
}

PointTable tableOf(const Scan& scan) {
    PointTable table;
    table.points = scan.size();
    const auto add = [&](const char* name, const std::vector<float>& numbers) {
        addColumn(name, NumberType::Float32, {numbers.begin(), numbers.end()}, table);
    };
    add("x", scan.x_m);
    add("y", scan.y_m);
    add("z", scan.z_m);
    add("intensity", scan.intensity);
    if (!scan.time_s.empty()) add("time", scan.time_s);
    return table;
}

}  // namespace hagen::observations
