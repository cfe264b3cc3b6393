#include <hagen/logs/RawlogWriter.h>

namespace hagen {

RawlogWriter::RawlogWriter(const std::filesystem::path& file, bool overwrite)
    : path_(file, OutputPath::Kind::File, overwrite),
      stream_(path_.temporary()),
      archive_(mrpt::serialization::archiveUniquePtrFrom(stream_)) {}

void RawlogWriter::write(const mrpt::serialization::CSerializable& entry) { *archive_ << entry; }

void RawlogWriter::commit() {
    stream_.close();
    path_.commit();
}

std::filesystem::path RawlogWriter::keepPartial() {
    stream_.close();
    return path_.keepPartial();
}

}  // namespace hagen
