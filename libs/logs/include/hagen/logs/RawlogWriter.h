#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/logs/GzipOutput.h>
#include <mrpt/serialization/CSerializable.h>
#include <filesystem>

namespace hagen::logs {

/// Appends an entry's bytes, as a rawlog holds them.
void serialise(const mrpt::serialization::CSerializable& entry, Bytes& bytes);

/// Writes a rawlog that appears under its name when whole.
///
/// Its entries are packed in gzip members of a quarter of a megabyte or more, cut between entries.
/// Where they are cut depends on the entries alone, so that the same entries give the same bytes.
class RawlogWriter {
 public:
    /// Throws std::runtime_error, naming the file; see OutputPath.
    RawlogWriter(const std::filesystem::path& file, bool overwrite);

    /// Throws std::runtime_error, naming the file, where the entry cannot be written; a full disk
    /// may show some entries late, or with commit() alone.
    void write(const mrpt::serialization::CSerializable& entry);

    /// write() in steps, for who works on several threads: serialise() and packGzipMember() may be
    /// called on any, these two in the log's order; one may be called while the other is.
    ///
    /// Adds entries that stay together. Where they fill a member, it goes into `member`; which is
    /// empty otherwise. `entries` is left with no particular content.
    void gather(Bytes& entries, Bytes& member);
    /// Writes what packGzipMember() made of a member.
    void writeMember(const Bytes& packed);

    /// Ends the file and gives it its name.
    void commit();
    /// Ends the file as OUT.partial.rawlog and returns that name.
    std::filesystem::path keepPartial();

 private:
    void finish();

    base::OutputPath path_;
    GzipOutput file_;
    Bytes gathered_;  ///< entries of a member that is not full
    bool is_empty_ = true;
    Bytes entry_, member_, packed_;  // of write(); kept so that it does not allocate
};

}  // namespace hagen::logs
