#pragma once
#include <hagen/avoidance/Vehicle.h>
#include <cstddef>

namespace hagen::avoidance {

/// How a vehicle flies.
struct FlightPace {
    double speed_m_s = 4;        ///< maximum
    double scan_period_s = 0.1;  ///< of the sensor
    VehicleLimits limits;

    /// From a return to the response of the vehicle, at the longest: a scan that it waits in, one
    /// that it just missed, and the actuation.
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
/// Scans: those of the time from a return to standstill (reaction and braking). What a plan relied
/// on must be remembered until the vehicle could have stopped for it: meanwhile, it may be hidden
/// behind something nearer, or above or below the sensor's field of view. 11 scans at 4 m/s, 23 at
/// 10 m/s.
///
/// Radius: what a plan can touch: the way flown while reacting and during the planner's look-ahead,
/// the way of braking, and the reach of a model's clearance. At least 15 m, for path searches,
/// at most 50 m. 27.5 m at 10 m/s.
WindowSize windowSizeFor(const FlightPace& pace);

/// How far the filter's zone reaches, and maps of a whole flight take returns: as far as the window
/// of such a flight, so that from 7.8 m/s on all models see equally far; 20 m at least, the zone of
/// the presets. In metres.
float perceptionRangeFor_m(const FlightPace& pace);

}  // namespace hagen::avoidance
