#include "recordings/clouds/CloudFile.h"
#include "base/FileKind.h"
#include "base/Text.h"

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

bool isPly(const Bytes& bytes) {
    const auto line = TextLines(bytes).next();
    return line && startsWith(bytes, "ply") && wordsOf(*line)[0] == "ply";
}

/// True if the first line that is not a comment starts like a PCD header.
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

/// Detects the format by the first bytes of a file. A .bin requires all bytes, read by `read_all`.
template <class ReadAll>
std::optional<CloudFormat> formatOf(const Bytes& start, const ReadAll& read_all) {
    if (isPly(start)) return CloudFormat::Ply;
    if (startsWith(start, "LASF")) return CloudFormat::Las;
    if (startsWith(start, "\x93NUMPY")) return CloudFormat::Npy;
    if (isPcd(start)) return CloudFormat::Pcd;
    if (!mayBeBin(start)) return std::nullopt;
    const Bytes& bytes = read_all();
    const std::size_t numbers = binNumbersPerPoint(bytes);
    const bool is_bin = numbers > 0 && bytes.size() % (sizeof(float) * numbers) == 0;
    return is_bin ? std::optional(CloudFormat::Bin) : std::nullopt;
}

std::string extensionOf(const std::filesystem::path& file) {
    return base::lowerCase(file.extension().string());
}

CloudFile readUnchecked(const std::filesystem::path& file, const BinFields& bin_fields) {
    Bytes bytes = readBytes(file);
    if (!bin_fields.empty() && extensionOf(file) == ".bin") {
        return readBin(file, std::move(bytes), bin_fields);
    }
    const Bytes start(bytes.begin(),
                      bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kStart)));
    const auto format = formatOf(start, [&]() -> const Bytes& { return bytes; });
    if (!format) {
        // An empty or all-zero .bin is a scan without returns. A truncated .bin is treated as a
        // .bin.
        const bool may_be_bin = bytes.size() % 16 != 0 || isAllZero(start);
        const bool is_bin =
            bytes.empty() || mayBeBin(start) || (may_be_bin && otherKindOf(start).empty());
        if (extensionOf(file) == ".bin") {
            if (is_bin) return readBin(file, std::move(bytes));
            checkBinLayout(file, bytes, kKittiNumbers);
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

std::string otherKindOf(const Bytes& bytes) {
    const std::size_t size = std::min(bytes.size(), kStart);
    return base::kindOfBytes({reinterpret_cast<const char*>(bytes.data()), size}).text();
}

std::string whyNoCloud(const Bytes& start) {
    if (start.empty()) return "is empty";
    const std::string known = otherKindOf(start);
    return "is not a point cloud: " +
           (known.empty() ? "its first numbers are not points of a LiDAR" : known) +
           ". Supported: PCD, PLY, LAS, NPY, and .bin of float32 x, y, z, intensity (KITTI), "
           "optionally with ring (nuScenes)";
}

std::optional<CloudFormat> cloudFormatOf(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
    std::ifstream in(file, std::ios::binary);
    Bytes start(kStart);
    in.read(reinterpret_cast<char*>(start.data()), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(in.gcount()));
    try {
        Bytes all;
        return formatOf(start, [&]() -> const Bytes& { return all = readBytes(file); });
    } catch (const BrokenRecording&) {
        return std::nullopt;
    }
}

bool hasCloudName(const std::filesystem::path& file) {
    const std::string extension = extensionOf(file);
    for (const char* const known : {".pcd", ".ply", ".las", ".laz", ".npy", ".bin"}) {
        if (extension == known) return true;
    }
    return false;
}

CloudFile readCloud(const std::filesystem::path& file, const BinFields& bin_fields) {
    CloudFile cloud = readUnchecked(file, bin_fields);
    try {
        check(cloud.table);
    } catch (const std::runtime_error& e) {
        throw BrokenRecording(file.string() + ": " + e.what());
    }
    cloud.table = inNativeOrder(std::move(cloud.table));
    return cloud;
}

}  // namespace hagen::recordings
