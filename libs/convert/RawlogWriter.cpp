#include "convert/RawlogWriter.h"
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <stdexcept>

namespace hagen::convert {
namespace {

/// Members of this size, about one scan with its clouds, compress as well as a whole file.
constexpr std::size_t kMemberBytes = 1 << 18;

}  // namespace

void serialise(const mrpt::serialization::CSerializable& entry, Bytes& bytes) {
    mrpt::io::CMemoryStream stream;
    mrpt::serialization::archiveFrom(stream) << entry;
    const auto* const first = static_cast<const std::uint8_t*>(stream.getRawBufferData());
    bytes.insert(bytes.end(), first, first + stream.getTotalBytesCount());
}

RawlogWriter::RawlogWriter(const std::filesystem::path& file, bool overwrite)
    : path_(file, base::kFile, overwrite), file_(path_.temporary()) {}

void RawlogWriter::write(const mrpt::serialization::CSerializable& entry) {
    entry_.clear();
    serialise(entry, entry_);
    member_.clear();
    gather(entry_, member_);
    if (member_.empty()) return;
    packGzipMember(member_, packed_);
    writeMember(packed_);
}

void RawlogWriter::gather(Bytes& entries, Bytes& member) {
    if (gathered_.empty()) {
        gathered_.swap(entries);
    } else {
        gathered_.insert(gathered_.end(), entries.begin(), entries.end());
    }
    if (gathered_.size() < kMemberBytes) return;
    if (member.empty()) {
        member.swap(gathered_);
    } else {
        member.insert(member.end(), gathered_.begin(), gathered_.end());
    }
    gathered_.clear();
}

void RawlogWriter::writeMember(const Bytes& packed) {
    has_failed_ = true;
    file_.write(packed);
    has_failed_ = is_empty_ = false;
}

void RawlogWriter::finish() {
    if (is_finished_) return;
    is_finished_ = true;
    if (!gathered_.empty() || is_empty_) {  // because a gzip file needs at least one member
        packGzipMember(gathered_, packed_);
        writeMember(packed_);
    }
    file_.close();
}

void RawlogWriter::commit() {
    finish();
    path_.commit();
}

std::filesystem::path RawlogWriter::keepPartial() {
    if (has_failed_ && is_empty_) throw std::runtime_error(path_.path().string() + ": is empty");
    if (!has_failed_) finish();
    return path_.keepPartial();
}

}  // namespace hagen::convert
