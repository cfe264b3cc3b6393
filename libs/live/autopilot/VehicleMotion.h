#pragma once
#include <hagen/live/VehiclePose.h>
#include <Eigen/Geometry>
#include "live/autopilot/ClockOffset.h"
#include "live/mavlink/Frame.h"

#include <cstddef>
#include <deque>
#include <optional>

namespace hagen::live {

/// Vehicle poses of the last seconds, from ATTITUDE, ATTITUDE_QUATERNION and LOCAL_POSITION_NED.
/// Poses are interpolated between messages and extrapolated after the last one: the attitude for
/// 0.1 s, the position for 0.2 s. Jumps of the position estimate (more than 2 m from the
/// prediction) are removed, because they move the map origin.
class VehicleMotion {
 public:
    enum class Taken { Attitude, Place, Other, Refused };

    /// `is_simulated` means that the vehicle's clock may pause or run slow.
    explicit VehicleMotion(bool is_simulated) : clock_(is_simulated) {}
    VehicleMotion() = default;

    /// Adds a message received at `arrival_s`. Rejects values that are not finite, and quaternions
    /// that are not rotations.
    Taken take(const mavlink::Frame& frame, double arrival_s);
    /// The pose at a local time; nullopt if unknown, or if the last attitude is 0.5 s old.
    std::optional<VehiclePose> at(double time_s) const;
    /// Number of restarts of the vehicle's clock.
    std::size_t restarts() const { return restarts_; }

 private:
    struct Attitude {
        double time_s;
        Eigen::Quaterniond map_from_vehicle;
        Eigen::Vector3d rates_rad_s;  ///< rates about the vehicle's axes
    };
    struct Place {
        double time_s;
        Eigen::Vector3d place_m, speed_m_s;
    };

    double ourTime(std::uint32_t boot_ms, double arrival_s);
    void add(const Attitude& attitude);
    void add(Place place);
    void placeAt(double time_s, VehiclePose& pose) const;

    ClockOffset clock_;
    std::deque<Attitude> attitudes_;
    std::deque<Place> places_;
    Eigen::Vector3d origin_m_ = Eigen::Vector3d::Zero();  ///< origin of the map; added to positions
    std::size_t restarts_ = 0;
};

}  // namespace hagen::live
