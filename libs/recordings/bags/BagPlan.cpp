#include "recordings/bags/BagPlan.h"
#include <hagen/scan/Angle.h>
#include "base/Text.h"
#include "recordings/Remarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "recordings/bags/PoseSeries.h"
#include "recordings/bags/TopicList.h"

namespace hagen::recordings {
namespace {

using Topic = BagSurvey::Topic;
using mrpt::poses::CPose3D;

constexpr double kMinCovered = 0.5;                // min. share of the time covered by poses
constexpr int kMaxFrameDepth = 64;                 // max. nesting of frames
constexpr const char* kOusterFrame = "os_sensor";  // of the vendor's driver

std::string withSlash(const std::string& topic) {
    return topic.empty() || topic.front() == '/' ? topic : "/" + topic;
}

/// Returns "/ouster" for "/ouster/points".
std::string namespaceOf(const std::string& topic) {
    return topic.substr(0, topic.rfind('/') == std::string::npos ? 0 : topic.rfind('/'));
}

bool isPackets(LidarKind kind) { return kind != LidarKind::None && kind != LidarKind::Cloud; }

/// A label that differs from those of other topics and of segmentation results.
std::string labelOf(const std::string& topic, std::set<std::string>& taken) {
    std::string label = topic.substr(!topic.empty() && topic.front() == '/');
    std::replace(label.begin(), label.end(), '/', '_');
    if (label.empty()) label = "lidar";
    if (base::endsWith(label, "_roi")) label += "_points";
    std::string unique = label;
    for (int n = 2; !taken.insert(unique).second; ++n) unique = label + "_" + std::to_string(n);
    return unique;
}

/// True if a frame has the name of a world frame, such as "odom" or "robot1/odom_combined".
bool isWorld(const std::string& frame) {
    for (std::size_t at = 0; at < frame.size();) {
        const std::size_t end = std::min(frame.find_first_of("/_", at), frame.size());
        const std::string word = frame.substr(at, end - at);
        if (word == "map" || word == "odom" || word == "world" || word == "earth") return true;
        at = end + 1;
    }
    return false;
}

/// True if the last part of a frame's name is that of a vehicle frame: "base_link", "robot1/base".
bool isOfVehicle(const std::string& frame) {
    const std::string name = frame.substr(frame.rfind('/') + 1);
    return name == "base" || name.compare(0, 5, "base_") == 0;
}

class Planner {
 public:
    Planner(const std::filesystem::path& file, const BagSurvey& survey, const BagOptions& options)
        : file_(file), survey_(survey), options_(options), frames_(survey.frames) {}

    BagPlan plan() && {
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
        const bool is_broken = !survey_.broken_because.empty();
        const std::string& broken = is_broken ? survey_.broken_because : survey_.damage;
        throw std::runtime_error(file_.string() + ": " + why +
                                 (broken.empty() ? "" : "; it is only partly readable: " + broken));
    }

    static std::string textOfKnownTypes() {
        return "sensor_msgs/PointCloud2, velodyne_msgs/VelodyneScan, Ouster PacketMsg, "
               "Livox CustomMsg, pandar_msgs/PandarScan";
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
                fail("the topic '" + name + "' has the type " + found->topic.type +
                     ", not a LiDAR type (" + textOfKnownTypes() +
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
                                        "; select it with --topic to read it");
            }
        }
        checkJson();
        if (without_metadata != nullptr) {
            if (plan_.sensors.empty()) failOuster(*without_metadata);
            plan_.remarks.push_back(without_metadata->topic.name +
                                    " is not read: Ouster packets require metadata, which the "
                                    "bag lacks; pass them with --sensor-json FILE");
        }
        if (!plan_.sensors.empty()) return;
        if (!lidars.empty()) {
            plan_.remarks.clear();
            fail("its LiDAR topics have no sensor scans (" + lidars.front()->topic.name + ": " +
                 whyNot(*lidars.front(), lidars) + "); select one with --topic to read it anyway");
        }
        // If the bag is truncated, reading it reports the truncation instead.
        if (survey_.is_whole) {
            fail("has no LiDAR topic (" + textOfKnownTypes() +
                 "); it has: " + textOfTopics(survey_));
        }
    }

    /// Why a topic is not read unless it is selected; empty if it is read.
    std::string whyNot(const Topic& topic, const std::vector<const Topic*>& lidars) const {
        if (topic.kind == LidarKind::Velodyne && !isReadable(topic)) {
            std::string found;
            for (const auto& [id, packets] : topic.velodyne_ids) {
                found += (found.empty() ? ", but from " : ", ") + sensors::describeUnsupported(id);
            }
            return "its packets are not from a known Velodyne (" +
                   sensors::knownVelodynes().substr(1) + ")" + found;
        }
        if (topic.kind != LidarKind::Cloud) return "";
        for (const Topic* other : lidars) {
            if (isPackets(other->kind) && isReadable(*other) && isSameSensor(topic, *other)) {
                return "its clouds are from the sensor with packets on " + other->topic.name;
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

    /// The model of most packets; null if unknown.
    static const sensors::VelodyneModel* findVelodyne(const Topic& topic) {
        const sensors::VelodyneModel* most = nullptr;
        std::size_t max_packets = 0;
        for (const auto& [id, count] : topic.velodyne_ids) {
            const sensors::VelodyneModel* const model = sensors::findVelodyneModel(id);
            if (model == nullptr || count <= max_packets) continue;
            most = model;
            max_packets = count;
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
        if (topic.messages > 1) {
            const auto duration_ns =
                static_cast<double>(topic.last_ns) - static_cast<double>(topic.first_ns);
            sensor.period_s = 1e-9 * duration_ns / static_cast<double>(topic.messages - 1);
        }
        if (topic.kind == LidarKind::Ouster) sensor.ouster = findOuster(topic);
        if (topic.kind == LidarKind::Velodyne) {
            sensor.velodyne = findVelodyne(topic);
            sensor.silence = topic.velodyne_view.silence().value_or(sensors::SilentSector());
        }
        frame_of_[topic.topic.name] = topic.kind == LidarKind::Ouster ? kOusterFrame : topic.frame;
    }

    std::shared_ptr<const sensors::OusterSensor> findOuster(const Topic& topic) const {
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
            sensor = std::make_shared<const sensors::OusterSensor>(
                options_.sensor_json.empty()
                    ? sensors::ousterSensorOf(survey_.ouster_metadata.at(text_of),
                                              file_.string() + ": topic " + text_of)
                    : sensors::readOusterSensor(options_.sensor_json));
        }
        return sensor;
    }

    [[noreturn]] void failOuster(const Topic& topic) const {
        fail("the packets on " + topic.topic.name +
             " require Ouster metadata, but the bag has no topic '" +
             namespaceOf(topic.topic.name) +
             "/metadata' (std_msgs/String); pass them with --sensor-json FILE");
    }

    void checkJson() const {
        if (options_.sensor_json.empty()) return;
        for (const auto& [topic, sensor] : plan_.sensors) {
            if (sensor.kind == LidarKind::Ouster) return;
        }
        fail("no selected topic has Ouster packets for the metadata " +
             options_.sensor_json.string());
    }

    void takeMost(const std::map<std::string, PoseSeries>& all, bool is_dense) {
        if (plan_.poses != nullptr) return;
        for (const auto& [name, series] : all) {
            if (series.poses.empty() || (is_dense && !isDense(series))) continue;
            if (plan_.poses == nullptr || series.poses.size() > plan_.poses->poses.size()) {
                plan_.poses = &series;
            }
        }
    }

    /// True if a topic may be read. Needed because poses are chosen before topics.
    bool mayBeRead(const Topic& topic) const {
        if (topic.kind == LidarKind::None) return false;
        if (options_.topics.empty()) return !isFixed(topic.frame);
        return std::any_of(options_.topics.begin(), options_.topics.end(),
                           [&](const std::string& name) {
                               return withSlash(name) == withSlash(topic.topic.name);
                           });
    }

    /// Frames of all LiDARs that may be read.
    std::vector<std::string> framesOfLidars() const {
        std::vector<std::string> frames;
        std::set<std::string> known;
        for (const Topic& topic : survey_.topics) {
            if (!mayBeRead(topic)) continue;
            const std::string frame = topic.kind == LidarKind::Ouster ? kOusterFrame : topic.frame;
            if (known.insert(frame).second) frames.push_back(frame);
        }
        return frames;
    }

    using Way = std::vector<const PoseSeries*>;

    /// A path from a frame towards the root.
    struct Climb {
        Way still;                       ///< constant transforms before the first moving transform
        std::vector<MovingStep> moving;  ///< transforms from the first moving transform on
        std::string top;                 ///< last frame of the path
        CPose3D in_top;                  ///< pose in `top` of the last moving step's parent
        bool is_at_goal = false, is_circle = false;
    };

    /// Climbs to `goal` or a frame rigidly attached to it; if `goal` is empty, to a world frame or
    /// a frame without parent.
    Climb climb(const std::string& frame, const std::string& goal = "") const {
        Climb climb;
        climb.top = frame;
        for (int depth = 0; depth < kMaxFrameDepth; ++depth) {
            const std::string at = climb.top;
            if (const auto pose = goal.empty() ? std::nullopt : frames_.poseIn(at, goal)) {
                climb.top = goal;
                climb.in_top = *pose + climb.in_top;
                climb.is_at_goal = true;
                return climb;
            }
            const auto ends_at = [&](const std::string& end) {
                return !climb.moving.empty() && isWorld(end);
            };
            const std::string root = frames_.rootOf(at);
            const auto in_root = frames_.poseIn(at, root);  // nullopt if static frames form a cycle
            if (ends_at(at) || !in_root) return climb;
            climb.top = root;
            climb.in_top = *in_root + climb.in_top;
            const auto next = survey_.transforms.find(root);
            const bool is_root = next == survey_.transforms.end() || next->second.poses.empty();
            if (is_root || ends_at(root)) return climb;
            const PoseSeries& series = next->second;
            climb.top = series.parent;
            if (isStill(series)) {
                climb.in_top = poseOf(series.poses.front()) + climb.in_top;
                if (climb.moving.empty()) climb.still.push_back(&series);
                continue;
            }
            climb.is_circle =
                std::any_of(climb.moving.begin(), climb.moving.end(),
                            [&](const MovingStep& step) { return step.series == &series; });
            if (climb.is_circle) return climb;
            // Composed poses are those of the first step's child.
            climb.moving.push_back({climb.moving.empty() ? CPose3D() : climb.in_top, &series});
            climb.in_top = CPose3D();
        }
        climb.is_circle = true;
        return climb;
    }

    void addAsStatic(const Way& way) {
        for (const PoseSeries* step : way) {
            frames_.add(step->parent, step->child, poseOf(step->poses.front()));
        }
    }

    /// Composes the poses of the steps. Returns false if the steps have no times in common.
    bool takeComposed(const std::vector<MovingStep>& steps, const std::string& top,
                      const CPose3D& in_top) {
        auto poses = std::make_shared<PoseSeries>(composed(steps, top, in_top));
        if (poses->poses.empty()) return false;
        plan_.composed = poses;
        plan_.poses = poses.get();
        return true;
    }

    /// Uses the transforms that move the frame to which a LiDAR is attached. If nothing moves, the
    /// vehicle is stationary, and constant transforms are used.
    void takeTransforms() {
        if (plan_.poses != nullptr) return;
        std::vector<std::string> frames = framesOfLidars();
        frames.insert(frames.end(), {"base_link", "base_footprint"});
        std::optional<Climb> moving;
        Way still;  // up to the first parent that is not a vehicle frame
        for (const std::string& frame : frames) {
            const Climb found = climb(frame);
            const auto outside =
                std::find_if(found.still.begin(), found.still.end(),
                             [](const PoseSeries* series) { return !isOfVehicle(series->parent); });
            if (still.empty() && outside != found.still.end()) {
                still.assign(found.still.begin(), outside + 1);
            }
            if (found.moving.empty()) continue;
            if (!moving) moving = found;
            const bool is_same = found.moving.front().series == moving->moving.front().series;
            if (is_same) addAsStatic(found.still);
        }
        if (moving) {
            takeMoving(*moving);
        } else if (!still.empty()) {
            plan_.poses = still.back();
            still.pop_back();
            addAsStatic(still);
        }
    }

    void takeMoving(const Climb& climb) {
        const PoseSeries& first = *climb.moving.front().series;
        const std::string& parent = climb.moving.back().series->parent;
        // Constant transforms above the last moving transform are needed only within the vehicle.
        const bool is_within = isOfVehicle(parent);
        const std::string& top = is_within ? climb.top : parent;
        std::string why;
        if (climb.is_circle) {
            why = "form a cycle";
        } else if (isOfVehicle(top)) {
            why = "do not locate '" + top + "'";
        } else if (climb.moving.size() == 1 && !is_within) {
            plan_.poses = &first;
        } else if (!takeComposed(climb.moving, top, is_within ? climb.in_top : CPose3D())) {
            why = "have no times in common";
        }
        if (why.empty()) return;
        plan_.remarks.push_back("the transforms from '" + top + "' to '" + first.child + "' " +
                                why + ", so they provide no poses");
    }

    /// If all LiDARs move relative to the frame of the poses, adds the transforms to the frame to
    /// which the first of them is attached.
    void carryPosesToLidars() {
        if (plan_.poses == nullptr || plan_.poses->child.empty()) return;
        const std::string& child = plan_.poses->child;
        std::optional<Climb> way;
        for (const std::string& frame : framesOfLidars()) {
            const Climb found = climb(frame, child);
            if (!found.is_at_goal) continue;
            if (found.moving.empty()) return;  // a LiDAR is attached to the frame
            if (!way) way = found;
        }
        if (!way) return;
        std::vector<MovingStep> steps = way->moving;
        steps.push_back({way->in_top, plan_.poses});
        const std::string source = plan_.poses->source + " and transforms from " + child + " to " +
                                   steps.front().series->child;
        auto poses = std::make_shared<PoseSeries>(composed(steps, plan_.poses->parent, CPose3D()));
        if (poses->poses.empty() || covered_s(*poses) < kMinCovered * covered_s(*plan_.poses)) {
            plan_.remarks.push_back("the transforms from '" + child + "' to '" +
                                    steps.front().series->child +
                                    "' are too far apart in time to be used with the poses");
            return;
        }
        poses->source = source;
        plan_.composed = poses;
        plan_.poses = poses.get();
        addAsStatic(way->still);
    }

    void choosePoses() {
        addStillTransforms();
        takeMost(survey_.odometry, true);
        takeMost(survey_.poses, true);
        takeTransforms();
        takeMost(survey_.odometry, false);
        takeMost(survey_.poses, false);
        carryPosesToLidars();
    }

    /// Treats constant transforms on tf from a LiDAR to the vehicle as static, because ROS 1
    /// systems often repeat them there.
    void addStillTransforms() {
        std::set<std::string> vehicles{"base_link", "base_footprint"};
        for (const auto& [topic, series] : survey_.odometry) vehicles.insert(series.child);
        for (const Topic& topic : survey_.topics) {
            if (topic.kind == LidarKind::None) continue;
            Way way;
            std::string at = topic.kind == LidarKind::Ouster ? kOusterFrame : topic.frame;
            for (int depth = 0; depth < kMaxFrameDepth && vehicles.count(at) == 0; ++depth) {
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

    /// The pose of a frame on the vehicle; nullopt if unknown.
    std::optional<CPose3D> onVehicle(const std::string& frame) const {
        std::vector<std::string> vehicles{"base_link", "base_footprint"};
        // The default frames may move relative to the frame of the poses.
        if (plan_.poses != nullptr && !plan_.poses->child.empty()) vehicles = {plan_.poses->child};
        for (const std::string& vehicle : vehicles) {
            if (const auto pose = frames_.poseIn(frame, vehicle)) return pose;
        }
        // Without a transform to the vehicle, the poses do not apply to this frame.
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
                ": using the poses of " + plan_.poses->source + " as sensor poses");
        }
    }

    void chooseImu() {
        std::size_t most = 0;
        for (const bool is_mounted : {true, false}) {
            // Prefer a vehicle's pose to an IMU with an unknown mount.
            if (!is_mounted && (!plan_.imu_topic.empty() || plan_.poses != nullptr)) return;
            for (const auto& [topic, imu] : survey_.imus) {
                const auto pose = onVehicle(imu.frame);
                const std::size_t orientations = imu.orientations.size();
                if (pose.has_value() != is_mounted || orientations <= most) continue;
                if (!showsAttitude(topic, imu)) continue;
                most = orientations;
                plan_.imu_topic = topic;
                plan_.imu_on_vehicle = pose.value_or(CPose3D());
                for (auto& [name, sensor] : plan_.sensors) {
                    sensor.has_imu = sharesMount(frame_of_[name], imu.frame);
                }
            }
        }
    }

    /// False if all orientations are the default (0, 0, 0, 1) and the acceleration contradicts
    /// them.
    bool showsAttitude(const std::string& topic, const BagSurvey::Imu& imu) {
        constexpr double kMaxTilt_rad = 0.35;
        const auto isDefault = [](const auto& one) {
            return one.wxyz == std::array<double, 4>{1, 0, 0, 0};
        };
        if (!std::all_of(imu.orientations.begin(), imu.orientations.end(), isDefault)) return true;
        const Eigen::Vector3d& up = imu.acceleration_m_s2;
        const double tilt_rad = std::atan2(up.head<2>().norm(), up.z());
        if (!(tilt_rad > kMaxTilt_rad)) return true;
        plan_.remarks.push_back(topic + ": all orientations are (0, 0, 0, 1), but gravity is " +
                                std::to_string(std::lround(degrees(tilt_rad))) +
                                " degrees off the z axis: not used as attitude");
        return false;
    }

    /// Whether a LiDAR and an IMU are fixed to each other and neither to the vehicle, as far as is
    /// known. The mount of the settings is then part of the orientation.
    bool sharesMount(const std::string& lidar, const std::string& imu) const {
        const std::string root = frames_.rootOf(lidar);
        const bool is_vehicle = root.find("base") != std::string::npos ||
                                (plan_.poses != nullptr && root == plan_.poses->child);
        return !lidar.empty() && (lidar == imu || (root == frames_.rootOf(imu) && !is_vehicle));
    }

    const std::filesystem::path& file_;
    const BagSurvey& survey_;
    const BagOptions& options_;
    FrameTree frames_;
    BagPlan plan_;
    std::set<std::string> labels_;
    std::map<std::string, std::string> frame_of_;  ///< frame of each topic
    mutable std::map<std::string, std::shared_ptr<const sensors::OusterSensor>> ousters_;
};

}  // namespace

BagPlan planOf(const std::filesystem::path& file, const BagSurvey& survey,
               const BagOptions& options) {
    return Planner(file, survey, options).plan();
}

}  // namespace hagen::recordings
