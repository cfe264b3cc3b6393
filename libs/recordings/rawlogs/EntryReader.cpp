#include "recordings/rawlogs/EntryReader.h"

#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/MrptMessage.h>
#include "base/FileKind.h"

#include <new>

namespace hagen::recordings {
namespace {

constexpr const char* kNoObject = "it is not an MRPT object";

/// Derives from MRPT's message why an entry is unreadable.
std::string reasonOf(const std::exception& exception) {
    const std::string text = observations::messageOf(exception);
    if (text.find("(EOF?)") != std::string::npos) return "the file ends within it";
    if (text.find("is not registered") != std::string::npos) {
        return text + " (this program supports the classes of mrpt-obs and mrpt-maps)";
    }
    if (text.find("ersion") != std::string::npos) return text + " (written by a newer MRPT?)";
    // MRPT 3 reports a rotating scan that is valid but stored in another file.
    if (text.find("--de-externalize") != std::string::npos) return text;
    return kNoObject;
}

/// The message for a file that is not a rawlog. Names the likely format.
std::string whyNone(const std::filesystem::path& file) {
    const base::FileKind kind = base::kindOfFile(file);
    const std::string known = kind.text();
    // PackedInput has already decompressed these.
    const bool is_packed = kind.what == "gzip-compressed" || kind.what == "zstd-compressed";
    if (is_packed) return "it is " + kind.what + ", but contains no rawlog; " + kind.advice;
    return (known.empty() ? "its format is unknown" : known) +
           ". Supported: rawlogs, captures (.pcap, .pcapng), ROS recordings (.bag, .mcap, .db3) "
           "and point clouds (.pcd, .ply, .las, .npy, .bin)";
}

}  // namespace

EntryReader::EntryReader(const std::filesystem::path& file, PackedInput& stream)
    : file_(file), stream_(stream), archive_(mrpt::serialization::archiveUniquePtrFrom(stream_)) {
    observations::registerMrptClasses();
}

mrpt::serialization::CSerializable::Ptr EntryReader::next() {
    const std::uint64_t byte = stream_.getPosition();
    const auto broken = [&](const std::string& why) {
        return BrokenRecording(
            file_.string() + ": entry " + std::to_string(entries_) + " at byte " +
            std::to_string(byte) +
            " (uncompressed) cannot be read: " + (stream_.fault().empty() ? why : stream_.fault()));
    };
    mrpt::serialization::CSerializable::Ptr object;
    try {
        object = archive_->ReadObject();
    } catch (const mrpt::serialization::CExceptionEOF&) {
        if (!stream_.fault().empty()) throw broken("");
        if (stream_.getPosition() != byte) throw broken("the file ends within it");
        if (entries_ == 0) throw BrokenRecording(file_.string() + ": contains no rawlog entries");
        return nullptr;
    } catch (const std::bad_alloc&) {
        if (!stream_.fault().empty()) throw broken("");
        throw;
    } catch (const std::exception& e) {
        const std::string reason = reasonOf(e);
        if (entries_ == 0 && reason == kNoObject && stream_.fault().empty()) {
            throw BrokenRecording(file_.string() + ": is not a recording: " + whyNone(file_));
        }
        throw broken(reason);
    } catch (...) {
        throw broken(kNoObject);
    }
    if (!object) throw broken("it is an empty object");
    ++entries_;
    return object;
}

}  // namespace hagen::recordings
