#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::observations {

enum class NumberType : std::uint8_t {
    Int8,
    UInt8,
    Int16,
    UInt16,
    Int32,
    UInt32,
    Int64,
    UInt64,
    Float32,
    Float64
};

std::size_t bytesOf(NumberType type);
/// The name of a type, such as "uint16" or "float64".
const char* nameOf(NumberType type);

struct PointField {
    std::string name;
    NumberType type = NumberType::Float32;
    std::size_t offset = 0;  ///< bytes from the start of a point
    std::size_t count = 1;   ///< consecutive numbers per point
};

/// Points as records of named numbers, as in sensor_msgs/PointCloud2: point i begins at byte
/// i * bytes_per_point. There may be gaps between fields.
struct PointTable {
    std::vector<PointField> fields;
    std::size_t points = 0;
    std::size_t bytes_per_point = 0;
    bool is_big_endian = false;
    std::vector<std::uint8_t> bytes;
};

/// Maximum number of numbers per point, over all fields.
constexpr std::size_t kMaxNumbersPerPoint = 65536;

/// Checks a table from a file; call it before any other access. Throws std::runtime_error, naming
/// the field, for fields without name or numbers, duplicate names, fields that exceed a point, more
/// than kMaxNumbersPerPoint numbers, and points that exceed the data.
void check(const PointTable& table);

/// The field with exactly this name; null if not found.
const PointField* findExactly(const PointTable& table, const std::string& name);
/// The field with the first name that matches; an exact match is preferred to a case-insensitive
/// match, and that to a match after "scalar_" (CloudCompare). Null if not found.
const PointField* findField(const PointTable& table, const std::vector<std::string>& names);

/// The numbers of a field of a checked table, one per point, at index `element` of its count.
std::vector<double> columnOf(const PointTable& table, const PointField& field,
                             std::size_t element = 0);

/// Like above, for these points in this order.
std::vector<double> columnOf(const PointTable& table, const PointField& field,
                             const std::vector<std::uint32_t>& points);

/// Appends a field with these numbers, one per point, to a checked table in little-endian order.
/// Numbers must be representable in the type.
void addColumn(const std::string& name, NumberType type, const std::vector<double>& numbers,
               PointTable& table);

/// The table of these points, in this order.
PointTable pointsOf(const PointTable& table, const std::vector<std::uint32_t>& points);

/// The table in the byte order of this machine.
PointTable inNativeOrder(PointTable table);

/// The field names for messages, such as "x, y, z, intensity".
std::string namesOf(const PointTable& table);

}  // namespace hagen::observations
