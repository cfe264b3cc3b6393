#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/live/PacketQueue.h>
#include <hagen/live/Recording.h>
#include <Eigen/Geometry>
#include "sensors/captures/CaptureWriter.h"

#include <atomic>
#include <cstdint>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace hagen::live {

/// Writes datagrams to a capture, and vehicle poses to a TUM file next to it, in a separate thread.
/// If the disk is too slow, datagrams that do not fit into the queue are dropped and counted. The
/// files get their final names in finish().
class Recorder {
 public:
    /// With `waits`, add() blocks while the queue is full instead of dropping. Throws
    /// std::runtime_error naming the file if it cannot be written, or exists and may not be
    /// replaced.
    Recorder(const RecordingOptions& options, bool has_poses, bool waits);
    /// Calls finish().
    ~Recorder();

    /// Adds a datagram; called by the receiving thread.
    void add(const Packet& packet);
    /// Adds a pose at a packet time (Packet::time_ns), unless it is at most 20 ms after the last
    /// pose. Requires `has_poses`.
    void addPose(std::int64_t time_ns, const Eigen::Isometry3d& map_from_vehicle);
    /// Ignores all later add() calls.
    void close();

    /// Datagrams dropped so far. Thread-safe.
    std::size_t leftOut() const { return left_out_; }
    std::string failure() const;

    /// Writes all queued data and renames the files.
    Recorded finish();

 private:
    void run();
    void write();
    void writePoses();
    void fail(const std::string& why);

    const bool waits_;
    PacketQueue queue_;
    base::OutputPath capture_output_;
    std::optional<base::OutputPath> poses_output_;
    sensors::CaptureWriter capture_;
    std::ofstream poses_;
    Packet copy_;  ///< reused by the receiving thread
    std::int64_t last_pose_ns_;
    std::atomic<std::size_t> left_out_ = 0;
    std::atomic<bool> is_closed_ = false;

    mutable std::mutex mutex_;  // guards all members below
    std::string pose_lines_;    ///< lines that are not written yet
    Recorded recorded_;

    std::thread thread_;
};

}  // namespace hagen::live
