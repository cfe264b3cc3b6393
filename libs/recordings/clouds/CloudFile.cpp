#include <hagen/base/ReadFile.h>
#include <hagen/recordings/CloudFile.h>

#include <hagen/base/FileKind.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "recordings/clouds/Readers.h"

namespace hagen::recordings {
namespace {

bool startsWith(const Bytes& bytes, std::string_view text) {
    return bytes.size() >= text.size() &&
           std::equal(text.begin(), text.end(), bytes.begin(), [](char c, std::uint8_t byte) {
               return static_cast<std::uint8_t>(c) == byte;
           });
}

/// The first line that is no comment begins like those of a PCD header.
bool isPcd(const Bytes& bytes) {
    TextLines lines(bytes);
    while (const auto line = lines.next()) {
        const auto words = wordsOf(*line);
        if (words.empty() || words[0][0] == '#') {
            if (line->substr(0, 6) == "# .PCD") return true;
            continue;
        }
        return words[0] == "VERSION" || words[0] == "FIELDS" || words[0] == "COLUMNS";
    }
    return false;
}

std::optional<CloudFormat> formatOf(const Bytes& start, std::size_t size) {
    if (startsWith(start, "ply\n") || startsWith(start, "ply\r")) return CloudFormat::Ply;
    if (startsWith(start, "LASF")) return CloudFormat::Las;
    if (startsWith(start, "\x93NUMPY")) return CloudFormat::Npy;
    if (isPcd(start)) return CloudFormat::Pcd;
    const BinPoint point = binPointOf(start);
    const bool may_be_four = point == BinPoint::Four || point == BinPoint::FourOrFive;
    const bool may_be_five =
        point == BinPoint::Five || point == BinPoint::FourOrFive || point == BinPoint::FiveOrNone;
    const bool is_bin = (may_be_four && size % (4 * sizeof(float)) == 0) ||
                        (may_be_five && size % (5 * sizeof(float)) == 0);
    return is_bin ? std::optional(CloudFormat::Bin) : std::nullopt;
}

std::string extensionOf(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return extension;
}

/// "it seems to be a JPEG picture"; empty if it is of no kind that is known.
std::string otherKindOf(const Bytes& start) {
    return base::kindOfBytes({reinterpret_cast<const char*>(start.data()), start.size()}).text();
}

CloudFile readUnchecked(const std::filesystem::path& file) {
    Bytes bytes = readBytes(file);
    const Bytes start(bytes.begin(),
                      bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kStart)));
    const auto format = formatOf(start, bytes.size());
    if (!format) {
        // An empty .bin, or of zeros, is a scan without returns, and one that was cut still a .bin.
        const bool may_be_bin = bytes.size() % 16 != 0 || isAllZero(start);
        const bool is_bin = bytes.empty() || binPointOf(start) != BinPoint::None ||
                            (may_be_bin && otherKindOf(start).empty());
        if (extensionOf(file) == ".bin" && is_bin) {
            return readBin(file, std::move(bytes));
        }
        throw BrokenRecording(file.string() + ": " + whyNoCloud(start));
    }
    switch (*format) {
        case CloudFormat::Pcd:
            return readPcd(file, std::move(bytes));
        case CloudFormat::Ply:
            return readPly(file, bytes);
        case CloudFormat::Las:
            return readLas(file, bytes);
        case CloudFormat::Npy:
            return readNpy(file, std::move(bytes));
        case CloudFormat::Bin:
            break;
    }
    return readBin(file, std::move(bytes));
}

}  // namespace

std::string whyNoCloud(const Bytes& start) {
    if (start.empty()) return "is empty";
    const std::string known = otherKindOf(start);
    return "is no point cloud: " +
           (known.empty() ? "its first numbers are no points that a LiDAR sees" : known) +
           ". Known are PCD, PLY, LAS, NPY, and .bin of float32 x, y, z, intensity (KITTI), or "
           "also ring (nuScenes)";
}

std::optional<CloudFormat> cloudFormatOf(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
    const auto size = static_cast<std::size_t>(std::filesystem::file_size(file, error));
    std::ifstream in(file, std::ios::binary);
    Bytes start(std::min(size, kStart));
    in.read(reinterpret_cast<char*>(start.data()), static_cast<std::streamsize>(start.size()));
    if (error || !in) return std::nullopt;
    return formatOf(start, size);
}

bool hasCloudName(const std::filesystem::path& file) {
    const std::string extension = extensionOf(file);
    for (const char* const known : {".pcd", ".ply", ".las", ".laz", ".npy", ".bin"}) {
        if (extension == known) return true;
    }
    return false;
}

BinStart startOfBin(const std::filesystem::path& file) {
    std::ifstream in = base::openToRead(file);
    Bytes bytes(kStart);
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
    BinPoint point = binPointOf(bytes);
    BinStart start;
    if (point == BinPoint::None) start.other_kind = otherKindOf(bytes);
    const bool begins_with_zeros = bytes.size() == kStart && isAllZero(bytes);
    if (point == BinPoint::FourOrFive || point == BinPoint::FiveOrNone || begins_with_zeros) {
        const Bytes all = readBytes(file);
        if (begins_with_zeros) point = binPointOf(tellingBytes(all));
        const bool may_be_none = point == BinPoint::FiveOrNone;
        point = binPointOf(point, all);
        if (may_be_none && point == BinPoint::None) {
            start.other_kind = "its points have a fifth number that is no ring";
        }
    }
    start.floats_per_point = point == BinPoint::Five ? 5 : 4;
    return start;
}

CloudFile readCloud(const std::filesystem::path& file) {
    CloudFile cloud = readUnchecked(file);
    try {
        check(cloud.table);
    } catch (const std::runtime_error& e) {
        throw BrokenRecording(file.string() + ": " + e.what());
    }
    cloud.table = inNativeOrder(std::move(cloud.table));
    return cloud;
}

}  // namespace hagen::recordings
