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

/// The input of a world model update.
struct FedScan {
    observations::MappedScan scan;
    double arrived_s;      ///< arrival time of the scan's last part
    std::uint64_t stream;  ///< random stream of the scan
};

/// Buffers measurements until the planner takes them.
class ScanFeed {
 public:
    virtual ~ScanFeed() = default;

    /// Adds the measurements up to a control step that the trace has reached.
    virtual void receive(int step, const FlightTrace& trace, PoseBelief& belief) = 0;
    virtual bool isWaiting() const = 0;
    /// Returns the waiting measurements, and times the filter.
    virtual FedScan take(const FlightTrace& trace, PoseBelief& belief, Stopwatch& stopwatch) = 0;

    virtual double period_s() const = 0;  ///< minimum time between updates
    virtual int received() const = 0;     ///< number of whole scans or sectors
    virtual int dropped() const = 0;      ///< number of scans or sectors never taken
};

/// Creates the feed for a setup's updates.
std::unique_ptr<ScanFeed> makeFeed(const Course& course, const TrialSetup& setup, float zone_m);

}  // namespace hagen::avoidance
