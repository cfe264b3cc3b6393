#pragma once
#include <hagen/live/LiveSession.h>
#include <hagen/live/PacketQueue.h>

#include <sys/types.h>

#include <atomic>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <string>
#include <thread>

namespace hagen::live {

/// The process that records a sensor, seen from the session: packets go there, counts come back.
/// Whatever becomes of it, the session goes on.
class RecorderProcess {
 public:
    /// Starts it and waits until it has made its file. `waits`: add() waits for it; otherwise
    /// packets that come too fast are left out. Throws std::runtime_error naming the program or the
    /// file.
    RecorderProcess(const LiveOptions& options, bool waits);
    /// Has it complete its file, unless finish() was called.
    ~RecorderProcess();
    RecorderProcess(const RecorderProcess&) = delete;
    RecorderProcess& operator=(const RecorderProcess&) = delete;

    /// Takes a data packet of the sensor.
    void add(const Packet& packet);
    /// Why recording ended early, naming the file; empty: it goes on.
    std::string failure() const;
    /// Whether packets came faster than it took them.
    bool leavesOut() const { return left_out_ > 0; }
    /// Has it complete its file, and returns what became of it.
    Recorded finish();

 private:
    void send();
    void listen();
    void watchEnd();
    void endIt(const char* why, double after_s);
    std::string howItEnded();
    void reap() const;

    const std::string program_, file_;
    const bool waits_;
    const double patience_s_, sending_s_;  ///< at the end, and while it is sent packets
    pid_t process_ = -1;
    int socket_ = -1;
    PacketQueue queue_;
    Packet copy_;
    std::size_t left_out_ = 0;
    std::thread sender_, listener_;
    std::atomic<const char*> why_ended_ = nullptr;  ///< by us: what it did for too long
    std::atomic<double> ended_after_s_ = 0;         ///< how long
    std::atomic<double> killed_s_ =
        std::numeric_limits<double>::infinity();  ///< by us; steady clock

    mutable std::mutex mutex_;
    std::condition_variable has_ended_;
    bool is_ended_ = false;  ///< it has said its last line, or has none
    Recorded recorded_;      ///< from its last line; until then, `failure` only
};

}  // namespace hagen::live
