#include "convert/RosMessages.h"
#include <mrpt/math/CQuaternion.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "mrpt/NumberTypes.h"

namespace hagen::convert {
namespace {

using mrpt::poses::CPose3D;
using observations::PointTable;

/// Writes the fields of a message as little-endian CDR, which FieldReader::ofCdr() reads: a
/// four-byte header, then the fields, with numbers aligned to their size.
class CdrWriter {
 public:
    CdrWriter() : bytes_{0, 1, 0, 0} {}

    void reserve(std::size_t bytes) { bytes_.reserve(bytes); }

    template <class Number>
    CdrWriter& number(Number value) {
        static_assert(std::is_integral_v<Number> || std::is_floating_point_v<Number>);
        constexpr std::size_t kSize = sizeof(Number);
        const std::size_t beyond = (bytes_.size() - kHeader) % kSize;
        if (beyond > 0) bytes_.resize(bytes_.size() + kSize - beyond, 0);
        std::uint8_t raw[kSize];
        std::memcpy(raw, &value, kSize);
        bytes_.insert(bytes_.end(), raw, raw + kSize);
        return *this;
    }

    /// Writes the number of elements that follow. Throws std::runtime_error if it exceeds 32 bits.
    CdrWriter& count(std::size_t elements) {
        if (elements > std::numeric_limits<std::uint32_t>::max()) {
            throw std::runtime_error("a message cannot hold " + std::to_string(elements) +
                                     " elements");
        }
        return number(static_cast<std::uint32_t>(elements));
    }

    CdrWriter& text(const std::string& text) {
        count(text.size() + 1);
        bytes_.insert(bytes_.end(), text.begin(), text.end());
        bytes_.push_back(0);
        return *this;
    }

    /// Writes a length prefix, then the bytes.
    CdrWriter& counted(const std::vector<std::uint8_t>& bytes) {
        count(bytes.size());
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        return *this;
    }

    std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
    static constexpr std::size_t kHeader = 4;
    std::vector<std::uint8_t> bytes_;
};

// Message definitions from docs.ros.org/en/humble.

using Part = std::pair<const char*, const char*>;  // name and fields
const Part kTime{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec"};
const Part kDuration{"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec"};
const Part kStdHeader{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id"};
const Part kPoint{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z"};
const Part kVector3{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z"};
const Part kQuaternion{"geometry_msgs/Quaternion",
                       "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1"};
const Part kPose{"geometry_msgs/Pose",
                 "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation"};
const Part kTransform{"geometry_msgs/Transform",
                      "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation"};
const Part kTransformStamped{"geometry_msgs/TransformStamped",
                             "std_msgs/Header header\nstring child_frame_id\n"
                             "geometry_msgs/Transform transform"};
const Part kPointField{
    "sensor_msgs/PointField",
    "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\n"
    "uint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 datatype\nuint32 count"};
const Part kCompressedImage{"sensor_msgs/CompressedImage",
                            "std_msgs/Header header\nstring format\nuint8[] data"};
const Part kColor{"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a"};
const Part kUvCoordinate{"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v"};
const Part kMeshFile{"visualization_msgs/MeshFile", "string filename\nuint8[] data"};
const Part kMarker{
    "visualization_msgs/Marker",
    "int32 ARROW=0\nint32 CUBE=1\nint32 SPHERE=2\nint32 CYLINDER=3\nint32 LINE_STRIP=4\n"
    "int32 LINE_LIST=5\nint32 CUBE_LIST=6\nint32 SPHERE_LIST=7\nint32 POINTS=8\n"
    "int32 TEXT_VIEW_FACING=9\nint32 MESH_RESOURCE=10\nint32 TRIANGLE_LIST=11\n"
    "int32 ADD=0\nint32 MODIFY=0\nint32 DELETE=2\nint32 DELETEALL=3\n"
    "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n"
    "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n"
    "builtin_interfaces/Duration lifetime\nbool frame_locked\ngeometry_msgs/Point[] points\n"
    "std_msgs/ColorRGBA[] colors\nstring texture_resource\nsensor_msgs/CompressedImage texture\n"
    "visualization_msgs/UVCoordinate[] uv_coordinates\nstring text\nstring mesh_resource\n"
    "visualization_msgs/MeshFile mesh_file\nbool mesh_use_embedded_materials"};

RosType rosTypeOf(const char* name, const char* fields, std::initializer_list<Part> parts) {
    RosType type{name, fields};
    for (const Part& part : parts) {
        type.definition +=
            "\n" + std::string(80, '=') + "\nMSG: " + part.first + "\n" + part.second;
    }
    type.definition += "\n";
    return type;
}

void put(const RosHeader& header, CdrWriter& to) {
    constexpr std::int64_t kSecond_ns = 1000000000;
    if (header.time_ns < 0 ||
        header.time_ns / kSecond_ns > std::numeric_limits<std::int32_t>::max())
        throw std::runtime_error("a time is not between 1970 and 2038");
    to.number(static_cast<std::int32_t>(header.time_ns / kSecond_ns));
    to.number(static_cast<std::uint32_t>(header.time_ns % kSecond_ns));
    to.text(header.frame);
}

/// Writes a position and a rotation, as in geometry_msgs/Pose and Transform.
void put(const CPose3D& pose, CdrWriter& to) {
    mrpt::math::CQuaternionDouble rotation;
    pose.getAsQuaternion(rotation);
    to.number(pose.x()).number(pose.y()).number(pose.z());
    to.number(rotation.x()).number(rotation.y()).number(rotation.z()).number(rotation.r());
}

std::uint8_t datatypeOf(const observations::PointField& field) {
    const auto& types = observations::kPointFieldTypes;
    const auto* const type = std::find(types.begin(), types.end(), field.type);
    if (type == types.end()) {
        throw std::runtime_error("a PointCloud2 cannot hold the field '" + field.name +
                                 "' of type " + nameOf(field.type));
    }
    return static_cast<std::uint8_t>(1 + (type - types.begin()));
}

bool isFinite(const PointTable& table) {
    for (const char* const name : {"x", "y", "z"}) {
        const auto* const field = findField(table, {name});
        if (field == nullptr) continue;
        const std::vector<double> numbers = columnOf(table, *field);
        if (!std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); }))
            return false;
    }
    return true;
}

constexpr std::int32_t kCube = 1, kAdd = 0, kDeleteAll = 3;

/// Writes a marker; fields for other shapes are empty.
void putMarker(const RosHeader& header, std::int32_t id, std::int32_t action,
               const Eigen::AlignedBox3f& box, CdrWriter& to) {
    constexpr float kThinnest_m = 0.01f;  // viewers reject boxes without volume
    put(header, to);
    to.text(action == kDeleteAll ? "" : "obstacles").number(id).number(kCube).number(action);
    const Eigen::Vector3d center = box.center().cast<double>();
    put(CPose3D(center.x(), center.y(), center.z(), 0, 0, 0), to);
    const Eigen::Vector3f size = box.sizes().cwiseMax(kThinnest_m);
    for (const float length : {size.x(), size.y(), size.z()}) {
        to.number(static_cast<double>(length));
    }
    for (const float part : {1.0f, 0.75f, 0.47f, 0.35f}) to.number(part);  // r, g, b, a
    to.number(std::int32_t{0}).number(std::uint32_t{0});                   // lifetime: unlimited
    to.number(std::uint8_t{0}).count(0).count(0);                          // points, colours
    to.text("");
    put(RosHeader(), to);
    to.text("").count(0).count(0);  // texture and its coordinates
    to.text("").text("").text("").count(0).number(std::uint8_t{0});
}

}  // namespace

const RosType& pointCloud2Type() {
    static const RosType kType = rosTypeOf(
        "sensor_msgs/msg/PointCloud2",
        "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
        "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense",
        {kStdHeader, kTime, kPointField});
    return kType;
}

const RosType& markerArrayType() {
    static const RosType kType =
        rosTypeOf("visualization_msgs/msg/MarkerArray", "visualization_msgs/Marker[] markers",
                  {kMarker, kStdHeader, kTime, kDuration, kPose, kPoint, kQuaternion, kVector3,
                   kColor, kCompressedImage, kUvCoordinate, kMeshFile});
    return kType;
}

const RosType& poseStampedType() {
    static const RosType kType = rosTypeOf("geometry_msgs/msg/PoseStamped",
                                           "std_msgs/Header header\ngeometry_msgs/Pose pose",
                                           {kStdHeader, kTime, kPose, kPoint, kQuaternion});
    return kType;
}

const RosType& transformsType() {
    static const RosType kType =
        rosTypeOf("tf2_msgs/msg/TFMessage", "geometry_msgs/TransformStamped[] transforms",
                  {kTransformStamped, kStdHeader, kTime, kTransform, kVector3, kQuaternion});
    return kType;
}

std::vector<std::uint8_t> pointCloud2Message(const RosHeader& header, const PointTable& table) {
    CdrWriter to;
    to.reserve(table.bytes.size() + 1024);
    put(header, to);
    to.number(std::uint32_t{1}).count(table.points).count(table.fields.size());
    for (const observations::PointField& field : table.fields) {
        to.text(field.name).count(field.offset).number(datatypeOf(field)).count(field.count);
    }
    to.number(static_cast<std::uint8_t>(table.is_big_endian));
    to.count(table.bytes_per_point).count(table.points * table.bytes_per_point);
    to.counted(table.bytes).number(static_cast<std::uint8_t>(isFinite(table)));
    return to.take();
}

std::vector<std::uint8_t> boxesMessage(const RosHeader& header, const std::vector<RoiBox>& boxes) {
    CdrWriter to;
    to.count(boxes.size() + 1);
    const Eigen::Vector3f origin = Eigen::Vector3f::Zero();
    putMarker(header, 0, kDeleteAll, {origin, origin}, to);
    for (const RoiBox& box : boxes) putMarker(header, box.component, kAdd, box.extents_m, to);
    return to.take();
}

std::vector<std::uint8_t> poseMessage(const RosHeader& header, const CPose3D& pose) {
    CdrWriter to;
    put(header, to);
    put(pose, to);
    return to.take();
}

std::vector<std::uint8_t> transformMessage(const RosHeader& header, const std::string& child,
                                           const CPose3D& pose) {
    CdrWriter to;
    to.count(1);
    put(header, to);
    to.text(child);
    put(pose, to);
    return to.take();
}

}  // namespace hagen::convert
