#pragma once
#include <hagen/recordings/RawlogReader.h>
#include "recordings/rawlogs/PackedInput.h"

namespace hagen::recordings {

/// Maximum memory for reading an entry: enough for 20 million returns with all fields.
constexpr std::uint64_t kMaxEntryBytes = std::uint64_t{1} << 30;

/// Reads a rawlog with MRPT's reader, which does not validate its input: a wrong count may exhaust
/// memory, and a missing object may crash the process. Use RawlogReader for safe reading.
class EntryReader {
 public:
    /// `file`: name in messages. `stream` must outlive this object.
    EntryReader(const std::filesystem::path& file, PackedInput& stream);

    /// Returns the next entry, or nullptr at the end. Throws BrokenRecording, or
    /// std::bad_alloc if memory runs out and the file has no other fault.
    mrpt::serialization::CSerializable::Ptr next();

    std::size_t entries() const { return entries_; }

 private:
    std::filesystem::path file_;
    PackedInput& stream_;
    mrpt::serialization::CArchive::UniquePtr archive_;
    std::size_t entries_ = 0;
};

}  // namespace hagen::recordings
