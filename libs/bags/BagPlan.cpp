#include <hagen/bags/BagPlan.h>
#include <hagen/captures/Remarks.h>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <stdexcept>

namespace hagen::bags {
namespace {

using Topic = BagSurvey::Topic;
using mrpt::poses::CPose3D;

constexpr double kFarApart_s = 0.5;
constexpr int kDeepest = 64;                       // frames on frames
constexpr const char* kOusterFrame = "os_sensor";  // of the maker's driver, whose packets name none

std::string withSlash(const std::string& topic) {
    return topic.empty() || topic.front() == '/' ? topic : "/" + topic;
}

/// "/ouster" of "/ouster/points".
std::string namespaceOf(const std::string& topic) {
    return topic.substr(0, topic.rfind('/') == std::string::npos ? 0 : topic.rfind('/'));
}

bool isPackets(LidarKind kind) { return kind != LidarKind::None && kind != LidarKind::Cloud; }

bool endsWith(const std::string& text, const std::string& ending) {
    return text.size() >= ending.size() &&
           text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

/// A label that no other topic has, and that no result of segmentation has.
std::string labelOf(const std::string& topic, std::set<std::string>& taken) {
    std::string label = topic.substr(!topic.empty() && topic.front() == '/');
    std::replace(label.begin(), label.end(), '/', '_');
    if (label.empty()) label = "lidar";
    if (endsWith(label, "_roi")) label += "_points";
    std::string unique = label;
    for (int n = 2; !taken.insert(unique).second; ++n) unique = label + "_" + std::to_string(n);
    return unique;
}

/// Whether poses are close enough to place scans with them.
bool isDense(const PoseSeries& series) {
    if (series.poses.size() < 2) return false;
    const double seconds = 1e-9 * (static_cast<double>(series.poses.back().time_ns) -
                                   static_cast<double>(series.poses.front().time_ns));
    return seconds <= kFarApart_s * static_cast<double>(series.poses.size() - 1);
}

bool isStill(const PoseSeries& series) {
    const RecordedPose& first = series.poses.front();
    return std::all_of(series.poses.begin(), series.poses.end(), [&](const RecordedPose& pose) {
        return pose.x_m == first.x_m && pose.y_m == first.y_m && pose.z_m == first.z_m &&
               pose.qw == first.qw && pose.qx == first.qx && pose.qy == first.qy &&
               pose.qz == first.qz;
    });
}

class Planner {
 public:
    Planner(const std::filesystem::path& file, const BagSurvey& survey, const BagOptions& options)
        : file_(file), survey_(survey), options_(options), frames_(survey.frames) {}

    BagPlan plan() && {
        if (options_.topics.empty()) checkNumberOfLidars();
        choosePoses();
        if (options_.topics.empty()) {
            chooseAll();
        } else {
            chooseNamed();
        }
        mountSensors();
        chooseImu();
        return std::move(plan_);
    }

 private:
    [[noreturn]] void fail(const std::string& why) const {
        const std::string& broken = survey_.broken_because;
        throw std::runtime_error(
            file_.string() + ": " + why +
            (broken.empty() ? "" : "; it can be read only in part: " + broken));
    }

    // Topics.

    /// Each is compared with the others.
    void checkNumberOfLidars() const {
        const auto lidars = std::count_if(
            survey_.topics.begin(), survey_.topics.end(),
            [](const Topic& topic) { return topic.kind != LidarKind::None && topic.messages > 0; });
        if (static_cast<std::size_t>(lidars) <= kMostLidarTopics) return;
        fail("has " + std::to_string(lidars) + " topics of LiDARs, more than " +
             std::to_string(kMostLidarTopics) + "; name those to read with --topic");
    }

    static std::string textOfKnownTypes() {
        return "sensor_msgs/PointCloud2, velodyne_msgs/VelodyneScan, PacketMsg of an Ouster, "
               "CustomMsg of a Livox";
    }

    void chooseNamed() {
        for (const std::string& name : options_.topics) {
            const Topic* found = nullptr;
            for (const Topic& topic : survey_.topics) {
                if (withSlash(topic.topic.name) != withSlash(name)) continue;
                if (found == nullptr || found->kind == LidarKind::None) found = &topic;
            }
            if (found == nullptr) {
                fail("has no topic '" + name + "'; it has: " + textOfTopics(survey_));
            }
            if (found->kind == LidarKind::None) {
                fail("the topic '" + name + "' is of the type " + found->topic.type +
                     ", not of a LiDAR (" + textOfKnownTypes() +
                     "); the bag has: " + textOfTopics(survey_));
            }
            if (found->kind == LidarKind::Ouster && !findOuster(*found)) failOuster(*found);
            add(*found);
        }
        checkJson();
    }

    void chooseAll() {
        std::vector<const Topic*> lidars;
        for (const Topic& topic : survey_.topics) {
            if (topic.kind != LidarKind::None && topic.messages > 0) lidars.push_back(&topic);
        }
        const Topic* without_metadata = nullptr;
        for (const Topic* topic : lidars) {
            if (topic->kind == LidarKind::Ouster && !findOuster(*topic)) {
                without_metadata = topic;
            } else if (const std::string why = whyNot(*topic, lidars); why.empty()) {
                add(*topic);
            } else {
                plan_.remarks.push_back(topic->topic.name + " is not read: " + why +
                                        "; to read it, name it with --topic");
            }
        }
        checkJson();
        if (without_metadata != nullptr) {
            if (plan_.sensors.empty()) failOuster(*without_metadata);
            plan_.remarks.push_back(without_metadata->topic.name +
                                    " is not read: packets of an Ouster need its metadata, which "
                                    "the bag has not: --sensor-json FILE");
        }
        if (!plan_.sensors.empty()) return;
        if (!lidars.empty()) {
            plan_.remarks.clear();
            fail("its LiDAR topics have no scans of a sensor (" + lidars.front()->topic.name +
                 ": " + whyNot(*lidars.front(), lidars) +
                 "); name one with --topic to read it nevertheless");
        }
        // A bag that is cut off says so when it is read.
        if (survey_.is_whole) {
            fail("has no topic of a LiDAR (" + textOfKnownTypes() +
                 "); it has: " + textOfTopics(survey_));
        }
    }

    /// Why a topic is not read unless it is named; empty: it is read.
    std::string whyNot(const Topic& topic, const std::vector<const Topic*>& lidars) const {
        if (topic.kind == LidarKind::Velodyne && !isReadable(topic)) {
            return "its packets are not of a known Velodyne (" +
                   packets::knownVelodynes().substr(1) + ")";
        }
        if (topic.kind != LidarKind::Cloud) return "";
        for (const Topic* other : lidars) {
            if (isPackets(other->kind) && isReadable(*other) && isSameSensor(topic, *other)) {
                return "its clouds are of the sensor whose packets are on " + other->topic.name;
            }
        }
        if (isFixed(topic.frame)) {
            return "its clouds are in the frame '" + topic.frame +
                   "', which does not move with the vehicle";
        }
        return "";
    }

    bool isReadable(const Topic& topic) const {
        if (topic.kind == LidarKind::Ouster) return findOuster(topic) != nullptr;
        return topic.kind != LidarKind::Velodyne || findVelodyne(topic) != nullptr;
    }

    /// The model of most packets; null: none is known.
    static const packets::VelodyneModel* findVelodyne(const Topic& topic) {
        const packets::VelodyneModel* most = nullptr;
        std::size_t most_packets = 0;
        for (const auto& [id, count] : topic.velodyne_ids) {
            const packets::VelodyneModel* const model = packets::findVelodyneModel(id);
            if (model == nullptr || count <= most_packets) continue;
            most = model;
            most_packets = count;
        }
        return most;
    }

    static bool isSameSensor(const Topic& cloud, const Topic& packets) {
        if (packets.kind != LidarKind::Ouster) {
            return !cloud.frame.empty() && cloud.frame == packets.frame;
        }
        const bool is_os = cloud.frame.find("os_") != std::string::npos ||
                           cloud.frame.find("ouster") != std::string::npos;
        return is_os && namespaceOf(cloud.topic.name) == namespaceOf(packets.topic.name);
    }

    bool isFixed(const std::string& frame) const {
        for (const char* name : {"map", "odom", "world"}) {
            if (frame == name) return true;
        }
        const bool is_parent = plan_.poses != nullptr && plan_.poses->parent == frame;
        return is_parent && !frame.empty() && plan_.poses->child != frame;
    }

    void add(const Topic& topic) {
        if (plan_.sensors.count(topic.topic.name) > 0) return;
        BagSensor& sensor = plan_.sensors[topic.topic.name];
        sensor.kind = topic.kind;
        sensor.label = labelOf(topic.topic.name, labels_);
        if (topic.kind == LidarKind::Ouster) sensor.ouster = findOuster(topic);
        if (topic.kind == LidarKind::Velodyne) sensor.velodyne = findVelodyne(topic);
        frame_of_[topic.topic.name] = topic.kind == LidarKind::Ouster ? kOusterFrame : topic.frame;
    }

    // Metadata of Ousters.

    std::shared_ptr<const packets::OusterSensor> findOuster(const Topic& topic) const {
        std::string text_of = options_.sensor_json.string();
        if (text_of.empty()) {
            for (const auto& [name, text] : survey_.ouster_metadata) {
                const bool is_near = namespaceOf(name) == namespaceOf(topic.topic.name);
                if (is_near || survey_.ouster_metadata.size() == 1) text_of = name;
                if (is_near) break;
            }
        }
        if (text_of.empty()) return nullptr;
        auto& sensor = ousters_[text_of];
        if (!sensor) {
            sensor = std::make_shared<const packets::OusterSensor>(
                options_.sensor_json.empty()
                    ? packets::ousterSensorOf(survey_.ouster_metadata.at(text_of),
                                              file_.string() + ": topic " + text_of)
                    : packets::readOusterSensor(options_.sensor_json));
        }
        return sensor;
    }

    [[noreturn]] void failOuster(const Topic& topic) const {
        fail("the packets on " + topic.topic.name +
             " need the metadata of their Ouster, and the bag has no topic '" +
             namespaceOf(topic.topic.name) + "/metadata' (std_msgs/String): --sensor-json FILE");
    }

    void checkJson() const {
        if (options_.sensor_json.empty()) return;
        for (const auto& [topic, sensor] : plan_.sensors) {
            if (sensor.kind == LidarKind::Ouster) return;
        }
        fail("no topic that is read has packets of an Ouster, which " +
             options_.sensor_json.string() + " could describe");
    }

    // Poses.

    void takeMost(const std::map<std::string, PoseSeries>& all, bool is_dense) {
        if (plan_.poses != nullptr) return;
        for (const auto& [name, series] : all) {
            if (series.poses.empty() || (is_dense && !isDense(series))) continue;
            if (plan_.poses == nullptr || series.poses.size() > plan_.poses->poses.size()) {
                plan_.poses = &series;
            }
        }
    }

    /// Whether a topic may be read: poses are chosen before the topics.
    bool mayBeRead(const Topic& topic) const {
        if (topic.kind == LidarKind::None) return false;
        if (options_.topics.empty()) return !isFixed(topic.frame);
        return std::any_of(options_.topics.begin(), options_.topics.end(),
                           [&](const std::string& name) {
                               return withSlash(name) == withSlash(topic.topic.name);
                           });
    }

    using Way = std::vector<const PoseSeries*>;

    /// The first transforms that move, on the way from a frame up the tree; null: none. Those
    /// before them, which never change, are added to `way`.
    const PoseSeries* firstMoving(const std::string& frame, Way& way) const {
        std::string at = frame;
        for (int depth = 0; depth < kDeepest; ++depth) {
            const auto next = survey_.transforms.find(frames_.rootOf(at));
            if (next == survey_.transforms.end() || next->second.poses.empty()) return nullptr;
            if (!isStill(next->second)) return &next->second;
            way.push_back(&next->second);
            at = next->second.parent;
        }
        return nullptr;
    }

    void addAsStatic(const Way& way) {
        for (const PoseSeries* step : way) {
            const RecordedPose& pose = step->poses.front();
            frames_.add(step->parent, step->child,
                        CPose3D(mrpt::math::CQuaternionDouble(pose.qw, pose.qx, pose.qy, pose.qz),
                                pose.x_m, pose.y_m, pose.z_m));
        }
    }

    /// The transforms that move the frame on which a LiDAR hangs. Only if nothing moves they are
    /// some that never change: the vehicle stands still.
    void takeTransforms() {
        if (plan_.poses != nullptr) return;
        std::vector<std::string> frames;
        for (const Topic& topic : survey_.topics) {
            if (!mayBeRead(topic)) continue;
            frames.push_back(topic.kind == LidarKind::Ouster ? kOusterFrame : topic.frame);
        }
        frames.insert(frames.end(), {"base_link", "base_footprint"});
        const PoseSeries* moving = nullptr;
        const PoseSeries* still = nullptr;
        for (const std::string& frame : frames) {
            Way way;
            const PoseSeries* const found = firstMoving(frame, way);
            if (still == nullptr && !way.empty()) still = way.front();
            if (moving == nullptr) moving = found;
            if (found != nullptr && found == moving) addAsStatic(way);
        }
        plan_.poses = moving != nullptr ? moving : still;
    }

    void choosePoses() {
        addStillTransforms();
        takeMost(survey_.odometry, true);
        takeMost(survey_.poses, true);
        takeTransforms();
        takeMost(survey_.odometry, false);
        takeMost(survey_.poses, false);
    }

    /// In ROS 1, transforms that never change are often repeated on tf. They count as static if
    /// they lead from a LiDAR to the vehicle.
    void addStillTransforms() {
        std::set<std::string> vehicles{"base_link", "base_footprint"};
        for (const auto& [topic, series] : survey_.odometry) vehicles.insert(series.child);
        for (const Topic& topic : survey_.topics) {
            if (topic.kind == LidarKind::None) continue;
            Way way;
            std::string at = topic.kind == LidarKind::Ouster ? kOusterFrame : topic.frame;
            for (int depth = 0; depth < kDeepest && vehicles.count(at) == 0; ++depth) {
                at = frames_.rootOf(at);
                const auto next = survey_.transforms.find(at);
                if (vehicles.count(at) > 0 || next == survey_.transforms.end() ||
                    next->second.poses.empty() || !isStill(next->second)) {
                    break;
                }
                way.push_back(&next->second);
                at = next->second.parent;
            }
            if (vehicles.count(at) > 0) addAsStatic(way);
        }
    }

    // Mounts.

    /// The pose of a frame on the vehicle; none if the bag does not say it.
    std::optional<CPose3D> onVehicle(const std::string& frame) const {
        std::vector<std::string> vehicles;
        if (plan_.poses != nullptr && !plan_.poses->child.empty()) {
            vehicles.push_back(plan_.poses->child);
        }
        vehicles.insert(vehicles.end(), {"base_link", "base_footprint"});
        for (const std::string& vehicle : vehicles) {
            if (const auto pose = frames_.poseIn(frame, vehicle)) return pose;
        }
        // Poses of another frame say nothing about the one that it hangs on in the end.
        if (plan_.poses != nullptr || !frames_.has(frame)) return std::nullopt;
        return frames_.poseIn(frame, frames_.rootOf(frame));
    }

    void mountSensors() {
        for (auto& [topic, sensor] : plan_.sensors) {
            const std::string& frame = frame_of_[topic];
            const auto pose = onVehicle(frame);
            if (pose) sensor.on_vehicle = *pose;
            sensor.is_vehicle = plan_.poses != nullptr && frame == plan_.poses->child &&
                                frame != "base_link" && frame != "base_footprint";
            sensor.has_its_own_poses = sensor.is_vehicle;
            if (pose || plan_.poses == nullptr) continue;
            sensor.has_its_own_poses = true;
            plan_.remarks.push_back(
                "no static transform leads from the frame " +
                (frame.empty() ? "of " + topic : "'" + frame + "' of " + topic) + " to " +
                (plan_.poses->child.empty() ? "base_link" : "'" + plan_.poses->child + "'") +
                ": the poses of " + plan_.poses->source + " are taken for those of the sensor");
        }
    }

    void chooseImu() {
        std::size_t most = 0;
        for (const bool is_mounted : {true, false}) {
            // A vehicle's pose is better than an IMU that is mounted nobody knows how.
            if (!is_mounted && (!plan_.imu_topic.empty() || plan_.poses != nullptr)) return;
            for (const auto& [topic, imu] : survey_.imus) {
                const auto pose = onVehicle(imu.frame);
                if (pose.has_value() != is_mounted || imu.orientations <= most) continue;
                most = imu.orientations;
                plan_.imu_topic = topic;
                plan_.imu_on_vehicle = pose.value_or(CPose3D());
            }
        }
    }

    const std::filesystem::path& file_;
    const BagSurvey& survey_;
    const BagOptions& options_;
    FrameTree frames_;
    BagPlan plan_;
    std::set<std::string> labels_;
    std::map<std::string, std::string> frame_of_;  ///< by topic
    mutable std::map<std::string, std::shared_ptr<const packets::OusterSensor>> ousters_;
};

}  // namespace

BagPlan planOf(const std::filesystem::path& file, const BagSurvey& survey,
               const BagOptions& options) {
    return Planner(file, survey, options).plan();
}

}  // namespace hagen::bags
