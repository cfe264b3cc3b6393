#pragma once
#include <hagen/base/OutputPath.h>
#include <mrpt/serialization/CSerializable.h>
#include <filesystem>
#include "convert/GzipOutput.h"

namespace hagen::convert {

/// Appends an entry, serialised as in a rawlog.
void serialise(const mrpt::serialization::CSerializable& entry, Bytes& bytes);

/// Writes a rawlog, renamed into place when complete.
///
/// Entries are compressed in gzip members of at least 256 KiB uncompressed. No entry spans two
/// members. Boundaries depend only on the entries, so the same entries produce the same bytes.
class RawlogWriter {
 public:
    /// Throws std::runtime_error naming the file; see OutputPath.
    RawlogWriter(const std::filesystem::path& file, bool overwrite);

    const base::OutputPath& place() const { return path_; }
    /// Throws std::runtime_error naming the file if the entry cannot be written. A full disk may be
    /// reported after further entries, or only by commit().
    void write(const mrpt::serialization::CSerializable& entry);

    /// The steps of write(), for use on several threads. serialise() and packGzipMember() may run
    /// on every thread. gather() and writeMember() must be called in the log's order; they may run
    /// concurrently with each other.
    ///
    /// Adds entries that must stay in one member. A completed member is appended to `member`.
    /// `entries` is then unspecified.
    void gather(Bytes& entries, Bytes& member);
    /// Writes a member compressed by packGzipMember().
    void writeMember(const Bytes& packed);

    /// Completes the file and renames it into place.
    void commit();
    /// Completes the file as OUT.partial.rawlog and returns that name. After a failed write, the
    /// file ends with the last complete member. Throws std::runtime_error if it has no member.
    std::filesystem::path keepPartial();

 private:
    void finish();

    base::OutputPath path_;
    GzipOutput file_;
    Bytes gathered_;  ///< entries of an incomplete member
    bool is_empty_ = true, has_failed_ = false, is_finished_ = false;
    Bytes entry_, member_, packed_;  // buffers of write(), reused
};

}  // namespace hagen::convert
