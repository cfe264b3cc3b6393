#include <hagen/observations/RawlogWriter.h>

#include <stdexcept>

namespace hagen {

RawlogWriter::RawlogWriter(const std::filesystem::path& file, bool overwrite)
    : path_(file, OutputPath::Kind::File, overwrite) {
    if (!stream_.open(path_.temporary().string())) {
        throw std::runtime_error(path_.temporary().string() + ": cannot be written");
    }
    archive_ = mrpt::serialization::archiveUniquePtrFrom(stream_);
}

void RawlogWriter::write(const mrpt::serialization::CSerializable& entry) {
    try {
        *archive_ << entry;
    } catch (const std::exception&) {
        throw std::runtime_error(path_.path().string() + ": cannot be written; is the disk full?");
    }
}

void RawlogWriter::commit() {
    stream_.close();
    path_.commit();
}

std::filesystem::path RawlogWriter::keepPartial() {
    stream_.close();
    return path_.keepPartial();
}

}  // namespace hagen
