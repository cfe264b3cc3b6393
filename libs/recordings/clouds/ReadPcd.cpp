#include <lzf.h>

#include <algorithm>
#include <map>

#include "base/NumberText.h"
#include "recordings/clouds/Readers.h"

namespace hagen::recordings {
namespace {

using observations::NumberType;
using observations::PointField;
using observations::PointTable;

/// The header of a PCD, consistent in itself but not checked against the data.
struct PcdHeader {
    enum class Data { Ascii, Binary, Compressed };
    /// All fields in order, including padding (named "_").
    std::vector<PointField> fields;
    std::size_t bytes_per_point = 0;
    std::size_t points = 0;
    Data data = Data::Ascii;
    bool has_viewpoint = false;  ///< whether the sensor is not at the origin
    std::size_t size = 0;
    std::size_t lines = 0;
};

using Words = std::vector<std::string_view>;

/// A header line: the words after the key, and the line number for messages.
struct PcdLine {
    Words values;
    std::string place;
};
using PcdLines = std::map<std::string, PcdLine, std::less<>>;

NumberType pcdTypeOf(const std::filesystem::path& file, const PcdLine& at, std::string_view type,
                     std::string_view size) {
    static const std::map<std::string, NumberType> kTypes{
        {"I1", NumberType::Int8},    {"I2", NumberType::Int16},  {"I4", NumberType::Int32},
        {"I8", NumberType::Int64},   {"U1", NumberType::UInt8},  {"U2", NumberType::UInt16},
        {"U4", NumberType::UInt32},  {"U8", NumberType::UInt64}, {"F4", NumberType::Float32},
        {"F8", NumberType::Float64}, {"B1", NumberType::UInt8}};
    const auto known = kTypes.find(std::string(type) + std::string(size));
    if (known != kTypes.end()) return known->second;
    failAt(file, at.place,
           "a field of TYPE " + std::string(type) + " and SIZE " + std::string(size) +
               " is not supported (I, U of 1, 2, 4, 8 bytes, F of 4, 8)");
}

const PcdLine& neededLine(const std::filesystem::path& file, const PcdLines& entries,
                          const char* key) {
    const auto found = entries.find(key);
    if (found == entries.end()) {
        throw BrokenRecording(file.string() + ": its PCD header has no " + key);
    }
    return found->second;
}

std::size_t pcdCountOf(const std::filesystem::path& file, const PcdLine& entry, const char* key) {
    const auto count =
        entry.values.size() == 1 ? base::numberFrom<std::uint64_t>(entry.values[0]) : std::nullopt;
    if (!count) failAt(file, entry.place, std::string(key) + " is not a single number");
    return static_cast<std::size_t>(*count);
}

void takePcdFields(const std::filesystem::path& file, const PcdLines& entries, PcdHeader& header) {
    const bool is_old = entries.count("FIELDS") == 0;
    const PcdLine& names = neededLine(file, entries, is_old ? "COLUMNS" : "FIELDS");
    const PcdLine& sizes = neededLine(file, entries, "SIZE");
    const PcdLine& types = neededLine(file, entries, "TYPE");
    const auto counts = entries.find("COUNT");
    const std::size_t fields = names.values.size();
    for (const PcdLine* each :
         {&sizes, &types, counts == entries.end() ? &sizes : &counts->second}) {
        if (each->values.size() == fields) continue;
        failAt(file, each->place,
               "expected one value per field (" + std::to_string(fields) + "), found " +
                   std::to_string(each->values.size()));
    }
    for (std::size_t i = 0; i < fields; ++i) {
        PointField field;
        field.name = std::string(names.values[i]);
        field.type = pcdTypeOf(file, types, types.values[i], sizes.values[i]);
        field.offset = header.bytes_per_point;
        if (counts != entries.end()) {
            const auto count = base::numberFrom<std::uint32_t>(counts->second.values[i]);
            if (!count) {
                failAt(file, counts->second.place,
                       "'" + std::string(counts->second.values[i]) + "' is not a valid COUNT");
            }
            field.count = *count;
        }
        header.bytes_per_point += field.count * bytesOf(field.type);
        if (field.count > 0) header.fields.push_back(field);
    }
}

void takePcdPoints(const std::filesystem::path& file, const PcdLines& entries, PcdHeader& header) {
    std::optional<std::size_t> product;
    if (entries.count("WIDTH") > 0) {
        const std::size_t width = pcdCountOf(file, entries.at("WIDTH"), "WIDTH");
        const std::size_t height =
            entries.count("HEIGHT") > 0 ? pcdCountOf(file, entries.at("HEIGHT"), "HEIGHT") : 1;
        if (__builtin_mul_overflow(width, height, &product.emplace())) {
            failAt(file, entries.at("WIDTH").place, "WIDTH times HEIGHT is too large");
        }
    }
    if (entries.count("POINTS") > 0) {
        header.points = pcdCountOf(file, entries.at("POINTS"), "POINTS");
        if (product && *product != header.points) {
            failAt(file, entries.at("POINTS").place,
                   std::to_string(header.points) + " POINTS, but WIDTH times HEIGHT is " +
                       std::to_string(*product));
        }
    } else if (product) {
        header.points = *product;
    } else {
        throw BrokenRecording(file.string() + ": its PCD header has neither POINTS nor WIDTH");
    }
}

void takeViewpoint(const PcdLines& entries, PcdHeader& header) {
    const auto entry = entries.find("VIEWPOINT");
    if (entry == entries.end()) return;
    const Words& values = entry->second.values;
    bool is_origin = values.size() == 7;
    for (std::size_t i = 0; is_origin && i < 7; ++i) {
        is_origin = base::numberFrom<double>(values[i]) == (i == 3 ? 1.0 : 0.0);
    }
    header.has_viewpoint = !is_origin;
}

/// Throws BrokenRecording naming file and line.
PcdHeader readPcdHeader(const std::filesystem::path& file, const Bytes& bytes) {
    static const std::vector<std::string_view> kKeys{"VERSION", "FIELDS",    "COLUMNS", "SIZE",
                                                     "TYPE",    "COUNT",     "WIDTH",   "HEIGHT",
                                                     "POINTS",  "VIEWPOINT", "DATA"};
    PcdHeader header;
    PcdLines entries;
    TextLines lines(bytes);
    while (entries.count("DATA") == 0) {
        const auto line = lines.next();
        if (!line) throw BrokenRecording(file.string() + ": ends within its PCD header (no DATA)");
        Words words = wordsOf(*line);
        if (words.empty() || words[0][0] == '#') continue;
        const std::string_view key = words[0];
        if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
            failAt(file, lines.place(), quoted(key) + " is not a line of a PCD header");
        }
        words.erase(words.begin());
        if (!entries.emplace(std::string(key), PcdLine{std::move(words), lines.place()}).second) {
            failAt(file, lines.place(), std::string(key) + " occurs twice");
        }
    }
    takePcdFields(file, entries, header);
    takePcdPoints(file, entries, header);
    takeViewpoint(entries, header);
    const PcdLine& data = entries.at("DATA");
    const std::string_view kind = data.values.size() == 1 ? data.values[0] : "";
    if (kind == "ascii") {
        header.data = PcdHeader::Data::Ascii;
    } else if (kind == "binary") {
        header.data = PcdHeader::Data::Binary;
    } else if (kind == "binary_compressed") {
        header.data = PcdHeader::Data::Compressed;
    } else {
        failAt(file, data.place,
               "DATA " + quoted(kind) + " is not ascii, binary or binary_compressed");
    }
    header.size = lines.position();
    header.lines = lines.number();
    return header;
}

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
