#include "recordings/rawlogs/RawlogTrial.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include "base/MemoryLimit.h"
#include "base/ProcessCost.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "recordings/rawlogs/EntryReader.h"

namespace hagen::recordings {
namespace {

constexpr int kPipeBytes = 1 << 20;
constexpr std::size_t kMaxWaiting = kPipeBytes / 16;
constexpr std::size_t kMaxKept = std::size_t{64} << 20;  // bytes of memory between entries

/// A message to the program: this, and bytes of the entry or, if Broken, the reason.
struct MessageHead {
    EntryVerdict::Kind kind;
    std::uint64_t end;
    double fraction_read;
    std::size_t size;  ///< bytes that follow
};

/// Calls read() or write() until all bytes are transferred. Returns false if the pipe is closed.
template <class Transfer, class Byte>
bool transferAll(Transfer transfer, int pipe, Byte* bytes, std::size_t size) {
    while (size > 0) {
        const ssize_t done = transfer(pipe, bytes, size);
        if (done == 0 || (done < 0 && errno != EINTR)) return false;
        if (done < 0) continue;
        bytes += done;
        size -= static_cast<std::size_t>(done);
    }
    return true;
}

/// Sends all bytes read from a rawlog to the program.
class SentInput : public PackedInput {
 public:
    SentInput(const std::filesystem::path& file, int pipe) : PackedInput(file), pipe_(pipe) {}

    std::size_t Read(void* buffer, std::size_t count) override {
        const std::size_t done = PackedInput::Read(buffer, count);
        const auto* const bytes = static_cast<const std::uint8_t*>(buffer);
        if (waiting_.size() + done > kMaxWaiting) send(EntryVerdict::Kind::Part);
        if (done > kMaxWaiting) {  // without a copy, which would count as the entry's memory
            send(EntryVerdict::Kind::Part, bytes, done);
        } else {
            waiting_.insert(waiting_.end(), bytes, bytes + done);
        }
        return done;
    }

    void send(EntryVerdict::Kind kind) {
        send(kind, waiting_.data(), waiting_.size());
        waiting_.clear();
    }
    void send(EntryVerdict::Kind kind, const std::uint8_t* bytes, std::size_t size) {
        const double fraction =
            static_cast<double>(packedPosition()) / static_cast<double>(packedBytes());
        const MessageHead head{kind, getPosition(), fraction, size};
        if (!transferAll(write, pipe_, reinterpret_cast<const char*>(&head), sizeof head) ||
            !transferAll(write, pipe_, bytes, size)) {
            _exit(0);
        }
    }
    void sendBroken(std::string_view why) {
        send(EntryVerdict::Kind::Broken, reinterpret_cast<const std::uint8_t*>(why.data()),
             why.size());
    }

 private:
    int pipe_;
    std::vector<std::uint8_t> waiting_;
};

/// Private memory of this process [bytes].
std::uint64_t dataBytes() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t pages = 0;
    for (int field = 0; field < 6; ++field) file >> pages;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// Reads all entries and sends a verdict on each of them.
[[noreturn]] void tryAll(const std::filesystem::path& file, const std::filesystem::path& opened,
                         int pipe) noexcept {
    SentInput input(opened, pipe);
    try {
        EntryReader reader(file, input);
        base::limitMemory(dataBytes() + kMaxEntryBytes);
        while (reader.next()) input.send(EntryVerdict::Kind::Sound);
        input.send(EntryVerdict::Kind::End);
    } catch (const std::bad_alloc&) {
        input.send(EntryVerdict::Kind::OutOfMemory);
    } catch (const std::exception& e) {
        input.sendBroken(e.what());
    }
    _exit(0);
}

/// Runs in the child process, which keeps only the descriptors of the rawlog and the pipe.
[[noreturn]] void runTrial(const std::filesystem::path& file, int descriptor, int pipe) {
    setpgid(0, 0);
    // The program stops this process. Crashes must not write core files.
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) signal(number, SIG_IGN);
    for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) signal(number, SIG_DFL);
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
    // By descriptor, because the name may refer to another file by now.
    tryAll(file, "/proc/self/fd/" + std::to_string(kRawlog), kPipe);
}

}  // namespace

RawlogTrial::RawlogTrial(const std::filesystem::path& file, std::chrono::milliseconds max_idle)
    : file_(file), descriptor_(open(file.c_str(), O_RDONLY | O_CLOEXEC)), max_idle_(max_idle) {
    if (descriptor_ < 0) throw std::runtime_error(file.string() + ": cannot be read");
    try {
        start();
    } catch (...) {
        close(descriptor_);
        throw;
    }
}

RawlogTrial::~RawlogTrial() {
    stop();
    close(descriptor_);
}

void RawlogTrial::start() {
    int ends[2] = {-1, -1};
    process_ = pipe2(ends, O_CLOEXEC) == 0 ? fork() : -1;
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
    fcntl(verdicts_, F_SETPIPE_SZ, kPipeBytes);  // so that the process can read ahead
    received_ = 0;
    last_.bytes.clear();
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

/// Receives a verdict, or a part of its entry, into last_.
void RawlogTrial::receive() {
    MessageHead head;
    std::vector<std::uint8_t>& bytes = last_.bytes;
    const std::size_t start = bytes.size();
    bool is_whole = transferAll(read, verdicts_, reinterpret_cast<char*>(&head), sizeof head);
    if (is_whole) {
        bytes.resize(start + head.size);
        is_whole = transferAll(read, verdicts_, bytes.data() + start, head.size);
    }
    if (!is_whole) {
        broken(whyItEnded());
        return;
    }
    last_.kind = head.kind;
    last_.fraction_read = head.fraction_read;
    if (head.kind == EntryVerdict::Kind::Broken) {
        last_.why.assign(bytes.begin() + static_cast<std::ptrdiff_t>(start), bytes.end());
    } else if (head.kind == EntryVerdict::Kind::OutOfMemory) {
        broken(cannotBeRead("it requests too much memory at byte " + std::to_string(head.end) +
                            ": a count is wrong, or the entry exceeds " +
                            std::to_string(kMaxEntryBytes >> 20) + " MiB or --memory-limit"));
    } else if (head.kind != EntryVerdict::Kind::Part && received_ == entries_) {
        last_.end = head.end;
    }
}

const EntryVerdict& RawlogTrial::broken(const std::string& why) {
    last_.kind = EntryVerdict::Kind::Broken;
    last_.why = why;
    return last_;
}

const EntryVerdict& RawlogTrial::next() {
    if (last_.kind != EntryVerdict::Kind::Sound) return last_;
    if (last_.bytes.capacity() > kMaxKept) last_.bytes = {};
    last_.bytes.clear();
    for (;;) {
        if (isStuck()) {
            stop();
            if (starts_ == kMaxStarts) return broken(cannotBeRead("MRPT's reader hangs"));
            start();
            continue;
        }
        receive();
        if (last_.kind == EntryVerdict::Kind::Part) continue;
        ++received_;
        if (received_ > entries_ || last_.kind == EntryVerdict::Kind::Broken) {
            ++entries_;
            return last_;
        }
        if (last_.kind == EntryVerdict::Kind::End) {
            return broken(file_.string() + ": changed while it was read, before entry " +
                          std::to_string(entries_));
        }
        last_.bytes.clear();  // received before a restart
    }
}

}  // namespace hagen::recordings
