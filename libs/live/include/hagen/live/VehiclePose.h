#pragma once
#include <Eigen/Geometry>

#include <optional>

namespace hagen::live {

/// Position and attitude of a vehicle. The vehicle frame is x forward, y left, z up; the map frame
/// is x north, y west, z up. (MAVLink uses forward-right-down and north-east-down.)
struct VehiclePose {
    Eigen::Quaterniond map_from_vehicle = Eigen::Quaterniond::Identity();
    std::optional<Eigen::Vector3d> place_m;  ///< position in the map; nullopt if unknown

    double heading_rad() const;  ///< heading of the x axis, counter-clockwise from north
};

/// The pose's rotation without its heading: from the vehicle frame to the level frame.
Eigen::Matrix3d levelFromVehicle(const VehiclePose& pose);

/// The transform between the vehicle's level frames (with its heading, z up) at two times: a
/// rotation by the heading change, and a translation if both positions are known.
Eigen::Isometry3d levelBetween(const VehiclePose& then, const VehiclePose& now);

}  // namespace hagen::live
