#include "recordings/bags/BagScans.h"
#include <hagen/mrpt/LocatedCloud.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include "mrpt/TableCloud.h"
#include "recordings/Remarks.h"
#include "recordings/SweepObservation.h"
#include "sensors/ouster/OusterScan.h"
#include "sensors/velodyne/VelodyneTurns.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <iterator>
#include <set>

#include "recordings/bags/Messages.h"

namespace hagen::recordings {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationPointCloud;
using observations::NumberType;
using observations::PointTable;

constexpr std::size_t kMaxHeldBytes = 256 << 20, kHeldAround = 128;

struct TopicState {
    std::string name;
    const BagSensor* sensor = nullptr;
    std::size_t messages = 0, scans = 0, unreadable = 0;
    std::string first_unreadable;          ///< message and reason
    std::size_t points_without_range = 0;  ///< only for Livox messages
    // Only for tables of points:
    std::size_t points_not_finite = 0;
    std::map<std::string, std::size_t> clouds_with;  ///< clouds with each remark
    // Only for packets:
    std::optional<sensors::VelodyneTurns> turns;
    std::unique_ptr<sensors::OusterFrames> frames;
    std::unique_ptr<sensors::SweepReader> sweeps;  ///< Hesai
    std::map<std::string, std::size_t> skipped;    ///< packets by reason
};

/// Records which parts of a table are not used.
void note(const CObservation& scan, TopicState& state) {
    const observations::TableCloud* const cloud = observations::tableCloudOf(scan);
    if (cloud == nullptr) return;
    state.points_not_finite += cloud->pointsNotFinite();
    for (const std::string& remark : cloud->remarks()) ++state.clouds_with[remark];
}

void addLivoxPoint(const LivoxPoint& point, Scan& scan) {
    scan.x_m.push_back(point.x_m);
    scan.y_m.push_back(point.y_m);
    scan.z_m.push_back(point.z_m);
    scan.intensity.push_back(static_cast<float>(point.reflectivity) / 255.0f);
    scan.time_s.push_back(1e-9f * static_cast<float>(point.since_ns));
}

template <class Number>
void addLivoxColumn(const char* name, NumberType type, const std::vector<LivoxPoint>& points,
                    Number LivoxPoint::*number, PointTable& table) {
    std::vector<double> numbers;
    for (const LivoxPoint& point : points) numbers.push_back(static_cast<double>(point.*number));
    addColumn(name, type, numbers, table);
}

PointTable livoxTableOf(const std::vector<LivoxPoint>& points, bool has_returns) {
    PointTable table;
    table.points = points.size();
    if (has_returns) {
        addLivoxColumn("x", NumberType::Float32, points, &LivoxPoint::x_m, table);
        addLivoxColumn("y", NumberType::Float32, points, &LivoxPoint::y_m, table);
        addLivoxColumn("z", NumberType::Float32, points, &LivoxPoint::z_m, table);
        addLivoxColumn("offset_time", NumberType::UInt32, points, &LivoxPoint::since_ns, table);
        addLivoxColumn("reflectivity", NumberType::UInt8, points, &LivoxPoint::reflectivity, table);
    }
    addLivoxColumn("tag", NumberType::UInt8, points, &LivoxPoint::tag, table);
    addLivoxColumn("line", NumberType::UInt8, points, &LivoxPoint::line, table);
    return table;
}

std::int64_t timeOfPacket(const PacketsMessage::Packet& packet, const PacketsMessage& message,
                          std::int64_t recorded_ns) {
    if (packet.time_ns != 0) return packet.time_ns;
    return message.header.time_ns != 0 ? message.header.time_ns : recorded_ns;
}

/// Returns freed memory to the system. glibc keeps it per thread, so memory use would grow with
/// large clouds that one thread allocates and another frees.
void trimHeap() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

}  // namespace

struct BagScans::Reader {
    std::filesystem::path file;
    const BagSurvey& survey;
    BagPlan plan;
    std::unique_ptr<BagFile> bag;
    struct Held {
        std::size_t topic;
        std::vector<std::uint8_t> bytes;
    };
    std::multimap<std::int64_t, Held> held;  ///< by time; equal times keep their order
    Held returned{};
    std::size_t held_bytes = 0, late = 0;  ///< messages returned too late
    std::int64_t latest_ns = INT64_MIN;
    bool is_bag_at_end = false;
    decltype(BagOptions::packet) pass;
    std::map<std::string, TopicState> states;  ///< by topic
    std::vector<TopicState*> state_of;  ///< by topic index in the bag; null if not a LiDAR topic
    std::vector<std::uint8_t> unpacked;
    std::deque<CObservation::Ptr> complete;
    std::shared_ptr<const SensorModel> mid360 =
        std::make_shared<const SensorModel>(sensorModel("Mid-360"));
    bool is_at_end = false;
    std::size_t scans = 0, messages = 0, first_scan;
    std::size_t bytes_untrimmed = 0;  ///< size of the scans read since trimHeap()
    std::string broken_because;

    Reader(const std::filesystem::path& name, const BagSurvey& surveyed, const BagOptions& options)
        : file(name),
          survey(surveyed),
          plan(planOf(name, survey, options)),
          bag(openBag(name)),
          pass(options.packet),
          first_scan(options.first_scan) {
        for (const auto& [topic, sensor] : plan.sensors) {
            TopicState& state = states[topic];
            state.name = topic;
            state.sensor = &sensor;
            if (sensor.kind == LidarKind::Hesai) state.sweeps = sensors::makeHesaiSweeps();
            if (sensor.ouster) {
                state.frames = std::make_unique<sensors::OusterFrames>(*sensor.ouster);
            }
        }
    }

    /// Reads the next message of the bag. Returns false at its end, also if it is broken.
    bool read(BagMessage& message) {
        bool is_read = false;
        try {
            is_read = !is_bag_at_end && bag->next(message);
            noteDamage();
        } catch (const BrokenRecording& e) {
            noteDamage();
            if (broken_because.empty()) broken_because = e.what();
        }
        messages += is_read;
        is_bag_at_end = !is_read;
        return is_read;
    }
    /// Like read(). LiDAR messages that are stored out of order, such as topic by topic, are put
    /// into the order of their recording times by holding some; those stored even later keep their
    /// place.
    bool next(BagMessage& message) {
        if (!survey.is_out_of_order) return read(message);
        while (held_bytes < kMaxHeldBytes && read(message)) {
            if (stateOf(message) == nullptr) continue;
            held_bytes += message.size + kHeldAround;
            held.emplace(message.time_ns,
                         Held{message.topic, {message.bytes, message.bytes + message.size}});
        }
        if (held.empty()) return false;
        const auto first = held.begin();
        late += first->first < latest_ns;
        latest_ns = std::max(latest_ns, first->first);
        returned = std::move(first->second);
        message = {returned.topic, first->first, returned.bytes.data(), returned.bytes.size()};
        held_bytes -= returned.bytes.size() + kHeldAround;
        held.erase(first);
        return true;
    }
    void noteDamage() {
        const std::string damage = bag->takeDamage();
        if (damage.empty()) return;
        if (scans < first_scan && !survey.is_out_of_order) {
            plan.remarks.push_back(damage);
        } else if (broken_because.empty()) {
            broken_because = damage;
        }
    }
    TopicState* stateOf(const BagMessage& message);
    void take(const BagMessage& message);
    void takeLidar(const BagMessage& message, const BagTopic& topic, TopicState& state);
    void takeCloud(FieldReader fields, std::int64_t recorded_ns, TopicState& state);
    void takeLivox(FieldReader fields, std::int64_t recorded_ns, TopicState& state);
    void takeVelodyne(FieldReader fields, std::int64_t recorded_ns, TopicState& state);
    void takeHesai(FieldReader fields, std::int64_t recorded_ns, TopicState& state);
    void takeOuster(FieldReader fields, std::int64_t recorded_ns, TopicState& state);
    void addAttitude(std::int64_t recorded_ns);
    void add(const CObservation::Ptr& scan, TopicState& state);
    void addComplete(TopicState& state);
    void finish();
    static std::string describe(const TopicState& state);
    std::string whyEmpty() const;
};

/// The state of a message's topic; null if it is not read.
TopicState* BagScans::Reader::stateOf(const BagMessage& message) {
    const std::vector<BagTopic>& topics = bag->topics();
    while (state_of.size() < topics.size()) {
        const BagTopic& topic = topics[state_of.size()];
        const auto state = states.find(topic.name);
        const bool is_read =
            state != states.end() && lidarKindOf(topic) == state->second.sensor->kind;
        state_of.push_back(is_read ? &state->second : nullptr);
    }
    return state_of[message.topic];
}

void BagScans::Reader::take(const BagMessage& message) {
    TopicState* const state = stateOf(message);
    if (state == nullptr) return;
    addAttitude(message.time_ns);
    takeLidar(message, bag->topics()[message.topic], *state);
}

void BagScans::Reader::takeLidar(const BagMessage& message, const BagTopic& topic,
                                 TopicState& state) {
    constexpr std::size_t kTrimEvery = 8 << 20;
    bytes_untrimmed += message.size;
    if (bytes_untrimmed > kTrimEvery) {
        trimHeap();
        bytes_untrimmed = 0;
    }
    const std::size_t number = state.messages++;
    try {
        const FieldReader fields = fieldsOf(message, topic.encoding, unpacked);
        switch (state.sensor->kind) {
            case LidarKind::Cloud:
                takeCloud(fields, message.time_ns, state);
                break;
            case LidarKind::Velodyne:
                takeVelodyne(fields, message.time_ns, state);
                break;
            case LidarKind::Hesai:
                takeHesai(fields, message.time_ns, state);
                break;
            case LidarKind::Ouster:
                takeOuster(fields, message.time_ns, state);
                break;
            case LidarKind::Livox1:
            case LidarKind::Livox2:
                takeLivox(fields, message.time_ns, state);
                break;
            case LidarKind::None:
                break;
        }
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        if (state.unreadable++ > 0) return;
        state.first_unreadable = nameOf(number, message.time_ns) + e.what();
    }
}

void BagScans::Reader::add(const CObservation::Ptr& scan, TopicState& state) {
    scan->sensorLabel = state.sensor->label;
    note(*scan, state);
    ++state.scans;
    ++scans;
    complete.push_back(scan);
}

void BagScans::Reader::takeCloud(FieldReader fields, std::int64_t recorded_ns, TopicState& state) {
    PointCloud2 cloud = readPointCloud2(fields);
    if (hasWrongByteOrder(cloud.table)) {
        cloud.table.is_big_endian = !cloud.table.is_big_endian;
        ++state.clouds_with["is_bigendian is wrong, read in the other byte order"];
    }
    const std::int64_t time_ns = cloud.header.time_ns != 0 ? cloud.header.time_ns : recorded_ns;
    auto scan =
        observations::observationOf(std::make_shared<const PointTable>(std::move(cloud.table)), "",
                                    timeOf(time_ns), state.sensor->period_s);
    scan->sensorPose = state.sensor->on_vehicle;
    add(scan, state);
}

void BagScans::Reader::takeLivox(FieldReader fields, std::int64_t recorded_ns, TopicState& state) {
    LivoxMessage message = readLivox(fields);
    const auto first_none = std::remove_if(
        message.points.begin(), message.points.end(),
        [](const LivoxPoint& point) { return point.x_m == 0 && point.y_m == 0 && point.z_m == 0; });
    const auto without_range =
        static_cast<std::size_t>(std::distance(first_none, message.points.end()));
    message.points.erase(first_none, message.points.end());
    const std::int64_t time_ns = message.header.time_ns != 0 ? message.header.time_ns : recorded_ns;
    CObservationPointCloud::Ptr scan;
    if (state.sensor->kind == LidarKind::Livox1) {
        scan = observations::observationOf(
            std::make_shared<const PointTable>(livoxTableOf(message.points, true)), "",
            timeOf(time_ns));
    } else {
        Scan points;
        for (const LivoxPoint& point : message.points) addLivoxPoint(point, points);
        locateBeams(*mid360, points);
        scan = CObservationPointCloud::Create();
        scan->timestamp = timeOf(time_ns);
        scan->pointcloud = std::make_shared<observations::LocatedCloud>(
            points, mid360, livoxTableOf(message.points, false));
    }
    scan->sensorPose = state.sensor->on_vehicle;
    state.points_without_range += without_range;
    add(scan, state);
}

void BagScans::Reader::takeVelodyne(FieldReader fields, std::int64_t recorded_ns,
                                    TopicState& state) {
    const PacketsMessage message = readVelodyneScan(fields);
    for (const PacketsMessage::Packet& sent : message.packets) {
        const std::uint8_t id = sent.bytes[sensors::kVelodyneModelAt];
        const auto* const model = sensors::velodyneModelOf(sent.bytes);
        if (!sensors::isVelodyneData(sent.bytes, sensors::kVelodynePacketBytes)) {
            ++state.skipped["of another kind"];
        } else if (model == &sensors::hdl64Model()) {
            ++state.skipped["from an HDL-64E, which is not supported in bags"];
        } else if (model == nullptr || model != state.sensor->velodyne) {
            ++state.skipped["from " + (model != nullptr ? "another Velodyne (" + model->name + ")"
                                                        : sensors::describeUnsupported(id))];
        } else {
            if (!state.turns) {
                const BagSensor& sensor = *state.sensor;
                state.turns.emplace(*model, sensor.label, nullptr, sensor.silence);
            }
            sensors::VelodynePacket packet;
            std::copy_n(sent.bytes, packet.bytes.size(), packet.bytes.begin());
            packet.time_ns = timeOfPacket(sent, message, recorded_ns);
            state.turns->add(packet);
        }
    }
    addComplete(state);
}

void BagScans::Reader::takeHesai(FieldReader fields, std::int64_t recorded_ns, TopicState& state) {
    constexpr std::uint16_t kPort = 2368;
    const PacketsMessage message = readPandarScan(fields);
    for (const PacketsMessage::Packet& sent : message.packets) {
        const sensors::Datagram datagram{
            timeOfPacket(sent, message, recorded_ns), 0, 0, kPort, kPort, sent.bytes, sent.size};
        if (pass) pass(state.sensor->label, datagram);
        state.sweeps->add(datagram);
    }
    addComplete(state);
}

void BagScans::Reader::takeOuster(FieldReader fields, std::int64_t recorded_ns, TopicState& state) {
    const sensors::OusterSensor& sensor = *state.sensor->ouster;
    ByteView packet = readPacket(fields);
    packet.size -= packet.size % 2;  // the ROS 1 driver appends a byte to packets
    const sensors::Datagram datagram{recorded_ns, 0, 0, 7502, 7502, packet.data, packet.size};
    switch (sensors::kindOf(datagram, sensor)) {
        case sensors::OusterPacketKind::Imu:
            ++state.skipped["from an IMU"];
            return;
        case sensors::OusterPacketKind::OtherSensor:
            throw std::runtime_error("its packet is from the sensor with serial number " +
                                     std::to_string(sensors::serialOf(packet.data, sensor)) +
                                     ", but the metadata are from " + sensor.serial);
        case sensors::OusterPacketKind::Other:
            if (packet.size == sensor.packetBytes()) {
                ++state.skipped["of another kind"];
                return;
            }
            throw std::runtime_error("its packet has " + std::to_string(packet.size) +
                                     " bytes, but the sensor's packets have " +
                                     std::to_string(sensor.packetBytes()) + " (profile " +
                                     sensor.profile.name + "). Is it another sensor's metadata?");
        case sensors::OusterPacketKind::Lidar:
            break;
    }
    if (pass) pass(state.sensor->label, datagram);
    state.frames->add(packet.data, recorded_ns);
    addComplete(state);
}

void BagScans::Reader::addComplete(TopicState& state) {
    const auto addSweeps = [&](std::deque<sensors::LidarSweep>& sweeps) {
        for (const sensors::LidarSweep& sweep : sweeps) {
            const CObservation::Ptr scan = observationOf(sweep);
            scan->setSensorPose(state.sensor->on_vehicle);
            add(scan, state);
        }
        sweeps.clear();
    };
    if (state.turns) addSweeps(state.turns->complete());
    if (state.sweeps) addSweeps(state.sweeps->complete());
    if (state.frames) {
        for (const sensors::OusterFrame& frame : state.frames->complete()) {
            const CObservation::Ptr scan = observationOf(sweepOf(frame, *state.sensor->ouster));
            const mrpt::poses::CPose3D on_sensor(scan->sensorPose());
            scan->setSensorPose(state.sensor->on_vehicle + on_sensor);
            add(scan, state);
        }
        state.frames->complete().clear();
    }
}

/// Adds the last orientation of the IMU that was recorded before a message.
void BagScans::Reader::addAttitude(std::int64_t recorded_ns) {
    using namespace mrpt::obs;
    const auto imu = survey.imus.find(plan.imu_topic);
    if (imu == survey.imus.end()) return;
    const auto& all = imu->second.orientations;
    const auto after = std::upper_bound(
        all.begin(), all.end(), recorded_ns,
        [](std::int64_t time_ns, const auto& one) { return time_ns < one.recorded_ns; });
    if (after == all.begin()) return;
    const BagSurvey::Imu::Orientation& latest = *std::prev(after);
    auto observation = CObservationIMU::Create();
    observation->timestamp = timeOf(latest.time_ns);
    observation->sensorLabel = plan.imu_topic;
    observation->sensorPose = plan.imu_on_vehicle;
    observation->set(IMU_ORI_QUAT_W, latest.wxyz[0]);
    observation->set(IMU_ORI_QUAT_X, latest.wxyz[1]);
    observation->set(IMU_ORI_QUAT_Y, latest.wxyz[2]);
    observation->set(IMU_ORI_QUAT_Z, latest.wxyz[3]);
    complete.push_back(observation);
}

void BagScans::Reader::finish() {
    is_at_end = true;
    for (auto& [topic, state] : states) {
        if (state.turns) state.turns->finish();
        if (state.sweeps) state.sweeps->finish();
        if (state.frames) state.frames->finish();
        addComplete(state);
    }
}

std::string BagScans::Reader::describe(const TopicState& state) {
    std::string text = counted(state.messages, "message");
    if (state.turns) {
        text += ", " + state.sensor->velodyne->name + ", " + sensors::textOf(state.turns->counts());
    } else if (state.frames) {
        text += ", " + state.sensor->ouster->name + ", " + sensors::textOf(state.frames->counts());
    }
    if (state.sweeps) {
        for (const std::string& remark : state.sweeps->remarks()) text += ", " + remark;
        const std::string ignored = state.sweeps->ignored();
        if (!ignored.empty()) text += ", ignored: " + ignored;
    }
    for (const auto& [why, packets] : state.skipped) {
        addCount(packets, "packet", why + ", skipped", text);
    }
    addCount(state.points_without_range, "point", "without a range, skipped", text);
    addCount(state.points_not_finite, "point",
             "with non-finite coordinates, dropped from the scans (--clouds writes them with "
             "label 0)",
             text);
    addCount(state.unreadable, "message", "that could not be read, skipped", text);
    if (state.unreadable > 0) text += "; the first: " + state.first_unreadable;
    for (const auto& [remark, clouds] : state.clouds_with) {
        text += "; " + remark;
        if (clouds == state.scans) continue;
        text += " (" + std::to_string(clouds) + " of " + counted(state.scans, "cloud") + ")";
    }
    return text;
}

std::string BagScans::Reader::whyEmpty() const {
    std::string text = file.string() + ": no scan could be read";
    for (const auto& [topic, state] : states) text += "; " + topic + ": " + describe(state);
    return text;
}

BagScans::BagScans(const std::filesystem::path& file, const BagSurvey& survey,
                   const BagOptions& options)
    : reader_(std::make_unique<Reader>(file, survey, options)) {}

BagScans::~BagScans() = default;

CObservation::Ptr BagScans::next() {
    Reader& r = *reader_;
    BagMessage message;
    while (r.complete.empty() && !r.is_at_end) {
        if (r.next(message)) {
            r.take(message);
        } else {
            r.finish();
        }
    }
    if (!r.complete.empty()) {
        const auto observation = r.complete.front();
        r.complete.pop_front();
        return observation;
    }
    if (!r.broken_because.empty()) throw BrokenRecording(r.broken_because);
    if (r.scans == 0) throw BrokenRecording(r.whyEmpty());
    return nullptr;
}

void BagScans::checkWhileReading(const std::function<void()>& check) {
    reader_->bag->checkWhileReading(check);
}

const BagPlan& BagScans::plan() const { return reader_->plan; }

std::size_t BagScans::messagesRead() const { return reader_->messages; }

double BagScans::fractionRead() const {
    return reader_->is_at_end ? 1.0 : reader_->bag->fractionRead();
}

std::vector<std::string> BagScans::remarks() const {
    const Reader& r = *reader_;
    std::vector<std::string> remarks = r.bag->remarks();
    if (r.late > 0) {
        remarks.push_back(
            counted(r.late, "LiDAR message") + " stored more than " +
            std::to_string(kMaxHeldBytes >> 20) +
            " MB after later messages, read out of order; sort the recording by time");
    }
    remarks.insert(remarks.end(), r.plan.remarks.begin(), r.plan.remarks.end());
    for (const auto& [topic, state] : r.states) {
        remarks.push_back(state.sensor->label + " (" + topic + "): " + Reader::describe(state));
    }
    for (const auto& [topic, skipped] : r.survey.skipped) {
        remarks.push_back(topic + ": " + counted(skipped.number, "message") +
                          " skipped; the first: " + skipped.first);
    }
    BagSurvey others;  // messages of unused topics
    std::set<std::string> types{"nav_msgs/Odometry", "geometry_msgs/PoseStamped",
                                "geometry_msgs/PoseWithCovarianceStamped", "tf2_msgs/TFMessage",
                                "tf/tfMessage"};
    for (const BagSurvey::Topic& topic : r.survey.topics) {
        const std::string& name = topic.topic.name;
        const std::string& type = topic.topic.type;
        const auto state = r.states.find(name);  // a topic may have several types
        const bool is_scans = state != r.states.end() && topic.kind == state->second.sensor->kind;
        const bool is_imu = name == r.plan.imu_topic && type == "sensor_msgs/Imu";
        const bool is_used =
            is_scans || is_imu || types.count(type) > 0 ||
            (topic.kind == LidarKind::None && r.survey.ouster_metadata.count(name) > 0);
        if (!is_used) others.topics.push_back(topic);
    }
    if (!others.topics.empty()) {
        constexpr std::size_t kMax = 12;
        remarks.push_back("unused topics: " + textOfTopics(others, kMax));
    }
    return remarks;
}

}  // namespace hagen::recordings
