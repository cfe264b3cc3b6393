#pragma once
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/Trial.h>
#include <hagen/mrpt/MappedScan.h>
#include <cstdint>
#include <memory>
#include "avoidance/flights/FlightTrace.h"
#include "avoidance/flights/PoseBelief.h"

#include "avoidance/flights/Stopwatch.h"

namespace hagen::avoidance {

/// What the world model is updated with.
struct FedScan {
    observations::MappedScan scan;
    double arrived_s;      ///< when the last of it was there
    std::uint64_t stream;  ///< of random numbers that belong to it
};

/// What the sensor has measured, until the planner takes it.
class ScanFeed {
 public:
    virtual ~ScanFeed() = default;

    /// Takes in the measurements up to a control step, which the trace has reached.
    virtual void receive(int step, const FlightTrace& trace, PoseBelief& belief) = 0;
    virtual bool isWaiting() const = 0;
    /// Takes what waits. Times the filter.
    virtual FedScan take(const FlightTrace& trace, PoseBelief& belief, Stopwatch& stopwatch) = 0;

    virtual double period_s() const = 0;  ///< from one update to the next, at least
    virtual int received() const = 0;     ///< whole scans, or sectors
    virtual int dropped() const = 0;      ///< of these, those that were never taken
};

/// The feed of a setup's updates.
std::unique_ptr<ScanFeed> makeFeed(const Course& course, const TrialSetup& setup, float zone_m);

}  // namespace hagen::avoidance
