#include "recordings/rawlogs/RawlogTrial.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include "base/MemoryLimit.h"
#include "base/ProcessCost.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "recordings/rawlogs/EntryReader.h"

namespace hagen::recordings {
namespace {

/// The message to the program, a packet.
struct VerdictMessage {
    EntryVerdict::Kind kind;
    std::uint64_t end;
    std::array<char, 4096> why;
};

void sendVerdict(int socket, EntryVerdict::Kind kind, std::uint64_t end, const char* why = "") {
    VerdictMessage message{kind, end, {}};
    std::snprintf(message.why.data(), message.why.size(), "%s", why);
    if (send(socket, &message, sizeof message, MSG_NOSIGNAL) < 0) _exit(0);
}

/// Private memory of this process [bytes].
std::uint64_t dataBytes() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t pages = 0;
    for (int field = 0; field < 6; ++field) file >> pages;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// Reads all entries and sends a verdict on each of them.
[[noreturn]] void tryAll(const std::filesystem::path& file, const std::filesystem::path& opened,
                         int socket) {
    std::optional<EntryReader> opening;
    try {
        EntryReader& reader = opening.emplace(file, opened);
        base::limitMemory(dataBytes() + kMaxEntryBytes);
        while (reader.next()) {
            sendVerdict(socket, EntryVerdict::Kind::Sound, reader.stream().getPosition());
        }
        sendVerdict(socket, EntryVerdict::Kind::End, reader.stream().getPosition());
    } catch (const std::bad_alloc&) {
        const std::uint64_t at = opening ? opening->stream().getPosition() : 0;
        sendVerdict(socket, EntryVerdict::Kind::OutOfMemory, at);
    } catch (const std::exception& e) {
        sendVerdict(socket, EntryVerdict::Kind::Broken, 0, e.what());
    }
    _exit(0);
}

/// Runs in the child process, which keeps only the descriptors of the rawlog and the socket.
[[noreturn]] void runTrial(const std::filesystem::path& file, int descriptor, int socket) {
    setpgid(0, 0);
    // The program stops this process. Crashes must not write core files.
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) signal(number, SIG_IGN);
    for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) signal(number, SIG_DFL);
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    // The program itself prints MRPT's warnings when it reads the entry.
    const int silence = open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(silence, stream);
    constexpr int kRawlog = 3, kSocket = 4;
    const int high_rawlog = fcntl(descriptor, F_DUPFD, 10),
              high_socket = fcntl(socket, F_DUPFD, 10);
    dup2(high_rawlog, kRawlog);
    dup2(high_socket, kSocket);
    close_range(kSocket + 1, ~0U, 0);
    // Reopened, because the program's reading moves the shared position, and by descriptor, because
    // the name may refer to another file by now.
    tryAll(file, "/proc/self/fd/" + std::to_string(kRawlog), kSocket);
}

}  // namespace

RawlogTrial::RawlogTrial(const std::filesystem::path& file, int descriptor,
                         std::chrono::milliseconds max_idle)
    : file_(file), descriptor_(descriptor), max_idle_(max_idle) {
    start();
}

RawlogTrial::~RawlogTrial() { stop(); }

void RawlogTrial::start() {
    int ends[2] = {-1, -1};
    process_ = socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) == 0 ? fork() : -1;
    if (process_ == 0) runTrial(file_, descriptor_, ends[1]);
    const int error = errno;
    close(ends[1]);
    verdicts_ = ends[0];
    if (process_ < 0) {
        close(verdicts_);
        throw std::runtime_error(file_.string() +
                                 ": cannot be read: starting a process to check its entries failed "
                                 "(ulimit -u?): " +
                                 std::strerror(error));
    }
    received_ = 0;
    ++starts_;
}

void RawlogTrial::stop() {
    if (verdicts_ >= 0) close(verdicts_);
    verdicts_ = -1;
    if (process_ < 0) return;
    kill(process_, SIGKILL);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
}

/// Returns false when the process sends data or exits, true if it is idle for too long.
bool RawlogTrial::isStuck() const {
    sigset_t all;
    sigfillset(&all);
    const timespec max_idle{max_idle_.count() / 1000, max_idle_.count() % 1000 * 1000000};
    for (;;) {
        const auto before = base::cpuTimeOf(process_);
        pollfd waits{verdicts_, POLLIN, 0};
        if (ppoll(&waits, 1, &max_idle, &all) != 0) return false;
        if (before && base::cpuTimeOf(process_) == before) return true;
    }
}

std::string RawlogTrial::cannotBeRead(const std::string& why) const {
    return file_.string() + ": entry " + std::to_string(entries_) + " at byte " +
           std::to_string(last_.end) + " (uncompressed) cannot be read: " + why;
}

std::string RawlogTrial::whyItEnded() {
    int status = 0;
    pid_t ended = 0;
    while ((ended = waitpid(process_, &status, 0)) < 0 && errno == EINTR) {
    }
    process_ = -1;
    const bool is_signal = ended > 0 && WIFSIGNALED(status);
    return cannotBeRead("MRPT's reader crashed" +
                        (is_signal ? std::string(" (") + strsignal(WTERMSIG(status)) + ")" : ""));
}

EntryVerdict RawlogTrial::receiveVerdict() {
    VerdictMessage message;
    if (recv(verdicts_, &message, sizeof message, 0) != sizeof message) {
        return {EntryVerdict::Kind::Broken, last_.end, whyItEnded()};
    }
    ++received_;
    if (message.kind == EntryVerdict::Kind::OutOfMemory) {
        return {EntryVerdict::Kind::Broken, last_.end,
                cannotBeRead("it requests too much memory at byte " + std::to_string(message.end) +
                             ": a count is wrong, or the entry exceeds " +
                             std::to_string(kMaxEntryBytes >> 20) + " MiB or --memory-limit")};
    }
    return {message.kind, message.end, message.why.data()};
}

EntryVerdict RawlogTrial::next() {
    if (last_.kind != EntryVerdict::Kind::Sound) return last_;
    const auto broken = [this](const std::string& why) {
        return last_ = {EntryVerdict::Kind::Broken, last_.end, why};
    };
    for (;;) {
        if (isStuck()) {
            stop();
            if (starts_ == kMaxStarts) return broken(cannotBeRead("MRPT's reader hangs"));
            start();
            continue;
        }
        const bool is_new = received_ == entries_;
        const EntryVerdict verdict = receiveVerdict();
        if (is_new) {
            ++entries_;
            return last_ = verdict;
        }
        if (verdict.kind != EntryVerdict::Kind::Sound) {
            return broken(file_.string() + ": changed while it was read, before entry " +
                          std::to_string(entries_));
        }
    }
}

}  // namespace hagen::recordings
