#pragma once
#include <Eigen/Geometry>

#include <optional>

namespace hagen::live {

/// Where a vehicle is and how it is tilted. The vehicle's frame is x forward, y left, z up; the
/// map's x north, y west, z up. (MAVLink has forward, right, down and north, east, down.)
struct VehiclePose {
    Eigen::Quaterniond map_from_vehicle = Eigen::Quaterniond::Identity();
    std::optional<Eigen::Vector3d> place_m;  ///< in the map; none: unknown

    double heading_rad() const;  ///< of the vehicle's x axis, counter-clockwise from north
};

/// The rotation of a pose without its heading: from the vehicle's frame to the level one.
Eigen::Matrix3d levelFromVehicle(const VehiclePose& pose);

/// From the vehicle's level frame (heading as the vehicle's, z up) at one time to that at another:
/// turned by what the heading changed, and moved if both places are known.
Eigen::Isometry3d levelBetween(const VehiclePose& then, const VehiclePose& now);

}  // namespace hagen::live
