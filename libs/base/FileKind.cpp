#include "base/FileKind.h"
#include "base/Text.h"

#include <algorithm>
#include <fstream>

namespace hagen::base {
namespace {

using namespace std::string_view_literals;

struct Magic {
    std::size_t at;
    std::string_view bytes;
    const char* what;
    const char* advice;
};

constexpr const char* kUnpack = "unpack it first";
constexpr const char* kConvert = "convert it to PCD, PLY, LAS or NPY first";

constexpr Magic kMagics[] = {
    {0, "\xff\xd8\xff"sv, "a JPEG picture", ""},
    {0, "\x89PNG\r\n"sv, "a PNG picture", ""},
    {4, "ftyp"sv, "a video (MP4)", ""},
    {0, "%PDF"sv, "a PDF document", ""},
    {0, "PK\3\4"sv, "a ZIP archive", "unpack it first (an .npz holds .npy files)"},
    {257, "ustar"sv, "a tar archive", kUnpack},
    {0, "\x1f\x8b"sv, "gzip-compressed", kUnpack},
    {0, "\x28\xb5\x2f\xfd"sv, "zstd-compressed", kUnpack},
    {0, "\3757zXZ"sv, "xz-compressed", kUnpack},
    {0, "BZh"sv, "bzip2-compressed", kUnpack},
    {0, "\x89HDF"sv, "an HDF5 file", kConvert},
    {0, "ASTM-E57"sv, "an E57 point cloud file", kConvert},
    {0, "livox_tech"sv, "a recording of the first Livox Viewer (LVX)",
     "record a network capture, a bag or a .lvx2 instead, or convert this file"},
    {0, "ULog\1"sv, "a PX4 flight log (ULog), which has no LiDAR scans", ""},
    {0, "SQLite format 3\0"sv, "an SQLite database", ""},
    {0, "#ROSBAG"sv, "a ROS 1 bag", "pass it with -i"},
    {0, "\x89MCAP"sv, "an MCAP file", "pass it with -i"},
    {0, "\xd4\xc3\xb2\xa1"sv, "a network capture", "pass it with -i"},
    {0, "\x0a\x0d\x0d\x0a"sv, "a network capture", "pass it with -i"},
    {0, "version https://git-lfs"sv, "a Git LFS pointer, not the file itself",
     "fetch it with 'git lfs pull'"},
    {0, "<!DOCTYPE"sv, "a web page (HTML)", "did its download fail?"},
    {0, "<html"sv, "a web page (HTML)", "did its download fail?"},
    {0, "{"sv, "text (JSON)",
     "if it is Ouster metadata, pass it with --sensor-json and the capture with -i"},
};

}  // namespace

std::string FileKind::text() const {
    if (what.empty()) return "";
    return "it seems to be " + what + (advice.empty() ? "" : ": " + advice);
}

bool isText(std::string_view bytes) {
    if (bytes.empty()) return false;
    for (std::size_t at = 0; at < bytes.size();) {
        const auto code = static_cast<unsigned char>(bytes[at]);
        const bool is_space = "\n\r\t\f"sv.find(bytes[at]) != std::string_view::npos;
        const std::size_t length = utf8Length(bytes.substr(at));
        if ((code < 0x20 && !is_space) || code == 0x7f || length == 0) return false;
        at += length;
    }
    return true;
}

FileKind kindOfBytes(std::string_view start) {
    for (const Magic& kind : kMagics) {
        if (start.substr(std::min(kind.at, start.size()), kind.bytes.size()) == kind.bytes) {
            return {kind.what, kind.advice};
        }
    }
    if (!isText(start)) return {};
    return {"text",
            "if it has a point per line, convert it to PCD, PLY, LAS or NPY; pass poses with "
            "--poses"};
}

FileKind kindOfFile(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return {};
    std::ifstream stream(file, std::ios::binary);
    std::string start(kFileKindBytes, '\0');
    stream.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
    return kindOfBytes(start);
}

}  // namespace hagen::base
