#include "recordings/bags/BagSurvey.h"
#include <hagen/sensors/VelodynePacket.h>
#include "base/Text.h"
#include "recordings/Remarks.h"

#include <algorithm>

#include "recordings/bags/Messages.h"
#include "recordings/bags/PoseSeries.h"
#include "recordings/bags/TopicList.h"

namespace hagen::recordings {
namespace {

constexpr std::size_t kMaxExamined = 20;  // max. Velodyne messages, one turn each
constexpr std::size_t kMaxOusterMetadata = 1 << 20;

void addPose(const PoseMessage& message, std::int64_t recorded_ns, PoseSeries& series) {
    const auto pose = message.pose();
    if (!pose) throw std::runtime_error("its pose has non-finite values or an invalid quaternion");
    const std::int64_t time_ns = message.header.time_ns != 0 ? message.header.time_ns : recorded_ns;
    // Uses doubles, because times in a broken file may overflow integers.
    const auto apart_ns = [&] {
        return std::abs(static_cast<double>(time_ns) -
                        static_cast<double>(series.poses.back().time_ns));
    };
    if (!series.poses.empty() && apart_ns() < kMinApart_ns) return;
    mrpt::math::CQuaternionDouble q;
    pose->getAsQuaternion(q);
    series.poses.push_back({time_ns, pose->x(), pose->y(), pose->z(), q.r(), q.x(), q.y(), q.z()});
}

class BagSurveyor {
 public:
    void see(const BagMessage& message, const std::vector<BagTopic>& topics) {
        while (survey_.topics.size() < topics.size()) addTopic(topics[survey_.topics.size()]);
        BagSurvey::Topic& topic = survey_.topics[message.topic];
        if (topic.messages++ == 0) topic.first_ns = message.time_ns;
        topic.last_ns = message.time_ns;
        ++survey_.messages;
        if (topic.kind != LidarKind::None) {
            survey_.is_out_of_order |= message.time_ns < latest_ns_;
            latest_ns_ = std::max(latest_ns_, message.time_ns);
        }
        try {
            read(message, topic);
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& e) {
            // BagScans counts unreadable LiDAR messages.
            if (topic.kind != LidarKind::None) return;
            skip(message, topic, e.what());
        }
    }
    void addTopic(const BagTopic& topic) {
        BagSurvey::Topic& added = survey_.topics.emplace_back();
        added.topic = topic;
        added.kind = lidarKindOf(topic);
    }
    BagSurvey survey() && {
        for (auto& [topic, imu] : survey_.imus) {
            std::stable_sort(
                imu.orientations.begin(), imu.orientations.end(),
                [](const auto& a, const auto& b) { return a.recorded_ns < b.recorded_ns; });
        }
        return std::move(survey_);
    }

 private:
    void skip(const BagMessage& message, const BagSurvey::Topic& topic, const std::string& why) {
        Skipped& skipped = survey_.skipped[topic.topic.name];
        if (skipped.number++ > 0) return;
        skipped.first = nameOf(topic.messages - 1, message.time_ns) + why;
    }

    void read(const BagMessage& message, BagSurvey::Topic& topic) {
        const std::string& type = topic.topic.type;
        if (topic.kind != LidarKind::None) {
            const bool lacks_model =
                topic.kind == LidarKind::Velodyne &&
                (topic.velodyne_messages < kMaxExamined || !topic.velodyne_view.silence());
            if (topic.frame.empty() || lacks_model) look(message, topic);
        } else if (type == "nav_msgs/Odometry") {
            FieldReader fields = fieldsOf(message, topic.topic.encoding, unpacked_);
            take(readOdometry(fields), message, topic.topic, survey_.odometry);
        } else if (type == "geometry_msgs/PoseStamped" ||
                   type == "geometry_msgs/PoseWithCovarianceStamped") {
            FieldReader fields = fieldsOf(message, topic.topic.encoding, unpacked_);
            take(readPoseStamped(fields), message, topic.topic, survey_.poses);
        } else if (type == "sensor_msgs/Imu") {
            FieldReader fields = fieldsOf(message, topic.topic.encoding, unpacked_);
            const ImuMessage imu = readImu(fields);
            if (!imu.rotation_wxyz) return;
            BagSurvey::Imu& seen = survey_.imus[topic.topic.name];
            if (seen.orientations.empty()) seen.frame = imu.header.frame;
            const std::int64_t time_ns = imu.header.time_ns;
            seen.orientations.push_back(
                {message.time_ns, time_ns != 0 ? time_ns : message.time_ns, *imu.rotation_wxyz});
            seen.acceleration_m_s2 +=
                Eigen::Map<const Eigen::Vector3d>(imu.acceleration_m_s2.data());
        } else if (type == "tf2_msgs/TFMessage" || type == "tf/tfMessage") {
            readFrames(message, topic);
        } else if (type == "std_msgs/String" && base::endsWith(topic.topic.name, "metadata") &&
                   message.size <= kMaxOusterMetadata) {
            FieldReader fields = fieldsOf(message, topic.topic.encoding, unpacked_);
            survey_.ouster_metadata[topic.topic.name] = readString(fields);
        }
    }

    /// Examines the first messages of a LiDAR topic. For a Velodyne, one packet is not enough,
    /// because it may be from another sensor.
    void look(const BagMessage& message, BagSurvey::Topic& topic) {
        if (topic.kind == LidarKind::Ouster) return;  // no header
        FieldReader fields = fieldsOf(message, topic.topic.encoding, unpacked_);
        if (topic.kind != LidarKind::Velodyne) {
            topic.frame = readHeader(fields).frame;
            return;
        }
        const PacketsMessage scan = readVelodyneScan(fields);
        if (topic.frame.empty()) topic.frame = scan.header.frame;
        bool names_model = false;
        for (const PacketsMessage::Packet& packet : scan.packets) {
            const bool is_data =
                sensors::isVelodyneData(packet.bytes, sensors::kVelodynePacketBytes);
            if (!is_data || sensors::isOfHdl64(packet.bytes)) continue;
            const std::uint8_t id = packet.bytes[sensors::kVelodyneModelAt];
            ++topic.velodyne_ids[id];
            if (sensors::findVelodyneModel(id) == nullptr) continue;
            names_model = true;
            sensors::VelodynePacket of_model;
            std::copy_n(packet.bytes, of_model.bytes.size(), of_model.bytes.begin());
            topic.velodyne_view.add(of_model);
        }
        topic.velodyne_messages += names_model ? 1 : 0;
    }

    static void take(const PoseMessage& pose, const BagMessage& message, const BagTopic& topic,
                     std::map<std::string, PoseSeries>& by_topic) {
        PoseSeries& series = by_topic[topic.name];
        if (series.poses.empty()) {
            series.source = topic.type + " on " + topic.name;
            series.parent = pose.header.frame;
            series.child = pose.child;
        }
        addPose(pose, message.time_ns, series);
    }

    void readFrames(const BagMessage& message, const BagSurvey::Topic& topic) {
        FieldReader fields = fieldsOf(message, topic.topic.encoding, unpacked_);
        const bool is_static = base::endsWith(topic.topic.name, "tf_static");
        for (const PoseMessage& transform : readTransforms(fields)) {
            const std::string& parent = transform.header.frame;
            const std::string which = "from '" + parent + "' to '" + transform.child + "'";
            const auto pose = transform.pose();
            if (!pose) {
                skip(message, topic, which + ": it has non-finite values or an invalid quaternion");
                continue;
            }
            if (parent == transform.child) {
                skip(message, topic, which + ": a frame cannot be its own parent");
                continue;
            }
            const bool is_known = survey_.transforms.count(transform.child) > 0;
            const bool is_added = is_static
                                      ? survey_.frames.add(parent, transform.child, *pose)
                                      : is_known || survey_.transforms.size() < kMaxMovingFrames;
            if (!is_added) skip(message, topic, which + ": too many frames");
            if (!is_added || is_static) continue;
            PoseSeries& series = survey_.transforms[transform.child];
            if (series.poses.empty()) {
                series.parent = parent;
                series.child = transform.child;
                series.source = "transforms from " + series.parent + " to " + series.child;
            }
            // Skip other parents: mixing the poses of two publishers would cause jumps.
            if (series.parent != parent) {
                skip(message, topic, which + ", before from '" + series.parent + "'");
                continue;
            }
            addPose(transform, message.time_ns, series);
        }
    }

    BagSurvey survey_;
    std::int64_t latest_ns_ = INT64_MIN;  ///< latest time of a LiDAR message
    std::vector<std::uint8_t> unpacked_;
};

}  // namespace

LidarKind lidarKindOf(const BagTopic& topic) {
    static const std::map<std::string, LidarKind> kinds{
        {"sensor_msgs/PointCloud2", LidarKind::Cloud},
        {"velodyne_msgs/VelodyneScan", LidarKind::Velodyne},
        {"ouster_ros/PacketMsg", LidarKind::Ouster},
        {"ouster_msgs/PacketMsg", LidarKind::Ouster},
        {"ouster_sensor_msgs/PacketMsg", LidarKind::Ouster},
        {"livox_ros_driver2/CustomMsg", LidarKind::Livox2},
        {"livox_interfaces/CustomMsg", LidarKind::Livox1},
        {"livox_ros_driver/CustomMsg", LidarKind::Livox1},
        {"pandar_msgs/PandarScan", LidarKind::Hesai}};
    const auto found = kinds.find(topic.type);
    if (found == kinds.end()) return LidarKind::None;
    const bool is_of_imu =
        found->second == LidarKind::Ouster && topic.name.find("imu") != std::string::npos;
    return is_of_imu ? LidarKind::None : found->second;
}

BagSurvey surveyBag(const std::filesystem::path& file, const std::function<bool()>& keep_going) {
    struct Ended {};
    const auto bag = openBag(file);
    bag->checkWhileReading([&] {
        if (!keep_going()) throw Ended();
    });
    BagSurveyor surveyor;
    bool is_whole = true;
    std::string broken_because;
    try {
        BagMessage message;
        while (bag->next(message)) surveyor.see(message, bag->topics());
    } catch (const Ended&) {
        is_whole = false;
    } catch (const BrokenRecording& e) {
        is_whole = false;  // BagScans reports the error
        broken_because = e.what();
    }
    BagSurvey survey = std::move(surveyor).survey();
    survey.broken_because = broken_because;
    survey.damage = bag->takeDamage();
    for (std::size_t i = survey.topics.size(); i < bag->topics().size(); ++i) {
        auto& topic = survey.topics.emplace_back();
        topic.topic = bag->topics()[i];
        topic.kind = lidarKindOf(topic.topic);
    }
    survey.is_whole = is_whole;
    return survey;
}

std::string textOfTopics(const BagSurvey& survey, std::size_t max) {
    std::string text;
    std::size_t listed = 0;
    for (const BagSurvey::Topic& topic : survey.topics) {
        if (listed++ == max) break;
        text += (text.empty() ? "" : ", ") + topic.topic.name + " (" +
                (topic.topic.type.empty() ? "unknown type" : topic.topic.type) + ", " +
                counted(topic.messages, "message") + ")";
    }
    if (survey.topics.size() > max) {
        text += " and " + std::to_string(survey.topics.size() - max) + " more";
    }
    return text.empty() ? "none" : text;
}

}  // namespace hagen::recordings
