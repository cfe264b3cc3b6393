#include <cmath>

#include "recordings/Remarks.h"
#include "recordings/clouds/Readers.h"

namespace hagen::recordings {
namespace {

using observations::NumberType;
using observations::PointTable;

// Offsets in the public header block (ASPRS LAS 1.4 R15, table 3).
constexpr std::size_t kMinorVersion = 25, kHeaderSize = 94, kPointsStart = 96, kFormat = 104,
                      kRecords = 100, kRecordLength = 105, kLegacyPoints = 107, kScales = 131,
                      kOffsets = 155, kExtendedRecords = 243, kPoints = 247;
constexpr std::size_t kMinHeader = 227, kHeaderOf14 = 375;

/// Offsets of optional values in a point data record format (tables 7 to 17); 0: absent.
struct LasFormat {
    std::size_t size;
    bool is_new;  ///< formats 6 and above
    std::size_t gps_time, colour, near_infrared;
    bool has_waves;
};
constexpr LasFormat kLasFormats[] = {
    {20, false, 0, 0, 0, false},   {28, false, 20, 0, 0, false}, {26, false, 0, 20, 0, false},
    {34, false, 20, 28, 0, false}, {57, false, 20, 0, 0, true},  {63, false, 20, 28, 0, true},
    {30, true, 22, 0, 0, false},   {36, true, 22, 30, 0, false}, {38, true, 22, 30, 36, false},
    {59, true, 22, 0, 0, true},    {67, true, 22, 30, 36, true}};

/// A table that is filled point by point.
class LasColumns {
 public:
    LasColumns(std::size_t points, std::size_t max_bytes) {
        table.points = points;
        table.bytes.reserve(points * max_bytes);
    }
    /// Add the same fields in the same order for each point.
    template <class Number>
    void add(const char* name, NumberType type, Number number) {
        if (is_first_) {
            table.fields.push_back({name, type, table.bytes_per_point, 1});
            table.bytes_per_point += sizeof number;
        }
        const auto* const from = reinterpret_cast<const std::uint8_t*>(&number);
        table.bytes.insert(table.bytes.end(), from, from + sizeof number);
    }
    void endPoint() { is_first_ = false; }

    PointTable table;

 private:
    bool is_first_ = true;
};

struct LasScaling {
    double scale[3], offset[3];
};

void addLasPoint(const Bytes& bytes, std::size_t at, const LasFormat& format,
                 const LasScaling& scaling, LasColumns& columns) {
    const char* const kNames[] = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto number = numberAt<std::int32_t>(bytes, at + 4 * axis);
        columns.add(kNames[axis], NumberType::Float64,
                    number * scaling.scale[axis] + scaling.offset[axis]);
    }
    const auto byte = [&](std::size_t place) { return bytes[at + place]; };
    columns.add("intensity", NumberType::UInt16, numberAt<std::uint16_t>(bytes, at + 12));
    const int flags = byte(14);
    const auto add_byte = [&](const char* name, int number) {
        columns.add(name, NumberType::UInt8, static_cast<std::uint8_t>(number));
    };
    float angle_deg = 0;
    constexpr int kScanDirection = 0x40, kEdge = 0x80;
    int classification_flags = 0, line_flags = 0;
    if (format.is_new) {
        classification_flags = byte(15) & 0xf;
        line_flags = byte(15);
        add_byte("return_number", flags & 0xf);
        add_byte("number_of_returns", flags >> 4);
        add_byte("scanner_channel", byte(15) >> 4 & 3);
        add_byte("classification", byte(16));
        add_byte("user_data", byte(17));
        constexpr float kUnit_deg = 0.006f;
        angle_deg = kUnit_deg * static_cast<float>(numberAt<std::int16_t>(bytes, at + 18));
    } else {
        classification_flags = byte(15) >> 5;
        line_flags = flags;
        add_byte("return_number", flags & 7);
        add_byte("number_of_returns", flags >> 3 & 7);
        add_byte("classification", byte(15) & 0x1f);
        add_byte("user_data", byte(17));
        angle_deg = static_cast<float>(static_cast<std::int8_t>(byte(16)));
    }
    add_byte("classification_flags", classification_flags);
    add_byte("scan_direction", (line_flags & kScanDirection) != 0 ? 1 : 0);
    add_byte("edge_of_flight_line", (line_flags & kEdge) != 0 ? 1 : 0);
    columns.add("scan_angle", NumberType::Float32, angle_deg);
    columns.add("point_source_id", NumberType::UInt16,
                numberAt<std::uint16_t>(bytes, at + (format.is_new ? 20 : 18)));
    if (format.gps_time > 0) {
        columns.add("gps_time", NumberType::Float64, numberAt<double>(bytes, at + format.gps_time));
    }
    if (format.colour > 0) {
        const char* const kColours[] = {"red", "green", "blue"};
        for (std::size_t k = 0; k < 3; ++k) {
            columns.add(kColours[k], NumberType::UInt16,
                        numberAt<std::uint16_t>(bytes, at + format.colour + 2 * k));
        }
    }
    if (format.near_infrared > 0) {
        columns.add("nir", NumberType::UInt16,
                    numberAt<std::uint16_t>(bytes, at + format.near_infrared));
    }
    columns.endPoint();
}

/// Returns remarks on records before and after the points.
std::vector<std::string> remarksOnRecords(const Bytes& bytes, bool is_of_14, std::size_t rest) {
    const std::uint32_t extended = is_of_14 ? numberAt<std::uint32_t>(bytes, kExtendedRecords) : 0;
    std::vector<std::string> remarks = remarkOnRest(extended > 0 ? 0 : rest);
    const std::size_t records = std::size_t{numberAt<std::uint32_t>(bytes, kRecords)} + extended;
    if (records > 0) {
        remarks.push_back("its variable length records (" + std::to_string(records) +
                          "), such as the coordinate system, are not read");
    }
    return remarks;
}

}  // namespace

CloudFile readLas(const std::filesystem::path& file, const Bytes& bytes) {
    if (bytes.size() < kMinHeader) {
        throw BrokenRecording(file.string() + ": ends within its LAS header");
    }
    const int minor = bytes[kMinorVersion];
    if (bytes[kMinorVersion - 1] != 1 || minor > 4) {
        failAt(file, "byte 24",
               "LAS " + std::to_string(bytes[kMinorVersion - 1]) + "." + std::to_string(minor) +
                   " is not supported (1.0 to 1.4)");
    }
    const std::size_t header_size = numberAt<std::uint16_t>(bytes, kHeaderSize);
    const std::size_t start = numberAt<std::uint32_t>(bytes, kPointsStart);
    const std::size_t record = numberAt<std::uint16_t>(bytes, kRecordLength);
    const unsigned number = bytes[kFormat];
    if ((number & 0xc0) != 0) {
        throw BrokenRecording(
            file.string() +
            ": is compressed (LAZ), which is not supported; convert it: 'laszip -i in.laz -o "
            "out.las' or 'pdal translate in.laz out.las'");
    }
    if (number >= std::size(kLasFormats)) {
        failAt(file, "byte 104",
               "point format " + std::to_string(number) + " is not supported (0 to 10)");
    }
    const LasFormat& format = kLasFormats[number];
    if (record < format.size) {
        failAt(file, "byte 105",
               "points of " + std::to_string(record) + " bytes are too short for point format " +
                   std::to_string(number) + ", which has " + std::to_string(format.size));
    }
    if (header_size < kMinHeader || start < header_size || start > bytes.size()) {
        failAt(file, "byte 94",
               "a header of " + std::to_string(header_size) + " bytes and points from byte " +
                   std::to_string(start) + " do not fit into its " + std::to_string(bytes.size()) +
                   " bytes; is it truncated?");
    }
    std::uint64_t points = numberAt<std::uint32_t>(bytes, kLegacyPoints);
    const bool is_of_14 = minor == 4 && header_size >= kHeaderOf14 && bytes.size() >= kHeaderOf14;
    if (is_of_14) {
        const auto all = numberAt<std::uint64_t>(bytes, kPoints);
        if (all > 0) points = all;
    }
    checkRoom(file, points, record, bytes.size() - start);
    LasScaling scaling{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        scaling.scale[axis] = numberAt<double>(bytes, kScales + 8 * axis);
        scaling.offset[axis] = numberAt<double>(bytes, kOffsets + 8 * axis);
        if (std::isfinite(scaling.scale[axis]) && scaling.scale[axis] != 0 &&
            std::isfinite(scaling.offset[axis])) {
            continue;
        }
        failAt(file, "byte 131", "a coordinate scale or offset is 0 or not finite");
    }
    constexpr std::size_t kMaxBytes = 3 * 8 + 2 + 8 + 4 + 2 + 8 + 8;
    LasColumns columns(points, kMaxBytes);
    for (std::size_t i = 0; i < points; ++i) {
        addLasPoint(bytes, start + i * record, format, scaling, columns);
    }
    CloudFile cloud;
    cloud.table = std::move(columns.table);
    if (points == 0) {
        // If there are no points, no fields were added.
        LasColumns one(1, kMaxBytes);
        addLasPoint(Bytes(record, 0), 0, format, scaling, one);
        cloud.table = std::move(one.table);
        cloud.table.points = 0;
        cloud.table.bytes.clear();
    }
    cloud.remarks = remarksOnRecords(bytes, is_of_14, bytes.size() - start - points * record);
    if (format.has_waves) cloud.remarks.push_back("its wave packets are not read");
    if (record > format.size) {
        cloud.remarks.push_back(counted(record - format.size, "extra byte") +
                                " per point not read");
    }
    return cloud;
}

}  // namespace hagen::recordings
