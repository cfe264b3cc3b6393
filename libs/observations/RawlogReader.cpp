#include <hagen/observations/MrptCompat.h>
#include <hagen/observations/RawlogReader.h>

#include <fstream>
#include <regex>
#include <string>

namespace hagen {
namespace {

/// The words of an MRPT exception that a user can use, out of its back traces.
std::string reasonOf(const std::exception& exception) {
    const std::string text = exception.what();
    if (text.find("(EOF?)") != std::string::npos) return "the file ends in the middle of it";
    static const std::regex unknown_class("has class '([\\w:<>, ]+)' which is not registered");
    std::smatch match;
    if (std::regex_search(text, match, unknown_class)) {
        return "it is of class '" + match[1].str() + "', which this program does not know";
    }
    return "it is no MRPT object";
}

void checkReadable(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) throw std::runtime_error(file.string() + ": no such file");
    if (!std::ifstream(file)) throw std::runtime_error(file.string() + ": cannot be read");
    if (std::filesystem::file_size(file) == 0) {
        throw std::runtime_error(file.string() + ": is empty");
    }
}

}  // namespace

RawlogReader::RawlogReader(const std::filesystem::path& file) : file_(file) {
    checkReadable(file);
    registerMrptClasses();
    if (!stream_.open(file.string())) {
        throw std::runtime_error(file.string() + ": cannot be opened as a rawlog");
    }
    archive_ = mrpt::serialization::archiveUniquePtrFrom(stream_);
}

mrpt::serialization::CSerializable::Ptr RawlogReader::next() {
    const auto byte = stream_.getPosition();
    try {
        auto object = archive_->ReadObject();
        ++entries_;
        return object;
    } catch (const mrpt::serialization::CExceptionEOF&) {
        if (entries_ == 0) throw BrokenRawlog(file_.string() + ": holds no entry of a rawlog");
        return nullptr;
    } catch (const std::exception& e) {
        throw BrokenRawlog(file_.string() + ": entry " + std::to_string(entries_) + " at byte " +
                           std::to_string(byte) + " (unpacked) cannot be read: " + reasonOf(e));
    }
}

}  // namespace hagen
