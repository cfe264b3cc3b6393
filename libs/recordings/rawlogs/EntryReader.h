#pragma once
#include <hagen/recordings/RawlogReader.h>
#include "recordings/rawlogs/PackedInput.h"

namespace hagen::recordings {

/// The most memory that an entry of a rawlog may take while it is read: a scan of 20 million
/// returns with all fields.
constexpr std::uint64_t kMaxEntryBytes = std::uint64_t{1} << 30;

/// More memory than there is: a count is wrong, or the limit is too low.
struct AsksTooMuch : BrokenRecording {
    using BrokenRecording::BrokenRecording;
};

/// Reads a rawlog by MRPT's reader, which trusts what it reads: a wrong count may take all memory,
/// an object that is missing may crash it. RawlogReader is the safe way.
class EntryReader {
 public:
    /// @param file for messages.
    /// @param opened what is opened: the file, by this or another name.
    EntryReader(const std::filesystem::path& file, const std::filesystem::path& opened);

    /// The next entry, or nullptr at the end. Throws BrokenRecording; AsksTooMuch, if that is all
    /// that is wrong.
    mrpt::serialization::CSerializable::Ptr next();

    std::size_t entries() const { return entries_; }
    const PackedInput& stream() const { return stream_; }

 private:
    std::filesystem::path file_;
    PackedInput stream_;
    mrpt::serialization::CArchive::UniquePtr archive_;
    std::size_t entries_ = 0;
};

}  // namespace hagen::recordings
