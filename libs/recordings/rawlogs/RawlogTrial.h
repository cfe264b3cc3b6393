#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

namespace hagen::recordings {

/// What came of the trial of an entry.
struct EntryVerdict {
    enum class Kind : std::uint8_t { Sound, End, Broken };
    Kind kind;
    std::uint64_t end;  ///< byte after the entry (uncompressed)
    std::string why;    ///< of Broken, with file, entry and byte
};

/// Reads a rawlog in a process of its own, ahead of the program. What MRPT's reader does with an
/// entry that is corrupt (crash, throw anything, ask for any amount of memory) ends that process,
/// never the program, which reads only entries that were read there.
///
/// The process starts as a copy of the program without its other threads: a lock that one of these
/// holds at that moment is never released there. If the process waits for a lock and does nothing
/// else for kPatience, another one takes its place, up to kMostStarts in all. Where the system does
/// not tell for what it waits, it has ten times as long.
class RawlogTrial {
 public:
    static constexpr std::chrono::milliseconds kPatience{3000};
    static constexpr int kMostStarts = 3;

    /// Starts the process. Throws std::runtime_error if that is not possible.
    /// @param file for messages.
    /// @param descriptor the open file; stays the caller's, and open as long as this.
    RawlogTrial(const std::filesystem::path& file, int descriptor,
                std::chrono::milliseconds patience = kPatience);
    ~RawlogTrial();
    RawlogTrial(const RawlogTrial&) = delete;
    RawlogTrial& operator=(const RawlogTrial&) = delete;

    /// The verdict on the next entry; waits for it. The last one is repeated.
    EntryVerdict next();

 private:
    void start();
    void stop();
    bool standsStill() const;
    bool receive(void* data, std::size_t size) const;
    EntryVerdict receiveVerdict();
    std::string cannotBeRead(const std::string& why) const;
    std::string whyItEnded();

    std::filesystem::path file_;
    int descriptor_;
    std::chrono::milliseconds patience_;
    pid_t process_ = -1;
    int verdicts_ = -1;
    int starts_ = 0;
    std::size_t received_ = 0;  ///< verdicts from the process that runs
    std::size_t entries_ = 0;   ///< verdicts that were told
    EntryVerdict last_{EntryVerdict::Kind::Sound, 0, ""};
};

}  // namespace hagen::recordings
