#pragma once
#include <hagen/recordings/BrokenRecording.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>
#include <cstddef>
#include <filesystem>

#include <memory>
#include <stdexcept>

namespace hagen::recordings {

/// Reads a rawlog entry by entry and holds one in memory: uncompressed, gzip or zstd, as MRPT
/// before and since version 3 writes it. An entry is an object of the file: an observation, an
/// action collection, a sensory frame (whose observations may be null), or any other. Each entry is
/// first read by a process of its own: what MRPT's reader does with corrupt data (crash, take all
/// memory) is an entry that cannot be read, as any other.
class RawlogReader {
 public:
    /// Throws std::runtime_error naming the file if it cannot be opened or is empty, or if no
    /// process can be started.
    explicit RawlogReader(const std::filesystem::path& file);
    ~RawlogReader();
    RawlogReader(const RawlogReader&) = delete;
    RawlogReader& operator=(const RawlogReader&) = delete;

    /// The next entry, or nullptr at the end. Throws BrokenRecording.
    mrpt::serialization::CSerializable::Ptr next();

    /// Entries read so far.
    std::size_t entries() const;
    /// Fraction of the file read so far, 0 ... 1.
    double fractionRead() const;

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace hagen::recordings
