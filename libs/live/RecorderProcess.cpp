#include "RecorderProcess.h"

#include <hagen/base/NumberText.h>
#include <hagen/live/RecorderLink.h>

#include <linux/sockios.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace hagen::live {
namespace {

constexpr std::size_t kQueue = 4096;  // packets: seconds
constexpr double kDiskPatience = 6;   // times as long: caches of hundreds of megabytes
constexpr double kDeath_s = 2;        // of what is killed, or has said its last line
constexpr std::chrono::milliseconds kLook{5};

std::filesystem::path programOf(const RecordingOptions& recording) {
    return recording.program.empty() ? recorderProgram() : recording.program;
}

/// The flags of live-record. Names may begin with a dash, so that each is part of its flag.
std::vector<std::string> argumentsOf(const LiveOptions& options, const std::string& program,
                                     bool waits) {
    const RecordingOptions& recording = options.recording;
    std::vector<std::string> arguments{program};
    const auto add = [&](const char* flag, const std::string& value) {
        if (!value.empty()) arguments.push_back(std::string(flag) + "=" + value);
    };
    add("--model", options.model);
    add("--sensor-json", options.sensor_json.string());
    add("--calibration", options.calibration.string());
    for (const auto& file : recording.settings_files) add("--config", file.string());
    add("--record", recording.file.string());
    add("--keep", options.stats.string());
    add("--keep", options.replay.string());
    add("--rotate-bytes", std::to_string(recording.rotate_bytes));
    if (recording.overwrite) arguments.emplace_back("--overwrite");
    if (waits) arguments.emplace_back("--wait");
    return arguments;
}

/// Starts a program with a socket as its standard input. Returns 0 or an errno.
int spawn(std::vector<std::string> arguments, int socket, pid_t& pid) {
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    // In a process group of its own: Ctrl-C in a terminal is for the session, which ends it.
    short flags = POSIX_SPAWN_SETPGROUP;
    posix_spawnattr_setpgroup(&attributes, 0);
    // Real-time priority is for labels.
    const int policy = sched_getscheduler(0);
    if (policy == SCHED_FIFO || policy == SCHED_RR) {
        const sched_param none{};
        posix_spawnattr_setschedpolicy(&attributes, SCHED_OTHER);
        posix_spawnattr_setschedparam(&attributes, &none);
        flags |= POSIX_SPAWN_SETSCHEDULER;
    }
    posix_spawnattr_setflags(&attributes, flags);
    const int failed = posix_spawn(&pid, words[0], &actions, &attributes, words.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

/// Waits until a process has ended. Without `reaps`, its number stays its own.
siginfo_t waitFor(pid_t process, bool reaps, int how = 0) {
    siginfo_t end{};
    how |= reaps ? WEXITED : WEXITED | WNOWAIT;
    errno = 0;
    while (waitid(P_PID, static_cast<id_t>(process), &end, how) < 0 && errno == EINTR) {
    }
    return end;
}

double cpuOf_s(pid_t process) {
    clockid_t clock{};
    timespec time{};
    if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Whether one of its threads waits for the disk ("D" in its state), which takes no processor.
bool waitsForDisk(pid_t process) {
    std::error_code error;
    const std::string tasks = "/proc/" + std::to_string(process) + "/task";
    for (std::filesystem::directory_iterator task(tasks, error), end; !error && task != end;
         task.increment(error)) {
        std::string stat;
        std::getline(std::ifstream(task->path() / "stat"), stat);
        const std::size_t name_end = stat.rfind(')');  // the name may hold anything
        if (name_end != std::string::npos && stat.compare(name_end, 3, ") D") == 0) return true;
    }
    return false;
}

/// How long reading or sending waits on a socket.
void limitWait(int socket, int direction, double longest_s) {
    timeval longest{};
    longest.tv_sec = static_cast<time_t>(longest_s);
    longest.tv_usec = static_cast<suseconds_t>(1e6 * (longest_s - std::floor(longest_s)));
    setsockopt(socket, SOL_SOCKET, direction, &longest, sizeof longest);
}

/// Of a process that takes packets: it changes while one of them is taken.
int waitingBytes(int socket) {
    int bytes = 0;
    ioctl(socket, SIOCOUTQ, &bytes);
    return bytes;
}

}  // namespace

RecorderProcess::RecorderProcess(const LiveOptions& options, bool waits)
    : program_(programOf(options.recording).string()),
      file_(options.recording.file.string()),
      waits_(waits),
      patience_s_(options.recording.patience_s),
      sending_s_(waits ? kDiskPatience * patience_s_ : patience_s_),
      queue_(kQueue) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
        throw std::runtime_error(file_ + ": cannot be recorded: " + std::strerror(errno));
    }
    const int failed = spawn(argumentsOf(options, program_, waits), ends[1], process_);
    close(ends[1]);
    socket_ = ends[0];
    if (failed != 0) {
        close(socket_);
        throw std::runtime_error(file_ + ": cannot be recorded: " + program_ +
                                 " cannot be started: " + std::strerror(failed));
    }
    std::string line, failure;
    limitWait(socket_, SO_RCVTIMEO, kDiskPatience * patience_s_);
    errno = 0;
    try {
        if (readLine(socket_, line)) {
            failure = failureIn(line);
        } else {
            if (errno == EAGAIN) endIt("did not begin for ", kDiskPatience * patience_s_);
            failure = howItEnded();
        }
    } catch (const std::runtime_error& e) {
        failure = program_ + " answers '" + line.substr(0, 40) + "', which " + e.what();
    }
    if (!failure.empty()) {
        close(socket_);
        kill(process_, SIGKILL);  // it has said why it ends, or nothing that is known
        reap();
        throw std::runtime_error(failure);
    }
    limitWait(socket_, SO_RCVTIMEO, 0);  // for ever: its last words come at the end
    limitWait(socket_, SO_SNDTIMEO, sending_s_);
    try {
        sender_ = std::thread([this] { send(); });
        listener_ = std::thread([this] { listen(); });
    } catch (const std::system_error& e) {
        finish();
        throw std::runtime_error(file_ +
                                 ": cannot be recorded: a thread cannot be started: " + e.what());
    }
}

RecorderProcess::~RecorderProcess() {
    if (sender_.joinable()) finish();
}

/// Hands packets over as fast as the recorder takes them.
void RecorderProcess::send() {
    Packet packet;
    bool is_open = true;
    for (;;) {
        const auto popped = queue_.pop(packet, std::chrono::seconds(1));
        if (popped == PacketQueue::Popped::Closed) break;
        if (popped != PacketQueue::Popped::Packet || !is_open) continue;
        is_open = sendPacket(socket_, packet);
        if (is_open) continue;
        if (errno == EAGAIN) endIt("took no packets for ", sending_s_);
        queue_.close();
    }
    shutdown(socket_, SHUT_WR);
}

/// Waits for what the recorder says at its end.
void RecorderProcess::listen() {
    std::string line;
    Recorded recorded;
    try {
        if (readLine(socket_, line)) {
            recorded = recordedIn(line);
        } else {
            recorded.failure = howItEnded();
        }
    } catch (const std::exception& e) {  // memory, too
        recorded.failure = file_ + ": the recorder's last words are none: " + e.what();
    }
    {
        const std::lock_guard lock(mutex_);
        recorded_ = std::move(recorded);
        is_ended_ = true;
    }
    has_ended_.notify_all();
    queue_.close();
}

/// Something else may hold its end of the socket, so that its death alone wakes no thread.
void RecorderProcess::endIt(const char* why, double after_s) {
    ended_after_s_ = after_s;
    why_ended_ = why;
    killed_s_ = steadyNow_s();
    kill(process_, SIGKILL);
    shutdown(socket_, SHUT_RDWR);
}

/// Waits until the recorder has completed its file. One that does nothing for too long is ended: it
/// would keep the session, and whoever restarts that, for ever. A disk may take longer.
void RecorderProcess::watchEnd() {
    double alive_s = steadyNow_s(), cpu_s = cpuOf_s(process_);
    int waiting = waitingBytes(socket_);
    std::unique_lock lock(mutex_);
    const auto hasEndedWithin = [&](std::chrono::milliseconds longest) {
        return has_ended_.wait_for(lock, longest, [&] { return is_ended_; });
    };
    while (!hasEndedWithin(std::chrono::milliseconds(20))) {
        const double now_s = steadyNow_s(), now_cpu_s = cpuOf_s(process_);
        const int now_waiting = waitingBytes(socket_);
        if (now_cpu_s != cpu_s || now_waiting != waiting) alive_s = now_s;
        cpu_s = now_cpu_s;
        waiting = now_waiting;
        if (now_s - alive_s <= patience_s_) continue;
        if (now_s - alive_s <= kDiskPatience * patience_s_ && waitsForDisk(process_)) continue;
        endIt(waitsForDisk(process_) ? "waited for its disk for more than " : "did nothing for ",
              patience_s_);
        return;
    }
}

/// Waits until the process has ended, without a word that can be read. If it still speaks, that
/// ends it; if it stays all the same, it is killed. Then, too, it may stay, in its disk: it is not
/// waited for any longer.
std::string RecorderProcess::howItEnded() {
    shutdown(socket_, SHUT_RD);
    siginfo_t end{};
    const double start_s = steadyNow_s(), longest_s = std::min(kDeath_s, patience_s_);
    while (end.si_pid == 0 && steadyNow_s() < killed_s_ + kDeath_s) {
        end = waitFor(process_, false, WNOHANG);
        if (end.si_pid != 0 || errno == ECHILD) break;  // somebody else may take its status
        std::this_thread::sleep_for(kLook);
        if (why_ended_ == nullptr && steadyNow_s() > start_s + longest_s) {
            endIt("closed its socket, stayed for ", longest_s);
        }
    }
    const char* const why = why_ended_;
    const std::string how =
        why != nullptr ? why + base::fixedText(ended_after_s_, 1) + " s and was ended" +
                             (end.si_pid == 0 ? ", but is still there: it waits for its disk" : "")
        : end.si_pid == 0           ? "ended"
        : end.si_code == CLD_EXITED ? "ended with exit status " + std::to_string(end.si_status)
                                    : "was killed by signal " + std::to_string(end.si_status) +
                                          " (" + strsignal(end.si_status) + ")";
    return file_ + ": its recorder (" + program_ + ") " + how +
           "; what was written can be read under a temporary name beside it";
}

/// Takes the status of a process that has said its last line, or was killed. One that is there
/// still is killed; one that cannot die, in its disk, is left.
void RecorderProcess::reap() const {
    for (const double longest_s : {std::min(kDeath_s, patience_s_), kDeath_s}) {
        const double end_s = steadyNow_s() + longest_s;
        do {
            if (waitFor(process_, true, WNOHANG).si_pid != 0 || errno == ECHILD) return;
            std::this_thread::sleep_for(kLook);
        } while (steadyNow_s() < end_s);
        kill(process_, SIGKILL);
    }
}

void RecorderProcess::add(const Packet& packet) {
    copy_ = packet;
    const bool is_taken = waits_ ? queue_.pushOrWait(copy_) : queue_.push(copy_);
    left_out_ += !is_taken;
}

std::string RecorderProcess::failure() const {
    const std::lock_guard lock(mutex_);
    return recorded_.failure;
}

Recorded RecorderProcess::finish() {
    queue_.close();
    if (listener_.joinable()) watchEnd();
    if (sender_.joinable()) sender_.join();
    if (listener_.joinable()) listener_.join();
    if (socket_ >= 0) {
        close(socket_);
        socket_ = -1;
        reap();
    }
    recorded_.packets_left_out = left_out_;
    return recorded_;
}

}  // namespace hagen::live
