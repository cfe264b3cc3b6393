#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace hagen::logs {

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
class RawlogTrial {
 public:
    /// Starts the process. Throws std::runtime_error if that is not possible.
    /// @param file for messages.
    /// @param descriptor the open file; stays the caller's.
    RawlogTrial(const std::filesystem::path& file, int descriptor);
    ~RawlogTrial();
    RawlogTrial(const RawlogTrial&) = delete;
    RawlogTrial& operator=(const RawlogTrial&) = delete;

    /// The verdict on the next entry; waits for it. The last one is repeated.
    EntryVerdict next();

 private:
    bool receive(void* data, std::size_t size) const;
    std::string whyItEnded();

    std::filesystem::path file_;
    pid_t process_ = -1;
    int verdicts_ = -1;
    std::size_t entries_ = 0;
    EntryVerdict last_{EntryVerdict::Kind::Sound, 0, ""};
};

}  // namespace hagen::logs
