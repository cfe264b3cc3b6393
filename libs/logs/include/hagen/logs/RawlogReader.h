#pragma once
#include <hagen/logs/PackedInput.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>
#include <cstddef>
#include <filesystem>

#include <memory>
#include <stdexcept>

namespace hagen::logs {

/// A rawlog that is truncated or has an entry that cannot be read. The message names the file, the
/// entry and its byte offset.
struct BrokenRawlog : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Reads a rawlog entry by entry and holds one in memory: uncompressed, gzip or zstd, as MRPT
/// before and since version 3 writes it. An entry is an object of the file: an observation, an
/// action collection, a sensory frame, or any other.
class RawlogReader {
 public:
    /// Throws std::runtime_error naming the file if it cannot be opened or is empty.
    explicit RawlogReader(const std::filesystem::path& file);

    /// The next entry, or nullptr at the end. Throws BrokenRawlog.
    mrpt::serialization::CSerializable::Ptr next();

    /// Entries read so far.
    std::size_t entries() const { return entries_; }
    /// Fraction of the file read so far, 0 ... 1.
    double fractionRead() const;

 private:
    std::filesystem::path file_;
    PackedInput stream_;
    mrpt::serialization::CArchive::UniquePtr archive_;
    std::size_t entries_ = 0;
};

}  // namespace hagen::logs
