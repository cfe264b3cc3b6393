#include <hagen/live/VehiclePose.h>

#include <cmath>

namespace hagen::live {

double VehiclePose::heading_rad() const {
    const Eigen::Vector3d ahead = map_from_vehicle * Eigen::Vector3d::UnitX();
    return std::atan2(ahead.y(), ahead.x());
}

Eigen::Matrix3d levelFromVehicle(const VehiclePose& pose) {
    return Eigen::AngleAxisd(-pose.heading_rad(), Eigen::Vector3d::UnitZ()).toRotationMatrix() *
           pose.map_from_vehicle.toRotationMatrix();
}

Eigen::Isometry3d levelBetween(const VehiclePose& then, const VehiclePose& now) {
    Eigen::Isometry3d between = Eigen::Isometry3d::Identity();
    const Eigen::AngleAxisd level_from_map(-now.heading_rad(), Eigen::Vector3d::UnitZ());
    between.linear() =
        (level_from_map * Eigen::AngleAxisd(then.heading_rad(), Eigen::Vector3d::UnitZ()))
            .toRotationMatrix();
    if (then.place_m && now.place_m) {
        between.translation() = level_from_map * (*then.place_m - *now.place_m);
    }
    return between;
}

}  // namespace hagen::live
