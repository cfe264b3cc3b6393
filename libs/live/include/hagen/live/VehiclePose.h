#pragma once
#include <Eigen/Geometry>

#include <optional>

namespace hagen::live {

/// Position and attitude of a vehicle. The vehicle frame is x forward, y left, z up; the map frame
/// x north, y west, z up. (MAVLink uses forward-right-down and north-east-down.)
struct VehiclePose {
    Eigen::Quaterniond map_from_vehicle = Eigen::Quaterniond::Identity();
    std::optional<Eigen::Vector3d> place_m;  ///< in the map; nullopt: unknown

    double heading_rad() const;  ///< of the vehicle's x axis, counter-clockwise from north
};

/// The pose's rotation without its heading: from the vehicle frame to the level frame.
Eigen::Matrix3d levelFromVehicle(const VehiclePose& pose);

/// From the vehicle's level frame (with its heading, z up) at one time to that at another: rotated
/// by the heading change, and translated if both positions are known.
Eigen::Isometry3d levelBetween(const VehiclePose& then, const VehiclePose& now);

}  // namespace hagen::live
