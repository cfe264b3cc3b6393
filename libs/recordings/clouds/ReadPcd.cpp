#include <lzf.h>

#include <algorithm>

#include "recordings/clouds/PcdHeader.h"
#include "recordings/clouds/Readers.h"

namespace hagen::recordings {
namespace {

using observations::PointField;
using observations::PointTable;

void readAsciiPcd(const std::filesystem::path& file, const PcdHeader& header, const Bytes& bytes,
                  CloudFile& cloud) {
    PointTable& table = cloud.table;
    std::size_t words_per_point = 0;
    for (const PointField& field : header.fields) words_per_point += field.count;
    // A number has at least two bytes of text (with its blank) and at most eight bytes in memory.
    checkRoom(file, header.points, std::max<std::size_t>(2 * words_per_point, 1) - 1,
              bytes.size() - header.size + 1);
    table.bytes.resize(header.points * header.bytes_per_point);
    TextLines lines(bytes);
    while (lines.number() < header.lines) lines.next();
    for (std::size_t i = 0; i < header.points; ++i) {
        std::vector<std::string_view> words;
        while (words.empty()) {
            const auto line = lines.next();
            if (!line) {
                throw BrokenRecording(file.string() + ": the header claims " +
                                      std::to_string(header.points) + " points, but " +
                                      std::to_string(i) + " are present; is it truncated?");
            }
            words = wordsOf(*line);
        }
        if (words.size() != words_per_point) {
            failAt(file, lines.place(),
                   "expected " + std::to_string(words_per_point) + " numbers, found " +
                       std::to_string(words.size()));
        }
        std::size_t word = 0;
        for (const PointField& field : header.fields) {
            std::uint8_t* to = table.bytes.data() + i * header.bytes_per_point + field.offset;
            for (std::size_t k = 0; k < field.count; ++k, ++word, to += bytesOf(field.type)) {
                if (putNumber(words[word], field.type, to)) continue;
                failAt(file, lines.place(),
                       quoted(words[word]) + " is not a valid " + nameOf(field.type) +
                           " for the field '" + field.name + "'");
            }
        }
    }
    cloud.remarks = remarkOnRest(bytes.size() - lines.position());
}

void readBinaryPcd(const std::filesystem::path& file, const PcdHeader& header, Bytes bytes,
                   CloudFile& cloud) {
    const std::size_t there = bytes.size() - header.size;
    checkRoom(file, header.points, header.bytes_per_point, there);
    cloud.remarks = remarkOnRest(there - header.points * header.bytes_per_point);
    bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(header.size));
    bytes.resize(header.points * header.bytes_per_point);
    cloud.table.bytes = std::move(bytes);
}

/// Reads fields that are stored one after the other and compressed with LZF.
void readCompressedPcd(const std::filesystem::path& file, const PcdHeader& header,
                       const Bytes& bytes, CloudFile& cloud) {
    constexpr std::size_t kMaxPerByte = 256;  // a 3-byte reference expands to at most 264 bytes
    const std::size_t sizes = 2 * sizeof(std::uint32_t);
    if (bytes.size() - header.size < sizes) {
        if (header.points == 0) return;
        throw BrokenRecording(file.string() + ": ends before the sizes of its compressed points");
    }
    const auto packed = numberAt<std::uint32_t>(bytes, header.size);
    const auto unpacked = numberAt<std::uint32_t>(bytes, header.size + sizeof(std::uint32_t));
    const std::size_t start = header.size + sizes, there = bytes.size() - start;
    std::size_t plain = 0;
    const bool is_huge = __builtin_mul_overflow(header.points, header.bytes_per_point, &plain);
    if (!is_huge && there + sizes == plain && (packed > there || unpacked != plain)) {
        readBinaryPcd(file, header, bytes, cloud);
        cloud.remarks.emplace_back(
            "its DATA is binary_compressed, but has the size of uncompressed points: read as "
            "binary");
        return;
    }
    if (packed > there) {
        throw BrokenRecording(
            file.string() + ": the header claims " + std::to_string(packed) +
            " compressed bytes, but " + std::to_string(there) + " are left; is it truncated" +
            (!is_huge && there + sizes >= plain ? ", or uncompressed (DATA binary)?" : "?"));
    }
    if (unpacked / kMaxPerByte > packed) {
        throw BrokenRecording(file.string() + ": " + std::to_string(packed) +
                              " compressed bytes cannot expand to " + std::to_string(unpacked));
    }
    checkRoom(file, header.points, header.bytes_per_point, unpacked);
    if (header.points * header.bytes_per_point != unpacked) {
        throw BrokenRecording(file.string() + ": its points have " + std::to_string(unpacked) +
                              " bytes, but the header claims " + std::to_string(header.points) +
                              " points of " + std::to_string(header.bytes_per_point) + " bytes");
    }
    cloud.remarks = remarkOnRest(there - packed);
    if (header.points == 0) return;
    Bytes by_field(unpacked);
    const bool is_packed =
        lzf_decompress(bytes.data() + start, packed, by_field.data(), unpacked) == unpacked;
    if (!is_packed && packed == unpacked) {
        std::copy_n(bytes.data() + start, unpacked, by_field.data());
        cloud.remarks.emplace_back("its points are stored uncompressed");
    } else if (!is_packed) {
        throw BrokenRecording(file.string() + ": byte " + std::to_string(start) +
                              ": its points cannot be decompressed (LZF)");
    }
    cloud.table.bytes.resize(unpacked);
    const std::uint8_t* from = by_field.data();
    for (const PointField& field : header.fields) {
        const std::size_t size = field.count * bytesOf(field.type);
        for (std::size_t i = 0; i < header.points; ++i, from += size) {
            std::copy_n(from, size,
                        cloud.table.bytes.data() + i * header.bytes_per_point + field.offset);
        }
    }
}

}  // namespace

CloudFile readPcd(const std::filesystem::path& file, Bytes bytes) {
    const PcdHeader header = readPcdHeader(file, bytes);
    CloudFile cloud;
    cloud.table.points = header.points;
    cloud.table.bytes_per_point = header.bytes_per_point;
    for (const PointField& field : header.fields) {
        if (field.name != "_") cloud.table.fields.push_back(field);
    }
    switch (header.data) {
        case PcdHeader::Data::Ascii:
            readAsciiPcd(file, header, bytes, cloud);
            break;
        case PcdHeader::Data::Binary:
            readBinaryPcd(file, header, std::move(bytes), cloud);
            break;
        case PcdHeader::Data::Compressed:
            readCompressedPcd(file, header, bytes, cloud);
            break;
    }
    if (header.has_viewpoint) {
        cloud.remarks.emplace_back(
            "its VIEWPOINT is ignored: points are assumed to be in the sensor frame");
    }
    return cloud;
}

}  // namespace hagen::recordings
