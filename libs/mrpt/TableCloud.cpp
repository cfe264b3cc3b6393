#include "mrpt/TableCloud.h"
#include "mrpt/PointFields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace hagen::observations {

constexpr double kMaxRange_m = 1000.0;  // more than all sensors measure

TableCloud::TableCloud(std::shared_ptr<const PointTable> table, double period_s)
    : table_(std::move(table)) {
    check(*table_);
    if (table_->points > std::numeric_limits<std::uint32_t>::max()) {
        throw std::runtime_error("more than 4294967295 points");
    }
    const PointField *const x = findField(*table_, {"x"}), *const y = findField(*table_, {"y"}),
                            *const z = findField(*table_, {"z"});
    if (x == nullptr || y == nullptr || z == nullptr) {
        throw std::runtime_error("missing fields x, y and z; fields: " + namesOf(*table_));
    }
    const std::vector<double> x_m = columnOf(*table_, *x), y_m = columnOf(*table_, *y),
                              z_m = columnOf(*table_, *z);
    std::size_t far = 0;
    const auto isFinite = [](double number) { return std::isfinite(static_cast<float>(number)); };
    for (std::uint32_t i = 0; i < table_->points; ++i) {
        if (!isFinite(x_m[i]) || !isFinite(y_m[i]) || !isFinite(z_m[i])) continue;
        point_of_return_.push_back(i);
        far += std::hypot(x_m[i], y_m[i], z_m[i]) > kMaxRange_m;
    }
    setSize(point_of_return_.size());
    for (std::size_t k = 0; k < point_of_return_.size(); ++k) {
        const std::uint32_t i = point_of_return_[k];
        setPointFast(k, static_cast<float>(x_m[i]), static_cast<float>(y_m[i]),
                     static_cast<float>(z_m[i]));
    }
    if (2 * far > point_of_return_.size()) {
        remarks_.push_back(
            "most points are farther than 1 km from the origin (a map, or millimetres?). "
            "Coordinates must be in metres from the sensor");
    }
    takeIntensities();
    PointFieldValues<std::int32_t> rings = ringsOf(*table_, point_of_return_);
    PointFieldValues<float> times = timesOf(*table_, point_of_return_, period_s);
    rings_ = std::move(rings.values);
    times_s_ = std::move(times.values);
    for (const std::string& remark : {rings.remark, times.remark}) {
        if (!remark.empty()) remarks_.push_back(remark);
    }
    for (std::string& remark : remarksOnLookAlikes(*table_)) remarks_.push_back(std::move(remark));
    mark_as_modified();
}

void TableCloud::takeIntensities() {
    const PointField* const field = intensityFieldOf(*table_);
    if (field == nullptr) return;
    const std::vector<double> intensities = columnOf(*table_, *field, point_of_return_);
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

mrpt::obs::CObservationPointCloud::Ptr observationOf(std::shared_ptr<const PointTable> table,
                                                     const std::string& label,
                                                     mrpt::Clock::time_point time,
                                                     double period_s) {
    auto observation = mrpt::obs::CObservationPointCloud::Create();
    observation->timestamp = time;
    observation->sensorLabel = label;
    observation->pointcloud = std::make_shared<TableCloud>(std::move(table), period_s);
    return observation;
}

const TableCloud* tableCloudOf(const mrpt::obs::CObservation& observation) {
    const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation);
    return cloud == nullptr ? nullptr : dynamic_cast<const TableCloud*>(cloud->pointcloud.get());
}

PointTable untimedTableOf(const Scan& scan) {
    PointTable table;
    table.points = scan.size();
    const auto add = [&](const char* name, const std::vector<float>& numbers) {
        addColumn(name, NumberType::Float32, {numbers.begin(), numbers.end()}, table);
    };
    add("x", scan.x_m);
    add("y", scan.y_m);
    add("z", scan.z_m);
    add("intensity", scan.intensity);
    return table;
}

PointTable tableOf(const Scan& scan) {
    PointTable table = untimedTableOf(scan);
    if (scan.time_s.empty()) return table;
    addColumn("time", NumberType::Float32, {scan.time_s.begin(), scan.time_s.end()}, table);
    return table;
}

}  // namespace hagen::observations
