#pragma once
#include <hagen/logs/GzipInput.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>
#include <cstddef>
#include <filesystem>

#include <memory>
#include <stdexcept>

namespace hagen::logs {

/// A rawlog that ends in the middle of an entry, or holds one that cannot be read. The message
/// names the file, the entry and its byte.
struct BrokenRawlog : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Reads a rawlog entry by entry, in memory for one entry. An entry is an object of the file: an
/// observation, an action collection, a sensory frame, or whatever else the log holds.
class RawlogReader {
 public:
    /// Throws std::runtime_error, naming the file, where it cannot be opened or is empty.
    explicit RawlogReader(const std::filesystem::path& file);

    /// The next entry, or nullptr at the end. Throws BrokenRawlog.
    mrpt::serialization::CSerializable::Ptr next();

    /// Entries read so far.
    std::size_t entries() const { return entries_; }
    /// How much of the file is read, 0 ... 1.
    double fractionRead() const;

 private:
    std::filesystem::path file_;
    GzipInput stream_;
    mrpt::serialization::CArchive::UniquePtr archive_;
    std::size_t entries_ = 0;
};

}  // namespace hagen::logs
