#pragma once
#include <hagen/recordings/BrokenRecording.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>
#include <cstddef>
#include <filesystem>

#include <memory>

namespace hagen::recordings {

/// Reads a rawlog (uncompressed, gzip or zstd, written by any MRPT version) and keeps one entry in
/// memory. An entry is an object of the file: an observation, an action collection, a sensory frame
/// (whose observations may be null), or another object. A separate process reads each entry first,
/// so that a crash or excessive allocation of MRPT's reader on corrupt data is reported as an
/// unreadable entry.
class RawlogReader {
 public:
    /// Throws std::runtime_error naming the file if it cannot be opened or is empty, or if the
    /// process cannot be started.
    explicit RawlogReader(const std::filesystem::path& file);
    ~RawlogReader();
    RawlogReader(const RawlogReader&) = delete;
    RawlogReader& operator=(const RawlogReader&) = delete;

    /// Returns the next entry, or nullptr at the end. Throws BrokenRecording.
    mrpt::serialization::CSerializable::Ptr next();

    /// Number of entries read so far.
    std::size_t entries() const;
    /// Fraction of the file read so far, 0 ... 1.
    double fractionRead() const;

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace hagen::recordings
