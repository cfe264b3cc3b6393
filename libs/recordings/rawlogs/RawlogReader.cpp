#include <hagen/mrpt/MrptCompat.h>
#include <hagen/recordings/RawlogReader.h>
#include <mrpt/io/CMemoryStream.h>

#include "recordings/rawlogs/RawlogTrial.h"

namespace hagen::recordings {
namespace {

const std::filesystem::path& checked(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) throw std::runtime_error(file.string() + ": no such file");
    if (std::filesystem::file_size(file) == 0) {
        throw std::runtime_error(file.string() + ": is empty");
    }
    return file;
}

}  // namespace

struct RawlogReader::Parts {
    RawlogTrial trial;
    std::size_t entries = 0;
    double fraction_read = 0;
};

RawlogReader::RawlogReader(const std::filesystem::path& file)
    : parts_(new Parts{RawlogTrial(checked(file))}) {
    observations::registerMrptClasses();
}
RawlogReader::~RawlogReader() = default;

std::size_t RawlogReader::entries() const { return parts_->entries; }

double RawlogReader::fractionRead() const { return parts_->fraction_read; }

mrpt::serialization::CSerializable::Ptr RawlogReader::next() {
    const EntryVerdict& verdict = parts_->trial.next();
    parts_->fraction_read = verdict.fraction_read;
    if (verdict.kind == EntryVerdict::Kind::End) return nullptr;
    if (verdict.kind == EntryVerdict::Kind::Broken) throw BrokenRecording(verdict.why);
    ++parts_->entries;
    mrpt::io::CMemoryStream stream;
    stream.assignMemoryNotOwn(verdict.bytes.data(), verdict.bytes.size());
    return mrpt::serialization::archiveFrom(stream).ReadObject();
}

}  // namespace hagen::recordings
