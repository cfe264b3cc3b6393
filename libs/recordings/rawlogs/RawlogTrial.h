#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::recordings {

struct EntryVerdict {
    enum class Kind : std::uint8_t { Part, Sound, End, Broken, OutOfMemory };
    Kind kind;
    std::uint64_t end;                ///< uncompressed position after the entry
    double fraction_read;             ///< of the file
    std::vector<std::uint8_t> bytes;  ///< the entry if Sound
    std::string why;                  ///< message with file, entry and byte; only if Broken
};

/// Reads a rawlog in a child process, ahead of the program. If MRPT's reader crashes, throws or
/// exhausts memory on a corrupt entry, only the child ends. The program receives the decompressed
/// entries that the child could read.
///
/// The child is forked without the program's other threads, so a lock held by one of them is never
/// released in the child. If the child uses no CPU time for kTimeout, it is restarted, up to
/// kMaxStarts starts in total.
class RawlogTrial {
 public:
    static constexpr std::chrono::milliseconds kTimeout{10000};
    static constexpr int kMaxStarts = 3;

    /// Opens the file and starts the process. Throws std::runtime_error naming the file.
    explicit RawlogTrial(const std::filesystem::path& file,
                         std::chrono::milliseconds max_idle = kTimeout);
    ~RawlogTrial();
    RawlogTrial(const RawlogTrial&) = delete;
    RawlogTrial& operator=(const RawlogTrial&) = delete;

    /// Waits for the verdict on the next entry. Returns the last verdict again at the end.
    const EntryVerdict& next();

 private:
    void start();
    void stop();
    bool isStuck() const;
    void receive();
    const EntryVerdict& broken(const std::string& why);
    std::string cannotBeRead(const std::string& why) const;
    std::string whyItEnded();

    std::filesystem::path file_;
    int descriptor_ = -1;
    std::chrono::milliseconds max_idle_;
    pid_t process_ = -1;
    int verdicts_ = -1;  ///< pipe
    int starts_ = 0;
    std::size_t received_ = 0;  ///< number of verdicts from the current process
    std::size_t entries_ = 0;
    EntryVerdict last_{EntryVerdict::Kind::Sound, 0, 0, {}, ""};
};

}  // namespace hagen::recordings
