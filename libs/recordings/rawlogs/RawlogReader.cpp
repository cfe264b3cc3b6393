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
    std::filesystem::path file;
    std::size_t entries = 0;
    double fraction_read = 0;
};

RawlogReader::RawlogReader(const std::filesystem::path& file) {
    observations::registerMrptClasses();  // before the trial's process starts, which needs them too
    parts_.reset(new Parts{RawlogTrial(checked(file)), file});
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
    try {
        return mrpt::serialization::archiveFrom(stream).ReadObject();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        throw BrokenRecording(parts_->file.string() + ": entry " +
                              std::to_string(parts_->entries - 1) + " cannot be read: " + e.what());
    }
}

}  // namespace hagen::recordings
