#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

namespace hagen::recordings {

struct EntryVerdict {
    enum class Kind : std::uint8_t { Sound, End, Broken, OutOfMemory };
    Kind kind;
    std::uint64_t end;  ///< uncompressed position after the entry
    std::string why;    ///< message with file, entry and byte; only if Broken
};

/// Reads a rawlog in a child process, ahead of the program. If MRPT's reader crashes, throws or
/// exhausts memory on a corrupt entry, only the child ends. The program reads only entries that the
/// child could read.
///
/// The child is forked without the program's other threads, so a lock held by one of them is never
/// released in the child. If the child uses no CPU time for kTimeout, it is restarted, up to
/// kMaxStarts starts in total.
class RawlogTrial {
 public:
    static constexpr std::chrono::milliseconds kTimeout{10000};
    static constexpr int kMaxStarts = 3;

    /// Starts the process. Throws std::runtime_error if it cannot be started. `file`: name in
    /// messages. `descriptor`: the open file, owned by the caller; must outlive this object.
    RawlogTrial(const std::filesystem::path& file, int descriptor,
                std::chrono::milliseconds max_idle = kTimeout);
    ~RawlogTrial();
    RawlogTrial(const RawlogTrial&) = delete;
    RawlogTrial& operator=(const RawlogTrial&) = delete;

    /// Waits for the verdict on the next entry. Returns the last verdict again at the end.
    EntryVerdict next();

 private:
    void start();
    void stop();
    bool isStuck() const;
    EntryVerdict receiveVerdict();
    std::string cannotBeRead(const std::string& why) const;
    std::string whyItEnded();

    std::filesystem::path file_;
    int descriptor_;
    std::chrono::milliseconds max_idle_;
    pid_t process_ = -1;
    int verdicts_ = -1;
    int starts_ = 0;
    std::size_t received_ = 0;  ///< number of verdicts from the current process
    std::size_t entries_ = 0;
    EntryVerdict last_{EntryVerdict::Kind::Sound, 0, ""};
};

}  // namespace hagen::recordings
