#pragma once
#include <hagen/live/VehiclePose.h>
#include <Eigen/Geometry>
#include "live/autopilot/ClockOffset.h"
#include "live/mavlink/Frame.h"

#include <cstddef>
#include <deque>
#include <optional>

namespace hagen::live {

/// The poses of a vehicle over the last seconds, from its messages ATTITUDE, ATTITUDE_QUATERNION
/// and LOCAL_POSITION_NED. Between messages they are interpolated; after the last one, turned on
/// by its rates for 0.1 s and moved on by its speed for 0.2 s. Jumps of the estimated place (by
/// more than 2 m against its speed) are left out: the map's origin is then another one.
class VehicleMotion {
 public:
    enum class Taken { Attitude, Place, Other, Refused };

    /// A simulated vehicle's clock may pause, and be slower than ours.
    explicit VehicleMotion(bool is_simulated) : clock_(is_simulated) {}
    VehicleMotion() = default;

    /// Takes a message that came at `arrival_s`. Refused: a value is not finite, or a quaternion is
    /// no rotation.
    Taken take(const mavlink::Frame& frame, double arrival_s);
    /// The pose at a time of our clock; none: unknown, or the last attitude is 0.5 s old.
    std::optional<VehiclePose> at(double time_s) const;
    /// How often the vehicle's clock began anew.
    std::size_t restarts() const { return restarts_; }

 private:
    struct Attitude {
        double time_s;
        Eigen::Quaterniond map_from_vehicle;
        Eigen::Vector3d rates_rad_s;  ///< about the vehicle's axes
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
    Eigen::Vector3d origin_m_ = Eigen::Vector3d::Zero();  ///< of the map; added to places
    std::size_t restarts_ = 0;
};

}  // namespace hagen::live
