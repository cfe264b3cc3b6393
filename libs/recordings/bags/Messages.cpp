#include "recordings/bags/Messages.h"

#include <mrpt/math/CQuaternion.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "mrpt/NumberTypes.h"
#include "recordings/bags/Unpack.h"

namespace hagen::recordings {
namespace {

using observations::kPointFieldTypes;
using observations::NumberType;
using observations::PointTable;

constexpr std::size_t kVelodyneMessageBytes = 1206;

bool isZstd(const BagMessage& message) {
    const std::uint8_t* const at = message.bytes;
    return message.size > 4 && at[0] == 0x28 && at[1] == 0xb5 && at[2] == 0x2f && at[3] == 0xfd;
}

/// Reads seconds (signed in ROS 2) and nanoseconds.
std::int64_t readTime(FieldReader& fields) {
    const auto seconds = fields.number<std::uint32_t>();
    const auto nanoseconds = fields.number<std::uint32_t>();
    const std::int64_t signed_seconds =
        fields.isCdr() ? std::int64_t{static_cast<std::int32_t>(seconds)} : std::int64_t{seconds};
    return signed_seconds * 1000000000 + nanoseconds;
}

std::string withoutSlash(std::string frame) {
    if (!frame.empty() && frame.front() == '/') frame.erase(0, 1);
    return frame;
}

NumberType pointFieldType(std::uint8_t datatype) {
    if (datatype >= 1 && datatype <= kPointFieldTypes.size()) return kPointFieldTypes[datatype - 1];
    throw std::runtime_error("one of its point fields has the unknown type " +
                             std::to_string(datatype));
}

template <std::size_t N>
std::array<double, N> readDoubles(FieldReader& fields) {
    std::array<double, N> numbers{};
    for (double& number : numbers) number = fields.number<double>();
    return numbers;
}

/// Reads a quaternion in the order x, y, z, w.
std::array<double, 4> readRotation(FieldReader& fields) {
    const auto xyzw = readDoubles<4>(fields);
    return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

double normOf(const std::array<double, 4>& quaternion) {
    return Eigen::Map<const Eigen::Vector4d>(quaternion.data()).norm();
}

bool isRotation(const std::array<double, 4>& quaternion) {
    const double norm = normOf(quaternion);
    return norm > 0.5 && std::isfinite(norm);
}

/// Removes the padding between the rows of a cloud.
std::vector<std::uint8_t> joinRows(ByteView data, std::size_t rows, std::size_t row_bytes,
                                   std::size_t row_step) {
    std::vector<std::uint8_t> joined;
    joined.reserve(rows * row_bytes);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::uint8_t* const start = data.data + row * row_step;
        joined.insert(joined.end(), start, start + row_bytes);
    }
    return joined;
}

/// Extracts the points of a cloud that is stored as an image of width x height points.
void takeImage(ByteView data, std::uint64_t width, std::uint64_t height, std::uint64_t row_step,
               PointTable& table) {
    table.points = 0;
    if (width == 0 || height == 0) return;
    const std::uint64_t row_bytes = width * table.bytes_per_point;  // cannot overflow: both 32-bit
    // Some drivers set row_step to the size of the whole cloud.
    const bool is_joined =
        height == 1 || row_step == 0 || row_step == row_bytes || row_bytes * height == data.size;
    if (!is_joined && row_step < row_bytes) {
        throw std::runtime_error("its header claims rows of " + std::to_string(row_step) +
                                 " bytes, too few for " + std::to_string(width) + " points of " +
                                 std::to_string(table.bytes_per_point));
    }
    const std::uint64_t step = is_joined ? row_bytes : row_step;
    // The last row may lack its padding. These products cannot overflow.
    if (step == 0 || row_bytes > data.size || (data.size - row_bytes) / step < height - 1) {
        throw std::runtime_error("it claims " + std::to_string(width) + " x " +
                                 std::to_string(height) + " points of " +
                                 std::to_string(table.bytes_per_point) + " bytes, but has " +
                                 std::to_string(data.size) + " bytes");
    }
    table.points = static_cast<std::size_t>(width * height);
    if (is_joined) {
        table.bytes.assign(data.data, data.data + row_bytes * height);
    } else {
        table.bytes = joinRows(data, height, row_bytes, row_step);
    }
}

}  // namespace

FieldReader fieldsOf(const BagMessage& message, const std::string& encoding,
                     std::vector<std::uint8_t>& unpacked) {
    ByteView bytes{message.bytes, message.size};
    if (encoding == "ros1") return FieldReader(bytes);
    if (encoding != "cdr") {
        throw std::runtime_error("its serialisation '" + encoding.substr(0, 32) +
                                 "' is not supported (ros1, cdr)");
    }
    if (isZstd(message)) {
        unpackZstd(bytes, unpacked);
        bytes = {unpacked.data(), unpacked.size()};
    }
    return FieldReader::ofCdr(bytes);
}

std::string nameOf(std::size_t number, std::int64_t recorded_ns) {
    char when[48];
    std::snprintf(when, sizeof when,
                  " (recorded at %.3f s): ", 1e-9 * static_cast<double>(recorded_ns));
    return "message " + std::to_string(number) + when;
}

Header readHeader(FieldReader& fields) {
    if (!fields.isCdr()) fields.number<std::uint32_t>();  // sequence number
    Header header;
    header.time_ns = readTime(fields);
    header.frame = withoutSlash(fields.text());
    return header;
}

PointCloud2 readPointCloud2(FieldReader& fields) {
    PointCloud2 cloud;
    cloud.header = readHeader(fields);
    const auto height = fields.number<std::uint32_t>();
    const auto width = fields.number<std::uint32_t>();
    constexpr std::size_t kMinField = 13;
    const std::size_t count = fields.count(kMinField);
    PointTable& table = cloud.table;
    for (std::size_t i = 0; i < count; ++i) {
        observations::PointField field;
        field.name = fields.text();
        field.offset = fields.number<std::uint32_t>();
        field.type = pointFieldType(fields.number<std::uint8_t>());
        // Some drivers set the count to 0.
        field.count = std::max<std::uint32_t>(1, fields.number<std::uint32_t>());
        // Padding has no name or the name "_".
        if (!field.name.empty() && field.name != "_") table.fields.push_back(field);
    }
    table.is_big_endian = fields.number<std::uint8_t>() != 0;
    table.bytes_per_point = fields.number<std::uint32_t>();
    const auto row_step = fields.number<std::uint32_t>();
    const ByteView data = fields.take(fields.count(1));
    takeImage(data, width, height, row_step, table);
    return cloud;
}

bool hasWrongByteOrder(const PointTable& table) {
    constexpr std::size_t kMaxExamined = 1000;
    const auto plausible = [](const PointTable& some) {
        std::size_t count = 0;
        for (const char* name : {"x", "y", "z"}) {
            const observations::PointField* const field = findExactly(some, name);
            if (field == nullptr) continue;
            for (const double at_m : columnOf(some, *field)) {
                const double size_m = std::abs(at_m);
                count += at_m == 0 || (size_m > 1e-4 && size_m < 1e4);
            }
        }
        return count;
    };
    check(table);
    std::vector<std::uint32_t> examined;
    const std::size_t step = table.points / kMaxExamined + 1;
    for (std::size_t i = 0; i < table.points; i += step) {
        examined.push_back(static_cast<std::uint32_t>(i));
    }
    PointTable some = pointsOf(table, examined);
    const std::size_t as_stated = plausible(some);
    some.is_big_endian = !some.is_big_endian;
    return 2 * as_stated < plausible(some);
}

PacketsMessage readVelodyneScan(FieldReader& fields) {
    PacketsMessage scan;
    scan.header = readHeader(fields);
    scan.packets.resize(fields.count(8 + kVelodyneMessageBytes));
    for (PacketsMessage::Packet& packet : scan.packets) {
        packet.time_ns = readTime(fields);
        packet.bytes = fields.take(kVelodyneMessageBytes).data;
        packet.size = kVelodyneMessageBytes;
    }
    return scan;
}

PacketsMessage readPandarScan(FieldReader& fields) {
    constexpr std::size_t kBytes = 1500;
    PacketsMessage scan;
    scan.header = readHeader(fields);
    scan.packets.resize(fields.count(8 + kBytes + 4));
    for (PacketsMessage::Packet& packet : scan.packets) {
        packet.time_ns = readTime(fields);
        packet.bytes = fields.take(kBytes).data;
        packet.size = std::min<std::size_t>(fields.number<std::uint32_t>(), kBytes);
    }
    return scan;
}

ByteView readPacket(FieldReader& fields) { return fields.take(fields.count(1)); }

LivoxMessage readLivox(FieldReader& fields) {
    LivoxMessage message;
    message.header = readHeader(fields);
    fields.number<std::uint64_t>();  // sensor time of the first point
    const auto claimed = fields.number<std::uint32_t>();
    fields.take(4);  // sensor number, and three reserved bytes
    constexpr std::size_t kMinPoint = 19;
    message.points.resize(fields.count(kMinPoint));
    if (message.points.size() != claimed) {
        throw std::runtime_error("it claims " + std::to_string(claimed) + " points and has " +
                                 std::to_string(message.points.size()));
    }
    for (LivoxPoint& point : message.points) {
        point.since_ns = fields.number<std::uint32_t>();
        point.x_m = fields.number<float>();
        point.y_m = fields.number<float>();
        point.z_m = fields.number<float>();
        point.reflectivity = fields.number<std::uint8_t>();
        point.tag = fields.number<std::uint8_t>();
        point.line = fields.number<std::uint8_t>();
    }
    return message;
}

std::optional<mrpt::poses::CPose3D> PoseMessage::pose() const {
    const double norm = normOf(rotation_wxyz);
    const bool is_sound = isRotation(rotation_wxyz) && std::isfinite(position_m[0]) &&
                          std::isfinite(position_m[1]) && std::isfinite(position_m[2]);
    if (!is_sound) return std::nullopt;
    const mrpt::math::CQuaternionDouble rotation(rotation_wxyz[0] / norm, rotation_wxyz[1] / norm,
                                                 rotation_wxyz[2] / norm, rotation_wxyz[3] / norm);
    return mrpt::poses::CPose3D(rotation, position_m[0], position_m[1], position_m[2]);
}

PoseMessage readPoseStamped(FieldReader& fields) {
    PoseMessage message;
    message.header = readHeader(fields);
    message.position_m = readDoubles<3>(fields);
    message.rotation_wxyz = readRotation(fields);
    return message;
}

PoseMessage readOdometry(FieldReader& fields) {
    PoseMessage message;
    message.header = readHeader(fields);
    message.child = withoutSlash(fields.text());
    message.position_m = readDoubles<3>(fields);
    message.rotation_wxyz = readRotation(fields);
    return message;
}

std::vector<PoseMessage> readTransforms(FieldReader& fields) {
    constexpr std::size_t kMinTransform = 8 + 4 + 4 + 7 * 8;
    std::vector<PoseMessage> transforms(fields.count(kMinTransform));
    for (PoseMessage& transform : transforms) transform = readOdometry(fields);  // same fields
    return transforms;
}

ImuMessage readImu(FieldReader& fields) {
    ImuMessage message;
    message.header = readHeader(fields);
    const auto rotation = readRotation(fields);
    const auto covariance = readDoubles<9>(fields);
    // -1 means no orientation, as documented in sensor_msgs/Imu. Many drivers set zeros instead.
    if (covariance[0] != -1 && isRotation(rotation)) message.rotation_wxyz = rotation;
    readDoubles<3 + 9>(fields);  // angular velocity
    message.acceleration_m_s2 = readDoubles<3>(fields);
    return message;
}

std::string readString(FieldReader& fields) { return fields.text(); }

}  // namespace hagen::recordings
