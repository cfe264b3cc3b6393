#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

namespace hagen::recordings {

/// Whether an entry could be read.
struct EntryVerdict {
    enum class Kind : std::uint8_t { Sound, End, Broken };
    Kind kind;
    std::uint64_t end;  ///< byte after the entry (uncompressed)
    std::string why;    ///< of Broken, with file, entry and byte
};

/// Reads a rawlog in a child process, ahead of the program. Whatever MRPT's reader does with a
/// corrupt entry (crash, throw anything, request any amount of memory) ends that process only; the
/// program reads only entries that the child could read.
///
/// The child starts as a copy of the program without its other threads: a lock that one of these
/// holds at that moment is never released there. If the child uses no CPU time for kTimeout,
/// another one replaces it, up to kMaxStarts in all.
class RawlogTrial {
 public:
    static constexpr std::chrono::milliseconds kTimeout{10000};
    static constexpr int kMaxStarts = 3;

    /// Starts the process. Throws std::runtime_error if that is not possible.
    /// @param file for messages.
    /// @param descriptor the open file; stays the caller's, and open as long as this.
    RawlogTrial(const std::filesystem::path& file, int descriptor,
                std::chrono::milliseconds patience = kTimeout);
    ~RawlogTrial();
    RawlogTrial(const RawlogTrial&) = delete;
    RawlogTrial& operator=(const RawlogTrial&) = delete;

    /// The verdict on the next entry; waits for it. The last one is repeated.
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
    std::size_t received_ = 0;  ///< verdicts from the process that runs
    std::size_t entries_ = 0;   ///< verdicts returned
    EntryVerdict last_{EntryVerdict::Kind::Sound, 0, ""};
};

}  // namespace hagen::recordings
