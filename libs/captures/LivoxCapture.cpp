#include <hagen/captures/LivoxCapture.h>
#include <hagen/observations/LocatedCloud.h>

#include <deque>
#include <map>
#include <tuple>
#include <utility>

#include <hagen/captures/LivoxPacket.h>
#include <hagen/captures/Remarks.h>

namespace hagen::captures {
namespace {

using mrpt::obs::CObservationPointCloud;

constexpr std::uint64_t kScan_ns = 100000000;
constexpr std::uint64_t kInterruption_ns = 1000000000;
constexpr std::size_t kMostSensors = 16;
constexpr std::size_t kMostPackets = 10000;  // of a scan, whatever the clock says; usual are 210

/// What is left out of, and known about, the packets of one sensor.
struct Sensor {
    std::string label;
    std::size_t packets = 0;  ///< taken, without those repeated
    std::size_t scans = 0, lost = 0, late = 0, repeated = 0, interruptions = 0;
    bool is_begun = false;
    std::uint16_t last_number = 0;
    std::uint64_t start_ns = 0, last_ns = 0;  ///< of the scan in progress, by the sensor's clock
    std::int64_t capture_time_ns = 0;         ///< of its first packet
    Scan scan;                                ///< in progress
    std::vector<std::uint8_t> tags;           ///< of its points
    std::size_t scan_packets = 0;
};

}  // namespace

struct LivoxCapture::Reader {
    CaptureFile capture;
    std::shared_ptr<const SensorModel> model =
        std::make_shared<const SensorModel>(sensorModel("Mid-360"));
    std::map<std::uint32_t, Sensor> sensors;  ///< by address
    std::vector<std::uint32_t> order;         ///< of appearance
    std::deque<CObservationPointCloud::Ptr> complete;
    std::size_t further_sensors = 0, imu_packets = 0;
    OtherDatagrams others;
    bool is_at_end = false;
    std::string broken_because;

    explicit Reader(const std::filesystem::path& name) : capture(name) {}

    Sensor* sensorAt(std::uint32_t ip);
    void take(const Datagram& datagram);
    void take(const LivoxPacket& packet, std::int64_t time_ns, Sensor& sensor);
    void endScan(Sensor& sensor);
};

/// The sensor with this address; null if there are too many.
Sensor* LivoxCapture::Reader::sensorAt(std::uint32_t ip) {
    const auto found = sensors.find(ip);
    if (found != sensors.end()) return &found->second;
    if (sensors.size() == kMostSensors) return nullptr;
    order.push_back(ip);
    Sensor& sensor = sensors[ip];
    sensor.label = order.size() == 1 ? "livox" : "livox_" + std::to_string(order.size());
    return &sensor;
}

void LivoxCapture::Reader::take(const Datagram& datagram) {
    const auto packet = livoxPacketOf(datagram);
    if (isLivoxImu(datagram)) {
        ++imu_packets;
    } else if (!packet) {
        others.add(datagram);
    } else if (Sensor* const sensor = sensorAt(datagram.from_ip)) {
        take(*packet, datagram.time_ns, *sensor);
    } else {
        ++further_sensors;
    }
}

void LivoxCapture::Reader::take(const LivoxPacket& packet, std::int64_t time_ns, Sensor& sensor) {
    if (sensor.is_begun) {
        const auto step = static_cast<std::int16_t>(
            static_cast<std::uint16_t>(packet.number - sensor.last_number));
        if (step == 0 && packet.time_ns == sensor.last_ns) {
            ++sensor.repeated;
            return;
        }
        const bool is_earlier = packet.time_ns < sensor.last_ns;
        const std::uint64_t gap_ns =
            is_earlier ? sensor.last_ns - packet.time_ns : packet.time_ns - sensor.last_ns;
        if (gap_ns > kInterruption_ns) {
            ++sensor.interruptions;
            endScan(sensor);
        } else if (is_earlier) {
            ++sensor.late;  // its points are as good: they join the scan in progress
            if (step < 0 && sensor.lost > 0) --sensor.lost;
        } else {
            // The number starts again with each frame of some firmware.
            if (step > 1) sensor.lost += static_cast<std::size_t>(step - 1);
            if (packet.time_ns - sensor.start_ns >= kScan_ns) endScan(sensor);
        }
        if (sensor.scan_packets == kMostPackets) endScan(sensor);
    }
    ++sensor.packets;
    if (!sensor.is_begun) {
        sensor.is_begun = true;
        sensor.start_ns = packet.time_ns;
        sensor.last_ns = packet.time_ns;
        sensor.capture_time_ns = time_ns;
    }
    if (packet.time_ns >= sensor.last_ns) {
        sensor.last_ns = packet.time_ns;
        sensor.last_number = packet.number;
    }
    ++sensor.scan_packets;
    appendPoints(packet, sensor.start_ns, sensor.scan, sensor.tags);
}

void LivoxCapture::Reader::endScan(Sensor& sensor) {
    if (!sensor.is_begun) return;
    sensor.is_begun = false;
    sensor.scan_packets = 0;
    ++sensor.scans;
    locateBeams(*model, sensor.scan);
    auto observation = CObservationPointCloud::Create();
    observation->sensorLabel = sensor.label;
    observation->timestamp = timeOf(sensor.capture_time_ns);
    observations::PointTable fields;
    fields.points = sensor.scan.size();
    addColumn("tag", observations::NumberType::UInt8, {sensor.tags.begin(), sensor.tags.end()},
              fields);
    observation->pointcloud =
        std::make_shared<observations::LocatedCloud>(sensor.scan, model, std::move(fields));
    complete.push_back(observation);
    sensor.scan.clear();
    sensor.tags.clear();
}

LivoxCapture::LivoxCapture(const std::filesystem::path& file)
    : reader_(std::make_unique<Reader>(file)) {}

LivoxCapture::~LivoxCapture() = default;

CObservationPointCloud::Ptr LivoxCapture::next() {
    Reader& r = *reader_;
    Datagram datagram;
    while (r.complete.empty() && !r.is_at_end) {
        try {
            r.is_at_end = !r.capture.next(datagram);
            if (!r.is_at_end) r.take(datagram);
        } catch (const BrokenCapture& e) {
            r.broken_because = e.what();
            r.is_at_end = true;
        }
        if (!r.is_at_end) continue;
        for (const std::uint32_t ip : r.order) r.endScan(r.sensors.at(ip));
    }
    if (!r.complete.empty()) {
        auto observation = r.complete.front();
        r.complete.pop_front();
        return observation;
    }
    if (!r.broken_because.empty()) throw BrokenCapture(r.broken_because);
    return nullptr;
}

void LivoxCapture::checkWhileReading(const std::function<void()>& check) {
    reader_->capture.checkWhileReading(check);
}

double LivoxCapture::fractionRead() const { return reader_->capture.fractionRead(); }

std::vector<std::string> LivoxCapture::remarks() const {
    const Reader& r = *reader_;
    std::vector<std::string> remarks;
    for (const std::uint32_t ip : r.order) {
        const Sensor& sensor = r.sensors.at(ip);
        std::string text = sensor.label + " (Livox, read as a Mid-360, at " + ipText(ip) +
                           "): " + counted(sensor.packets, "packet") + " in " +
                           counted(sensor.scans, "scan");
        addCount(sensor.lost, "packet", "lost", text);
        addCount(sensor.late, "packet", "out of order, with the scan in which it came", text);
        addCount(sensor.repeated, "packet", "repeated, left out", text);
        addCount(sensor.interruptions, "interruption", "or jump of the sensor's clock", text);
        remarks.push_back(text);
    }
    std::string left_out;
    addCount(r.further_sensors, "packet", "of further sensors", left_out);
    addCount(r.imu_packets, "IMU packet", "(rates and accelerations, no attitude)", left_out);
    r.others.describe(left_out);
    remarks.push_back(textOfFrames(r.capture.counts(), left_out));
    return remarks;
}

}  // namespace hagen::captures
