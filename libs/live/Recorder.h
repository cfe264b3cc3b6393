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

/// Writes datagrams to a capture, and poses of the vehicle to a TUM file beside it, on a thread of
/// its own: a slow disk delays nobody, and what does not fit into the queue is left out and
/// counted. The files get their names at the end.
class Recorder {
 public:
    /// `waits`: add() waits for the disk instead. Throws std::runtime_error naming the file if one
    /// cannot be written, or exists and may not be replaced.
    Recorder(const RecordingOptions& options, bool has_poses, bool waits);
    /// As finish().
    ~Recorder();

    /// Called by the thread that receives.
    void add(const Packet& packet);
    /// A pose at a time of the packets (Packet::time_ns). One at most 20 ms after the last one adds
    /// nothing. Requires `has_poses`.
    void addPose(std::int64_t time_ns, const Eigen::Isometry3d& map_from_vehicle);
    /// What is added from now on is ignored.
    void close();

    /// So far; any thread may ask.
    std::size_t leftOut() const { return left_out_; }
    std::string failure() const;

    /// Writes what waits, and gives the files their names.
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
    Packet copy_;  ///< reused by the thread that receives
    std::int64_t last_pose_ns_;
    std::atomic<std::size_t> left_out_ = 0;
    std::atomic<bool> is_closed_ = false;

    mutable std::mutex mutex_;  // of all that follows
    std::string pose_lines_;    ///< that wait
    Recorded recorded_;

    std::thread thread_;
};

}  // namespace hagen::live
