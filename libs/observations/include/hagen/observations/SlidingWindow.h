#pragma once
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <mrpt/poses/CPose3D.h>
#include <deque>

namespace hagen::observations {

/// Stage 10, the sliding window (section I): the last K scans as one, seen from where the newest
/// was taken. The only memory from scan to scan that this project has.
class SlidingWindow {
 public:
    /// Throws std::invalid_argument for fewer than 1 scan.
    explicit SlidingWindow(int scans);

    /// Adds a scan taken at `sensor_pose` (sensor in the map) and forgets the one K scans ago.
    /// Gives the returns of the newest scan, as they are, followed by those of the scans before it,
    /// newest first, moved into the newest one's frame; their beams are located anew with `sensor`.
    /// A window has no times (time_s is empty). The result stays valid until the next call.
    const Scan& add(const Scan& newest, const mrpt::poses::CPose3D& sensor_pose,
                    const SensorModel& sensor);

    /// Forgets all scans, as after a jump of the pose.
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
