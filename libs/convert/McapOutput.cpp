#include "convert/McapOutput.h"

#include <hagen/convert/WriteCloud.h>
#include <hagen/mrpt/TimeStamp.h>
#include "convert/RosMessages.h"
#include "filter/RoiBoxes.h"

#include <chrono>
#include <limits>

#include "convert/LabelledTable.h"

namespace hagen::convert {
namespace {

constexpr const char* kMap = "map";

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::string rosNameOf(const std::string& sensor_label) {
    std::string name;
    for (const char c : sensor_label) {
        const bool is_plain = isLetter(c) || isDigit(c);
        // ROS 2 does not allow two underscores in a row.
        if (!is_plain && !name.empty() && name.back() == '_') continue;
        name += is_plain ? c : '_';
    }
    if (name.empty()) return "lidar";
    if (!isLetter(name[0])) name = (name[0] == '_' ? "lidar" : "lidar_") + name;
    for (const char* const frame : {kMap, "odom", "world"}) {
        if (name == frame) return name + "_lidar";
    }
    return name;
}

McapOutput::McapOutput(const std::filesystem::path& file, bool overwrite)
    : path_(file, base::kFile, overwrite), writer_(path_.temporary(), path_.path()) {}

McapOutput::Lidar& McapOutput::lidarOf(const std::string& sensor_label) {
    const auto known = lidars_.find(sensor_label);
    if (known != lidars_.end()) return known->second;
    const std::string plain = rosNameOf(sensor_label);
    std::string name = plain;
    for (int n = 2; !names_.insert(name).second; ++n) name = plain + "_" + std::to_string(n);
    const std::uint16_t points = writer_.addTopic("/" + name + "/points", pointCloud2Type());
    const std::uint16_t obstacles = writer_.addTopic("/" + name + "/obstacles", markerArrayType());
    return lidars_.emplace(sensor_label, Lidar{name, points, obstacles, std::nullopt})
        .first->second;
}

/// Nanoseconds since 1970, or 0 if ROS cannot represent the time.
std::int64_t McapOutput::stampOf(mrpt::Clock::time_point time) {
    if (!observations::isTime(time)) {
        ++untimed_;
        return 0;
    }
    const auto since_1970 = time - mrpt::Clock::fromDouble(0);
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since_1970).count();
    if (since_1970.count() < 0 || seconds > std::numeric_limits<std::int32_t>::max()) {
        ++untimed_;
        return 0;
    }
    return std::chrono::duration_cast<std::chrono::nanoseconds>(since_1970).count();
}

void McapOutput::writePose(const mrpt::poses::CPose3D& pose, std::int64_t time_ns, Lidar& lidar) {
    if (!lidar.pose) {
        lidar.pose = writer_.addTopic("/" + lidar.name + "/pose", poseStampedType());
    }
    if (!tf_) tf_ = writer_.addTopic("/tf", transformsType());
    const RosHeader in_map{time_ns, kMap};
    const auto at = static_cast<std::uint64_t>(time_ns);
    writer_.write(*lidar.pose, at, poseMessage(in_map, pose));
    writer_.write(*tf_, at, transformMessage(in_map, lidar.name, pose));
}

void McapOutput::write(const observations::ObservationSegmenter::Output& segmented,
                       const mrpt::obs::CObservation& observation) {
    Lidar& lidar = lidarOf(observation.sensorLabel);
    const std::int64_t time_ns = stampOf(observation.timestamp);
    const RosHeader header{time_ns, lidar.name};
    const auto at = static_cast<std::uint64_t>(time_ns);

    if (segmented.pose.sensor_pose) writePose(*segmented.pose.sensor_pose, time_ns, lidar);
    const LabelledTable labelled = labelledTable(segmented, observation);
    const observations::PointTable& table = labelled.table;
    changes_.add(labelled.remarks());
    changes_.add(changesInPointCloud2(table));
    writer_.write(lidar.points, at, pointCloud2Message(header, tableForPointCloud2(table)));
    const auto boxes = boxesToDraw(boxRoiComponents(*segmented.scan, segmented.result->returns));
    writer_.write(lidar.obstacles, at, boxesMessage(header, boxes));
    ++scans_;
    points_ += table.points;
    boxes_ += boxes.size();
}

std::vector<std::string> McapOutput::remarks() const {
    std::vector<std::string> remarks = changes_.texts(scans_);
    if (untimed_ > 0) {
        remarks.push_back(std::to_string(untimed_) + " of " + std::to_string(scans_) +
                          " scans have no time within the range of ROS (1970 to 2038); set to 0");
    }
    for (const auto& [label, lidar] : lidars_) {
        if (lidar.name == label) continue;
        remarks.push_back("the LiDAR '" + label + "' is renamed to '" + lidar.name +
                          "' to conform to ROS naming rules");
    }
    return remarks;
}

void McapOutput::commit() {
    if (scans_ > 0) path_.commit();
}

}  // namespace hagen::convert
