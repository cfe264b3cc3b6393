#include <hagen/convert/WriteCloud.h>
#include "base/NumberText.h"
#include "base/WriteFile.h"
#include "convert/UniqueNames.h"
#include "mrpt/NumberTypes.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace hagen::convert {
namespace {

using observations::NumberType;
using observations::PointField;
using observations::PointTable;

constexpr double kFarForFloat_m = 8192.0;  // from here on, float32 values are 1 mm apart

struct WrittenField {
    std::string name;
    NumberType type;
    std::size_t count;
    PointField from;
    std::size_t element;  ///< the first element of `from`
};

/// The limits of a format.
struct Limits {
    const char* format;
    bool has_long_integers, has_arrays;
};

Limits limitsOf(OutputFormat format) {
    return format == OutputFormat::Ply ? Limits{"PLY", false, false} : Limits{"PCD", true, true};
}
constexpr Limits kPointCloud2{"PointCloud2", false, true};

/// Replaces blanks and control characters, which headers do not support.
std::string asWord(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c <= ' ' || c == 0x7f; }, '_');
    return name;
}

bool hasFarPoints(const PointTable& table, const PointField& field) {
    const std::vector<double> numbers = columnOf(table, field);
    return std::any_of(numbers.begin(), numbers.end(), [](double number) {
        return std::isfinite(number) && std::abs(number) > kFarForFloat_m;
    });
}

NumberType coordinateType(const PointTable& table, const PointField& field) {
    const bool is_wide = bytesOf(field.type) > bytesOf(NumberType::Float32) ||
                         field.type == NumberType::Int32 || field.type == NumberType::UInt32;
    return is_wide && hasFarPoints(table, field) ? NumberType::Float64 : NumberType::Float32;
}

NumberType typeIn(const Limits& limits, NumberType type) {
    const bool is_unknown =
        !limits.has_long_integers && (type == NumberType::Int64 || type == NumberType::UInt64);
    return is_unknown ? NumberType::Float64 : type;
}

std::vector<WrittenField> fieldsOf(const Limits& limits, const PointTable& table) {
    std::vector<WrittenField> fields;
    std::vector<const PointField*> coordinates;
    recordings::UniqueNames names;
    for (const char* const name : {"x", "y", "z"}) {
        const PointField* const field = findField(table, {name});
        if (field == nullptr) throw std::runtime_error(std::string("a cloud has no ") + name);
        coordinates.push_back(field);
        fields.push_back({names.of(name), coordinateType(table, *field), 1, *field, 0});
    }
    for (const PointField& field : table.fields) {
        if (std::find(coordinates.begin(), coordinates.end(), &field) != coordinates.end())
            continue;
        const bool is_split = !limits.has_arrays && field.count > 1;
        for (std::size_t k = 0; k < (is_split ? field.count : 1); ++k) {
            const std::string name = asWord(field.name) + (is_split ? "_" + std::to_string(k) : "");
            fields.push_back(
                {names.of(name), typeIn(limits, field.type), is_split ? 1 : field.count, field, k});
        }
    }
    return fields;
}

const char* plyName(NumberType type) {
    switch (type) {
        case NumberType::Int8:
            return "char";
        case NumberType::UInt8:
            return "uchar";
        case NumberType::Int16:
            return "short";
        case NumberType::UInt16:
            return "ushort";
        case NumberType::Int32:
            return "int";
        case NumberType::UInt32:
            return "uint";
        case NumberType::Float32:
            return "float";
        default:
            return "double";
    }
}

char pcdLetter(NumberType type) {
    return withType(type, [](auto number) {
        if (std::is_floating_point_v<decltype(number)>) return 'F';
        return std::is_signed_v<decltype(number)> ? 'I' : 'U';
    });
}

std::string plyHeader(const std::vector<WrittenField>& fields, std::size_t points) {
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points) + "\n";
    for (const WrittenField& field : fields) {
        text += std::string("property ") + plyName(field.type) + " " + field.name + "\n";
    }
    return text + "end_header\n";
}

std::string pcdHeader(const std::vector<WrittenField>& fields, std::size_t points) {
    std::string names, sizes, types, counts;
    for (const WrittenField& field : fields) {
        names += " " + field.name;
        sizes += " " + std::to_string(bytesOf(field.type));
        types += std::string(" ") + pcdLetter(field.type);
        counts += " " + std::to_string(field.count);
    }
    const std::string number = std::to_string(points);
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS" + names + "\nSIZE" +
           sizes + "\nTYPE" + types + "\nCOUNT" + counts + "\nWIDTH " + number +
           "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + number + "\nDATA binary\n";
}

template <class Number>
void putColumn(const std::vector<double>& numbers, std::size_t offset, std::size_t stride,
               std::string& to) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto number = static_cast<Number>(numbers[i]);
        std::memcpy(to.data() + i * stride + offset, &number, sizeof number);
    }
}

std::string recordsOf(const std::vector<WrittenField>& fields, const PointTable& table) {
    std::size_t stride = 0;
    for (const WrittenField& field : fields) stride += field.count * bytesOf(field.type);
    std::string records(table.points * stride, '\0');
    std::size_t offset = 0;
    for (const WrittenField& field : fields) {
        const std::size_t size = field.count * bytesOf(field.type);
        if (field.type == field.from.type) {
            const std::size_t first = field.from.offset + field.element * bytesOf(field.type);
            for (std::size_t i = 0; i < table.points; ++i) {
                std::memcpy(records.data() + i * stride + offset,
                            table.bytes.data() + i * table.bytes_per_point + first, size);
            }
        } else if (field.type == NumberType::Float32) {
            putColumn<float>(columnOf(table, field.from, field.element), offset, stride, records);
        } else {
            putColumn<double>(columnOf(table, field.from, field.element), offset, stride, records);
        }
        offset += size;
    }
    return records;
}

std::vector<std::string> changesWithin(const Limits& limits, const PointTable& table) {
    constexpr double kExact = 9007199254740992.0;  // 2^53: smaller integers are exact
    std::vector<std::string> changes;
    for (const WrittenField& field : fieldsOf(limits, table)) {
        if (field.type == field.from.type || field.from.type == NumberType::Float64) continue;
        if (bytesOf(field.from.type) < 8) continue;
        const std::vector<double> numbers = columnOf(table, field.from, field.element);
        const bool is_rounded = std::any_of(numbers.begin(), numbers.end(), [](double number) {
            return std::abs(number) > kExact;
        });
        if (!is_rounded) continue;
        changes.push_back("the field '" + field.name + "' is " + nameOf(field.from.type) +
                          ", which " + limits.format + " does not support: rounded to float64");
    }
    return changes;
}

}  // namespace

const char* extensionOf(OutputFormat format) {
    return format == OutputFormat::Ply ? ".ply" : ".pcd";
}

void writeCloud(const std::filesystem::path& file, OutputFormat format, const PointTable& table) {
    const std::vector<WrittenField> fields = fieldsOf(limitsOf(format), table);
    const std::string header = format == OutputFormat::Ply ? plyHeader(fields, table.points)
                                                           : pcdHeader(fields, table.points);
    base::writeText(header + recordsOf(fields, table), file, file);
}

std::vector<std::string> changesWhenWritten(OutputFormat format, const PointTable& table) {
    return changesWithin(limitsOf(format), table);
}

PointTable tableForPointCloud2(const PointTable& table) {
    const std::vector<WrittenField> fields = fieldsOf(kPointCloud2, table);
    const auto aligned = [](std::size_t offset, std::size_t size) {
        return (offset + size - 1) / size * size;
    };
    PointTable written;
    written.points = table.points;
    std::size_t packed_size = 0, widest = 1;
    for (const WrittenField& field : fields) {
        const std::size_t size = bytesOf(field.type);
        const std::size_t offset = aligned(written.bytes_per_point, size);
        written.fields.push_back({field.name, field.type, offset, field.count});
        written.bytes_per_point = offset + field.count * size;
        packed_size += field.count * size;
        widest = std::max(widest, size);
    }
    written.bytes_per_point = aligned(written.bytes_per_point, widest);
    written.bytes.resize(written.points * written.bytes_per_point);
    const std::string records = recordsOf(fields, table);
    std::size_t packed_offset = 0;
    for (const PointField& field : written.fields) {
        const std::size_t size = field.count * bytesOf(field.type);
        for (std::size_t i = 0; i < written.points; ++i) {
            std::memcpy(written.bytes.data() + i * written.bytes_per_point + field.offset,
                        records.data() + i * packed_size + packed_offset, size);
        }
        packed_offset += size;
    }
    return written;
}

std::vector<std::string> changesInPointCloud2(const PointTable& table) {
    return changesWithin(kPointCloud2, table);
}

}  // namespace hagen::convert
