#include <hagen/recordings/LivoxCapture.h>
#include <hagen/recordings/LivoxScans.h>
#include <hagen/recordings/Remarks.h>
#include <hagen/sensors/LivoxPacket.h>

#include <deque>
#include <map>

namespace hagen::recordings {
namespace {

using mrpt::obs::CObservationPointCloud;

constexpr std::size_t kMostSensors = 16;

}  // namespace

struct LivoxCapture::Reader {
    sensors::CaptureFile capture;
    std::map<std::uint32_t, LivoxScans> sensors;  ///< by address
    std::vector<std::uint32_t> order;             ///< of appearance
    std::deque<CObservationPointCloud::Ptr> complete;
    std::size_t further_sensors = 0, imu_packets = 0;
    OtherDatagrams others;
    bool is_at_end = false;
    std::string broken_because;

    explicit Reader(const std::filesystem::path& name) : capture(name) {}

    LivoxScans* sensorAt(std::uint32_t ip);
    void take(const sensors::Datagram& datagram);
    void collect(LivoxScans& sensor);
};

/// The sensor with this address; null if there are too many.
LivoxScans* LivoxCapture::Reader::sensorAt(std::uint32_t ip) {
    const auto found = sensors.find(ip);
    if (found != sensors.end()) return &found->second;
    if (sensors.size() == kMostSensors) return nullptr;
    order.push_back(ip);
    const std::string label = order.size() == 1 ? "livox" : "livox_" + std::to_string(order.size());
    return &sensors.emplace(ip, label).first->second;
}

void LivoxCapture::Reader::take(const sensors::Datagram& datagram) {
    const auto packet = sensors::livoxPacketOf(datagram);
    if (sensors::isLivoxImu(datagram)) {
        ++imu_packets;
    } else if (!packet) {
        others.add(datagram);
    } else if (LivoxScans* const sensor = sensorAt(datagram.from_ip)) {
        sensor->add(*packet, datagram.time_ns);
        collect(*sensor);
    } else {
        ++further_sensors;
    }
}

/// The scans of all sensors, in the order in which they end.
void LivoxCapture::Reader::collect(LivoxScans& sensor) {
    complete.insert(complete.end(), sensor.complete().begin(), sensor.complete().end());
    sensor.complete().clear();
}

LivoxCapture::LivoxCapture(const std::filesystem::path& file)
    : reader_(std::make_unique<Reader>(file)) {}

LivoxCapture::~LivoxCapture() = default;

CObservationPointCloud::Ptr LivoxCapture::next() {
    Reader& r = *reader_;
    sensors::Datagram datagram;
    while (r.complete.empty() && !r.is_at_end) {
        try {
            r.is_at_end = !r.capture.next(datagram);
            if (!r.is_at_end) r.take(datagram);
        } catch (const sensors::BrokenCapture& e) {
            r.broken_because = e.what();
            r.is_at_end = true;
        }
        if (!r.is_at_end) continue;
        for (const std::uint32_t ip : r.order) {
            r.sensors.at(ip).finish();
            r.collect(r.sensors.at(ip));
        }
    }
    if (!r.complete.empty()) {
        auto observation = r.complete.front();
        r.complete.pop_front();
        return observation;
    }
    if (!r.broken_because.empty()) throw sensors::BrokenCapture(r.broken_because);
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
        const LivoxScans& scans = r.sensors.at(ip);
        const LivoxScans::Counts& sensor = scans.counts();
        std::string text = scans.label() + " (Livox, read as a Mid-360, at " + sensors::ipText(ip) +
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

}  // namespace hagen::recordings
