#pragma once
#include <hagen/avoidance/Vehicle.h>
#include <cstddef>

namespace hagen::avoidance {

/// Speed and sensor rate of a flight.
struct FlightPace {
    double speed_m_s = 4;        ///< maximum speed
    double scan_period_s = 0.1;  ///< period of the sensor's scans
    VehicleLimits limits;

    /// Maximum time from a return to the vehicle's response: two scan periods (until the scan is
    /// complete, and until the planner takes it) and the actuation delay.
    double reaction_s() const { return 2 * scan_period_s + limits.actuation_delay_s; }
    double stopping_s() const { return speed_m_s / limits.acceleration_m_s2; }
    double stopping_m() const { return 0.5 * speed_m_s * stopping_s(); }
};

/// Number of scans and radius of a sliding window.
struct WindowSize {
    std::size_t scans;
    float radius_m;  ///< points farther from their scan's origin are dropped
};

/// The window for a flight.
///
/// The scans cover the time from a return to standstill (reaction and braking): obstacles must be
/// remembered until the vehicle could have stopped for them, because meanwhile they may be
/// occluded, or above or below the sensor's field of view. 11 scans at 4 m/s, 23 at 10 m/s.
///
/// The radius is the reach of a plan: the distance flown during reaction and the planner's
/// look-ahead, the braking distance, and the reach of a model's clearance. At least 15 m, for path
/// searches, at most 50 m. 27.5 m at 10 m/s.
WindowSize windowSizeFor(const FlightPace& pace);

/// Range [m] of the filter's zone, and of returns in maps of a whole flight: the radius of
/// windowSizeFor(), so that from 7.8 m/s on all models have the same range; at least 20 m.
float perceptionRangeFor_m(const FlightPace& pace);

}  // namespace hagen::avoidance
