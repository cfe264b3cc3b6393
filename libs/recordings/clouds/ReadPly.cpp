#include "base/FileKind.h"
#include "base/NumberText.h"

#include <algorithm>
#include <array>
#include <map>

#include "recordings/clouds/Readers.h"

namespace hagen::recordings {
namespace {

using observations::NumberType;
using observations::PointTable;

struct PlyProperty {
    std::string name;
    NumberType type = NumberType::Float32;
    std::optional<NumberType> length;
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;

    bool hasLists() const {
        return std::any_of(properties.begin(), properties.end(),
                           [](const PlyProperty& property) { return property.length.has_value(); });
    }
    /// Size of a row [bytes], if it has no lists.
    std::size_t size() const {
        std::size_t bytes = 0;
        for (const PlyProperty& property : properties) {
            if (!property.length) bytes += bytesOf(property.type);
        }
        return bytes;
    }
};

struct PlyHeader {
    enum class Data { Ascii, Little, Big } data = Data::Ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0, lines = 0;
};

NumberType plyTypeOf(const std::filesystem::path& file, const TextLines& lines,
                     std::string_view name) {
    static const std::map<std::string, NumberType, std::less<>> kTypes{
        {"char", NumberType::Int8},      {"int8", NumberType::Int8},
        {"uchar", NumberType::UInt8},    {"uint8", NumberType::UInt8},
        {"short", NumberType::Int16},    {"int16", NumberType::Int16},
        {"ushort", NumberType::UInt16},  {"uint16", NumberType::UInt16},
        {"int", NumberType::Int32},      {"int32", NumberType::Int32},
        {"uint", NumberType::UInt32},    {"uint32", NumberType::UInt32},
        {"int64", NumberType::Int64},    {"uint64", NumberType::UInt64},
        {"float", NumberType::Float32},  {"float32", NumberType::Float32},
        {"double", NumberType::Float64}, {"float64", NumberType::Float64}};
    const auto known = kTypes.find(name);
    if (known == kTypes.end()) {
        failAt(file, lines.place(), quoted(name) + " is not a PLY type");
    }
    return known->second;
}

void takeProperty(const std::filesystem::path& file, const TextLines& lines,
                  const std::vector<std::string_view>& words, PlyHeader& header) {
    if (header.elements.empty()) failAt(file, lines.place(), "a property must follow an element");
    const bool is_list = words.size() == 5 && words[1] == "list";
    if ((!is_list && words.size() != 3) || !base::isText(words.back())) {
        failAt(file, lines.place(), "is not a valid PLY property");
    }
    PlyProperty property;
    property.name = std::string(words.back());
    property.type = plyTypeOf(file, lines, words[words.size() - 2]);
    if (is_list) {
        property.length = plyTypeOf(file, lines, words[2]);
        if (*property.length == NumberType::Float32 || *property.length == NumberType::Float64) {
            failAt(file, lines.place(), "the length of a list is not an integer");
        }
    }
    header.elements.back().properties.push_back(property);
}

PlyHeader readPlyHeader(const std::filesystem::path& file, const Bytes& bytes) {
    PlyHeader header;
    TextLines lines(bytes);
    bool has_format = false;
    lines.next();  // "ply"
    while (true) {
        const auto line = lines.next();
        if (!line) throw BrokenRecording(file.string() + ": ends within its PLY header");
        const std::vector<std::string_view> words = wordsOf(*line);
        if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
        if (words[0] == "end_header") break;
        if (words[0] == "format" && words.size() == 3) {
            has_format = true;
            if (words[1] == "ascii") {
                header.data = PlyHeader::Data::Ascii;
            } else if (words[1] == "binary_little_endian") {
                header.data = PlyHeader::Data::Little;
            } else if (words[1] == "binary_big_endian") {
                header.data = PlyHeader::Data::Big;
            } else {
                failAt(file, lines.place(), "format " + quoted(words[1]) + " is not supported");
            }
        } else if (words[0] == "element" && words.size() == 3) {
            const auto count = base::numberFrom<std::uint64_t>(words[2]);
            if (!count) failAt(file, lines.place(), "is not a valid number of elements");
            header.elements.push_back({std::string(words[1]), *count, {}});
        } else if (words[0] == "property") {
            takeProperty(file, lines, words, header);
        } else {
            failAt(file, lines.place(), quoted(words[0]) + " is not a line of a PLY header");
        }
    }
    if (!has_format) throw BrokenRecording(file.string() + ": its PLY header has no format");
    header.size = lines.position();
    header.lines = lines.number();
    return header;
}

/// Returns the table of vertices, without lists.
PointTable vertexTableOf(const PlyElement& vertices) {
    PointTable table;
    table.points = vertices.count;
    for (const PlyProperty& property : vertices.properties) {
        if (property.length) continue;
        table.fields.push_back({property.name, property.type, table.bytes_per_point, 1});
        table.bytes_per_point += bytesOf(property.type);
    }
    return table;
}

[[noreturn]] void failCut(const std::filesystem::path& file, const PlyElement& element,
                          std::size_t row) {
    throw BrokenRecording(file.string() + ": the header claims " + std::to_string(element.count) +
                          " '" + element.name + "' elements, but " + std::to_string(row) +
                          " are present; is it truncated?");
}

class BinaryRows {
 public:
    BinaryRows(const std::filesystem::path& file, const Bytes& bytes, const PlyHeader& header)
        : file_(file),
          bytes_(bytes),
          at_(header.size),
          is_big_endian_(header.data == PlyHeader::Data::Big) {}

    std::size_t left() const { return bytes_.size() - at_; }

    /// Reads all rows of an element. Stores them if `table` is not null.
    void read(const PlyElement& element, PointTable* table) {
        if (element.properties.empty()) return;
        if (!element.hasLists()) {
            const std::size_t size = element.size();
            if (element.count > left() / size) failCut(file_, element, left() / size);
            if (table != nullptr) {
                checkNumber(file_, element.count);
                const auto from = bytes_.begin() + static_cast<std::ptrdiff_t>(at_);
                table->bytes.assign(from, from + static_cast<std::ptrdiff_t>(element.count * size));
            }
            at_ += element.count * size;
            return;
        }
        // A file with fewer bytes than rows is truncated; reading reports it.
        if (table != nullptr && element.count <= left()) checkNumber(file_, element.count);
        for (std::size_t row = 0; row < element.count; ++row) {
            for (const PlyProperty& property : element.properties) {
                if (!readProperty(property, table)) failCut(file_, element, row);
            }
        }
    }

 private:
    bool readProperty(const PlyProperty& property, PointTable* table) {
        const std::size_t size = bytesOf(property.type);
        if (!property.length) {
            if (left() < size) return false;
            if (table != nullptr) {
                const auto from = bytes_.begin() + static_cast<std::ptrdiff_t>(at_);
                table->bytes.insert(table->bytes.end(), from,
                                    from + static_cast<std::ptrdiff_t>(size));
            }
            at_ += size;
            return true;
        }
        const std::size_t length_size = bytesOf(*property.length);
        if (left() < length_size) return false;
        std::uint64_t length = 0;
        for (std::size_t k = 0; k < length_size; ++k) {
            const std::size_t from_low = is_big_endian_ ? length_size - 1 - k : k;
            length |= static_cast<std::uint64_t>(bytes_[at_ + k]) << (8 * from_low);
        }
        at_ += length_size;
        if (length > left() / size) return false;
        at_ += static_cast<std::size_t>(length) * size;
        return true;
    }

    const std::filesystem::path& file_;
    const Bytes& bytes_;
    std::size_t at_;
    bool is_big_endian_;
};

class AsciiRows {
 public:
    AsciiRows(const std::filesystem::path& file, const Bytes& bytes, const PlyHeader& header)
        : file_(file), size_(bytes.size()), lines_(bytes) {
        while (lines_.number() < header.lines) lines_.next();
    }
    std::size_t left() const { return size_ - lines_.position(); }

    void read(const PlyElement& element, PointTable* table) {
        if (element.properties.empty()) return;
        if (table != nullptr) {
            if (element.count > left()) failCut(file_, element, 0);
            checkNumber(file_, element.count);
            // Two bytes of text become a number of at most eight bytes.
            table->bytes.reserve(std::min(element.count * table->bytes_per_point, 4 * left() + 8));
        }
        for (std::size_t row = 0; row < element.count; ++row) {
            std::vector<std::string_view> words;
            while (words.empty()) {
                const auto line = lines_.next();
                if (!line) failCut(file_, element, row);
                words = wordsOf(*line);
            }
            std::size_t word = 0;
            for (const PlyProperty& property : element.properties) {
                readProperty(property, words, word, table);
            }
            if (word != words.size()) failLine(words.size());
        }
    }

 private:
    [[noreturn]] void failLine(std::size_t words) {
        failAt(file_, lines_.place(),
               "the number of values (" + std::to_string(words) +
                   ") does not match the properties in the header");
    }

    void readProperty(const PlyProperty& property, const std::vector<std::string_view>& words,
                      std::size_t& word, PointTable* table) {
        if (word >= words.size()) failLine(words.size());
        if (property.length) {
            const auto length = base::numberFrom<std::uint64_t>(words[word++]);
            if (!length || *length > words.size() - word) failLine(words.size());
            word += static_cast<std::size_t>(*length);
            return;
        }
        std::array<std::uint8_t, 8> number{};
        if (!putNumber(words[word], property.type, number.data())) {
            failAt(file_, lines_.place(),
                   quoted(words[word]) + " is not a valid " + nameOf(property.type) +
                       " for the property '" + property.name + "'");
        }
        ++word;
        if (table == nullptr) return;
        table->bytes.insert(table->bytes.end(), number.begin(),
                            number.begin() + static_cast<std::ptrdiff_t>(bytesOf(property.type)));
    }

    const std::filesystem::path& file_;
    std::size_t size_;
    TextLines lines_;
};

template <class Rows>
void readRows(const std::filesystem::path& file, const PlyHeader& header, Rows rows,
              CloudFile& cloud) {
    bool has_vertices = false;
    for (const PlyElement& element : header.elements) {
        if (element.name != "vertex") {
            if (element.count > 0) {
                cloud.remarks.push_back("its '" + element.name + "' elements are not read");
            }
            if (!has_vertices) rows.read(element, nullptr);
            continue;
        }
        if (has_vertices) throw BrokenRecording(file.string() + ": has two 'vertex' elements");
        has_vertices = true;
        cloud.table = vertexTableOf(element);
        for (const PlyProperty& property : element.properties) {
            if (!property.length) continue;
            cloud.remarks.push_back("list properties of vertices are not read: " + property.name);
        }
        rows.read(element, &cloud.table);
    }
    if (!has_vertices) throw BrokenRecording(file.string() + ": has no 'vertex' elements");
    if (header.elements.back().name == "vertex") {
        for (std::string& remark : remarkOnRest(rows.left())) cloud.remarks.push_back(remark);
    }
}

}  // namespace

CloudFile readPly(const std::filesystem::path& file, const Bytes& bytes) {
    const PlyHeader header = readPlyHeader(file, bytes);
    CloudFile cloud;
    if (header.data == PlyHeader::Data::Ascii) {
        readRows(file, header, AsciiRows(file, bytes, header), cloud);
    } else {
        readRows(file, header, BinaryRows(file, bytes, header), cloud);
        cloud.table.is_big_endian = header.data == PlyHeader::Data::Big;
    }
    return cloud;
}

}  // namespace hagen::recordings
