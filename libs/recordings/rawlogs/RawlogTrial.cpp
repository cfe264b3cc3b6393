#include "recordings/rawlogs/RawlogTrial.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include "base/ProcessCost.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "recordings/rawlogs/EntryReader.h"

namespace hagen::recordings {
namespace {

/// The header of a message in the pipe. `text` bytes with the reason follow.
struct VerdictHeader {
    EntryVerdict::Kind kind;
    std::uint64_t end;
    std::uint32_t text;
};
constexpr std::size_t kMaxTextLength = 4096;

/// MRPT objects need more memory than in a rawlog: an empty pointer or text has 4 bytes in the file
/// and up to 32 in memory, and vectors double when they grow.
constexpr std::uint64_t kMemoryPerByte = 32, kMemoryBesides = 64 << 20;

/// Calls read() or write() until all bytes are transferred. Returns false at the end of the pipe.
template <class Call, class Byte>
bool transfer(Call call, int pipe, Byte* at, std::size_t size) {
    while (size > 0) {
        const ssize_t done = call(pipe, at, size);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return false;
        at += done;
        size -= static_cast<std::size_t>(done);
    }
    return true;
}

void send(int pipe, EntryVerdict::Kind kind, std::uint64_t end, const std::string& why = "") {
    const std::size_t text = std::min(why.size(), kMaxTextLength);
    const VerdictHeader header{kind, end, static_cast<std::uint32_t>(text)};
    const bool is_sent =
        transfer(write, pipe, reinterpret_cast<const char*>(&header), sizeof header) &&
        transfer(write, pipe, why.data(), text);
    if (!is_sent) _exit(0);
}

/// Private memory of this process [bytes]; 0 if unknown.
std::uint64_t dataBytes() {
    unsigned long long pages = 0;
    std::FILE* const file = std::fopen("/proc/self/statm", "r");
    if (file == nullptr) return 0;
    const bool is_read = std::fscanf(file, "%*u %*u %*u %*u %*u %llu", &pages) == 1;
    std::fclose(file);
    return is_read ? pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

/// Waits until a pipe has data or is closed. Returns false at the timeout, which signals do not
/// extend.
bool isReadable(int pipe, std::chrono::milliseconds max_idle) {
    using Clock = std::chrono::steady_clock;
    for (const auto end = Clock::now() + max_idle;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
        pollfd waits{pipe, POLLIN, 0};
        const int ready = poll(&waits, 1, std::max(0, static_cast<int>(left.count())));
        if (ready == 0) return false;
        if (ready > 0 || errno != EINTR) return true;
    }
}

/// Limits memory to what the next entry can need, given the rest of the file. Returns true if the
/// program's own limit is lower.
bool limitMemory(const PackedInput& stream, const rlimit& of_program) {
    constexpr std::uint64_t kShadow = std::uint64_t{1} << 40;  // shadow memory of a sanitizer
    const std::uint64_t now = dataBytes();
    if (now == 0 || now > kShadow) return false;
    const std::uint64_t left = std::min(stream.mostBytesLeft(), kMaxEntryBytes);
    const std::uint64_t more = std::min(kMaxEntryBytes, kMemoryBesides + kMemoryPerByte * left);
    const rlimit limit{std::min<rlim_t>(now + more, of_program.rlim_cur), of_program.rlim_max};
    setrlimit(RLIMIT_DATA, &limit);
    return of_program.rlim_cur < now + more;
}

/// Reads all entries and sends a verdict on each of them.
[[noreturn]] void tryAll(const std::filesystem::path& file, const std::filesystem::path& opened,
                         int pipe) {
    bool is_limit_of_program = false;
    try {
        rlimit limit{};
        getrlimit(RLIMIT_DATA, &limit);
        EntryReader reader(file, opened);
        for (;;) {
            is_limit_of_program = limitMemory(reader.stream(), limit);
            const auto object = reader.next();
            const std::uint64_t end = reader.stream().getPosition();
            if (!object) {
                send(pipe, EntryVerdict::Kind::End, end);
                _exit(0);
            }
            send(pipe, EntryVerdict::Kind::Sound, end);
        }
    } catch (const OutOfMemory& e) {
        const char* const limit = is_limit_of_program ? " or --memory-limit" : "";
        send(pipe, EntryVerdict::Kind::Broken, 0, std::string(e.what()) + limit);
    } catch (const std::exception& e) {
        send(pipe, EntryVerdict::Kind::Broken, 0, e.what());
    }
    _exit(0);
}

/// Runs in the child process, which keeps only the descriptors of the rawlog and the pipe.
[[noreturn]] void runTrial(const std::filesystem::path& file, int descriptor, int pipe) {
    setpgid(0, 0);
    // The program stops this process. Crashes must not write core files.
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) signal(number, SIG_IGN);
    for (const int number : {SIGPIPE, SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) signal(number, SIG_DFL);
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    // The program itself prints MRPT's warnings when it reads the entry.
    const int silence = open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(silence, stream);
    constexpr int kRawlog = 3, kPipe = 4;
    const int high_rawlog = fcntl(descriptor, F_DUPFD, 10), high_pipe = fcntl(pipe, F_DUPFD, 10);
    dup2(high_rawlog, kRawlog);
    dup2(high_pipe, kPipe);
    close_range(kPipe + 1, ~0U, 0);
    // Reopened, because the program's reading moves the shared position, and by descriptor, because
    // the name may refer to another file by now.
    tryAll(file, "/proc/self/fd/" + std::to_string(kRawlog), kPipe);
}

}  // namespace

RawlogTrial::RawlogTrial(const std::filesystem::path& file, int descriptor,
                         std::chrono::milliseconds max_idle)
    : file_(file), descriptor_(descriptor), max_idle_(max_idle) {
    start();
}

RawlogTrial::~RawlogTrial() { stop(); }

void RawlogTrial::start() {
    int pipe[2];
    if (pipe2(pipe, O_CLOEXEC) != 0) {
        throw std::runtime_error(
            file_.string() + ": cannot be read: creating a pipe failed: " + std::strerror(errno));
    }
    process_ = fork();
    if (process_ == 0) runTrial(file_, descriptor_, pipe[1]);
    const int error = errno;
    close(pipe[1]);
    if (process_ < 0) {
        close(pipe[0]);
        throw std::runtime_error(file_.string() +
                                 ": cannot be read: starting a process to check its entries failed "
                                 "(ulimit -u?): " +
                                 std::strerror(error));
    }
    verdicts_ = pipe[0];
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
    for (;;) {
        const auto before = base::cpuTimeOf(process_);
        if (isReadable(verdicts_, max_idle_)) return false;
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
    // The exit status is lost, for example because the program ignores SIGCHLD.
    if (ended < 0) return cannotBeRead("MRPT's reader crashed or exited");
    return cannotBeRead("MRPT's reader " +
                        (WIFSIGNALED(status)
                             ? std::string("crashed (") + strsignal(WTERMSIG(status)) + ")"
                             : "exited"));
}

EntryVerdict RawlogTrial::receiveVerdict() {
    VerdictHeader header;
    if (!transfer(read, verdicts_, reinterpret_cast<char*>(&header), sizeof header)) {
        return {EntryVerdict::Kind::Broken, last_.end, whyItEnded()};
    }
    EntryVerdict verdict{header.kind, header.end, std::string(header.text, '\0')};
    if (!transfer(read, verdicts_, verdict.why.data(), header.text)) {
        verdict.why = "unknown error";
    }
    ++received_;
    return verdict;
}

EntryVerdict RawlogTrial::next() {
    if (last_.kind != EntryVerdict::Kind::Sound) return last_;
    const auto broken = [this](const std::string& why) {
        return last_ = {EntryVerdict::Kind::Broken, last_.end, why};
    };
    for (;;) {
        if (isStuck()) {
            stop();
            if (starts_ == kMaxStarts) {
                return broken(cannotBeRead("MRPT's reader hangs"));
            }
            try {
                start();
            } catch (const std::runtime_error& e) {
                return broken(e.what());
            }
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
