#include <hagen/observations/MrptCompat.h>
#include <hagen/observations/RawlogReader.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <string>

namespace hagen {
namespace {

bool isClassName(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || (c != 0 && std::strchr("_:<>,", c) != nullptr);
    });
}

/// The words of an MRPT exception that a user can use, out of its back traces.
std::string reasonOf(const std::exception& exception) {
    const std::string text = exception.what();
    if (text.find("(EOF?)") != std::string::npos) return "the file ends in the middle of it";
    const std::string mark = "Stored object has class '";
    const std::size_t start = text.find(mark);
    if (start != std::string::npos) {
        const std::size_t name = start + mark.size();
        const std::string class_name = text.substr(name, text.find('\'', name) - name);
        if (isClassName(class_name)) {
            return "it is of class '" + class_name + "', which this program does not know";
        }
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
