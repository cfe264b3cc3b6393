#include "live/Recorder.h"

#include "base/WriteFile.h"
#include "live/Priority.h"

#include <chrono>
#include <cstdio>
#include <exception>
#include <limits>

namespace hagen::live {
namespace {

constexpr std::chrono::milliseconds kFlush{200};     // time without packets before flushing
constexpr std::int64_t kPosePeriod_ns = 20'000'000;  // typical period of attitude messages
constexpr std::size_t kMaxPoseBytes = 1 << 20;       // maximum size of queued pose lines

/// Keeps a partial output; returns a note with its path, or "" if nothing was written.
std::string keptOf(base::OutputPath& output) {
    std::error_code ignored;
    if (!std::filesystem::exists(output.temporary(), ignored)) return "";
    return "; partial recording kept in " + output.keepPartial().string();
}

}  // namespace

Recorder::Recorder(const RecordingOptions& options, bool has_poses, bool waits)
    : waits_(waits),
      queue_(options.queue),
      capture_output_(options.file, base::kFile, options.overwrite),
      capture_(capture_output_.temporary()),
      last_pose_ns_(std::numeric_limits<std::int64_t>::min() / 2) {
    if (has_poses) {
        poses_output_.emplace(options.posesFile(), base::kFile, options.overwrite);
        poses_ = base::openToWrite(poses_output_->temporary(), poses_output_->path());
        pose_lines_ = "# time x y z qx qy qz qw\n";
    }
    thread_ = std::thread([this] { run(); });
}

Recorder::~Recorder() { finish(); }

void Recorder::add(const Packet& packet) {
    copy_ = packet;
    const bool is_taken = waits_ ? queue_.pushOrWait(copy_) : queue_.push(copy_);
    if (!is_taken && !is_closed_) ++left_out_;
}

void Recorder::addPose(std::int64_t time_ns, const Eigen::Isometry3d& map_from_vehicle) {
    if (time_ns - last_pose_ns_ < kPosePeriod_ns) return;
    last_pose_ns_ = time_ns;
    const Eigen::Vector3d at_m = map_from_vehicle.translation();
    const Eigen::Quaterniond turn(map_from_vehicle.linear());
    char line[256];
    std::snprintf(line, sizeof line, "%lld.%09lld %.4f %.4f %.4f %.9f %.9f %.9f %.9f\n",
                  static_cast<long long>(time_ns / 1000000000),
                  static_cast<long long>(time_ns % 1000000000), at_m.x(), at_m.y(), at_m.z(),
                  turn.x(), turn.y(), turn.z(), turn.w());
    const std::lock_guard lock(mutex_);
    if (is_closed_ || pose_lines_.size() > kMaxPoseBytes) return;
    pose_lines_ += line;
    ++recorded_.poses;
}

void Recorder::close() {
    is_closed_ = true;
    queue_.close();
}

std::string Recorder::failure() const {
    const std::lock_guard lock(mutex_);
    return recorded_.failure;
}

void Recorder::fail(const std::string& why) {
    std::string kept;
    try {
        kept = keptOf(capture_output_);
        if (poses_output_) kept += keptOf(*poses_output_);
    } catch (const std::exception& e) {
        kept = std::string("; ") + e.what();
    }
    queue_.close();
    const std::lock_guard lock(mutex_);
    recorded_.failure = base::withOutputNames(why) + kept;
}

void Recorder::writePoses() {
    if (!poses_output_) return;
    std::string lines;
    {
        const std::lock_guard lock(mutex_);
        lines.swap(pose_lines_);
    }
    errno = 0;
    poses_.write(lines.data(), static_cast<std::streamsize>(lines.size())).flush();
    if (!poses_) base::throwWriteError(poses_output_->path(), errno);
}

void Recorder::write() {
    Packet packet;
    PacketQueue::Popped popped{};
    while ((popped = queue_.pop(packet, kFlush)) != PacketQueue::Popped::Closed) {
        if (popped == PacketQueue::Popped::Nothing) {
            capture_.flush();
            writePoses();
            continue;
        }
        if (capture_.add(packet.datagram())) writePoses();
        const std::lock_guard lock(mutex_);
        ++recorded_.packets;
    }
    capture_.flush();
    writePoses();
}

void Recorder::run() {
    leaveRealTime();
    try {
        write();
    } catch (const std::exception& e) {
        fail(e.what());
    }
}

Recorded Recorder::finish() {
    close();
    if (thread_.joinable()) {
        thread_.join();
        try {
            if (recorded_.failure.empty()) {
                capture_output_.commit();
                recorded_.files.push_back(capture_output_.path());
                if (poses_output_) {
                    poses_output_->commit();
                    recorded_.files.push_back(poses_output_->path());
                }
            }
        } catch (const std::exception& e) {
            fail(e.what());
        }
        recorded_.left_out = left_out_;
    }
    return recorded_;
}

}  // namespace hagen::live
