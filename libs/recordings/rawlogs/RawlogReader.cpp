#include <hagen/recordings/RawlogReader.h>

#include <fstream>

#include "recordings/rawlogs/EntryReader.h"
#include "recordings/rawlogs/RawlogTrial.h"

namespace hagen::recordings {
namespace {

const std::filesystem::path& checked(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) throw std::runtime_error(file.string() + ": no such file");
    if (!std::ifstream(file)) throw std::runtime_error(file.string() + ": cannot be read");
    if (std::filesystem::file_size(file) == 0) {
        throw std::runtime_error(file.string() + ": is empty");
    }
    return file;
}

}  // namespace

struct RawlogReader::Parts {
    std::filesystem::path file;
    EntryReader reader;
    RawlogTrial trial;

    explicit Parts(const std::filesystem::path& name)
        : file(checked(name)), reader(name, name), trial(name, reader.stream().descriptor()) {}
};

RawlogReader::RawlogReader(const std::filesystem::path& file)
    : parts_(std::make_unique<Parts>(file)) {}
RawlogReader::~RawlogReader() = default;

std::size_t RawlogReader::entries() const { return parts_->reader.entries(); }

double RawlogReader::fractionRead() const {
    const PackedInput& stream = parts_->reader.stream();
    return static_cast<double>(stream.packedPosition()) / static_cast<double>(stream.packedBytes());
}

mrpt::serialization::CSerializable::Ptr RawlogReader::next() {
    const EntryVerdict verdict = parts_->trial.next();
    if (verdict.kind == EntryVerdict::Kind::End) return nullptr;
    if (verdict.kind == EntryVerdict::Kind::Broken) throw BrokenRecording(verdict.why);
    const auto object = parts_->reader.next();
    if (!object || parts_->reader.stream().getPosition() != verdict.end) {
        throw BrokenRecording(parts_->file.string() + ": changed while it was read, at entry " +
                              std::to_string(entries()));
    }
    return object;
}

}  // namespace hagen::recordings
