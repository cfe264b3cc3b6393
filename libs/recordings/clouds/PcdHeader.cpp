#include "recordings/clouds/PcdHeader.h"

#include "base/NumberText.h"

#include <algorithm>
#include <map>

namespace hagen::recordings {
namespace {

using observations::NumberType;
using observations::PointField;

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

}  // namespace

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

}  // namespace hagen::recordings
