#pragma once
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <mrpt/poses/CPose3D.h>
#include <deque>

namespace hagen::observations {

/// Stage 10, the sliding window (section I): the last K scans as one, in the frame of the newest.
/// This is the project's only state that carries over between scans.
class SlidingWindow {
 public:
    /// Throws std::invalid_argument for fewer than 1 scan.
    explicit SlidingWindow(int scans);

    /// Adds a scan taken at `sensor_pose` (sensor in the map) and drops the one K scans ago.
    /// Returns the returns of the newest scan, unchanged, followed by those of the earlier scans,
    /// newest first, transformed into the newest one's frame; their beam indices are recomputed
    /// with `sensor`. A window has no times (time_s is empty). The result is valid until the next
    /// call.
    const Scan& add(const Scan& newest, const mrpt::poses::CPose3D& sensor_pose,
                    const SensorModel& sensor);

    /// Drops all scans, for example after a jump of the pose.
    void clear() { past_.clear(); }

 private:
    struct PastScan {
        Scan scan;
        mrpt::poses::CPose3D sensor_pose;
    };
    std::size_t scans_;
    std::deque<PastScan> past_;  // newest first
    Scan window_;
};

}  // namespace hagen::observations
