#include <hagen/recordings/VelodyneCapture.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <map>
#include <optional>
#include <tuple>

#include <hagen/recordings/Remarks.h>
#include <hagen/recordings/VelodyneTurns.h>
#include <hagen/sensors/VelodyneCalibrationFile.h>

namespace hagen::recordings {
namespace {

using mrpt::obs::CObservationVelodyneScan;
using sensors::VelodyneModel;

constexpr std::size_t kPositionBytes = 512;
constexpr std::uint16_t kPositionPort = 8308;
constexpr std::size_t kMostSensors = 16;  // more are other traffic that looks like packets

/// A sensor by its address, the port that it sends to, and its model.
using SensorKey = std::tuple<std::uint32_t, std::uint16_t, std::uint8_t>;

}  // namespace

struct VelodyneCapture::Reader {
    struct Sensor {
        std::string label, name;
        VelodyneTurns turns;
    };

    std::filesystem::path file, calibration_file;
    std::optional<sensors::VelodyneCalibration> calibration;  ///< of an HDL-64E
    sensors::CaptureFile capture;
    std::map<SensorKey, Sensor> sensors;
    std::vector<SensorKey> order;  ///< of appearance
    std::deque<VelodyneTurns::Turn> complete;
    std::size_t packets = 0, position_packets = 0, further_sensors = 0, hdl64_packets = 0;
    std::map<unsigned, std::size_t> unknown_ids;
    OtherDatagrams others;
    bool is_at_end = false;
    std::string broken_because;

    Reader(const std::filesystem::path& name, const std::filesystem::path& name_of_calibration)
        : file(name), calibration_file(name_of_calibration), capture(name) {
        if (calibration_file.empty()) return;
        calibration = sensors::readVelodyneCalibration(calibration_file);
    }

    void take(const sensors::Datagram& datagram);
    void takePacket(const sensors::Datagram& datagram, const sensors::VelodyneModel& model);
    void finish();
    std::string whyEmpty() const;
    std::string textOfOthers() const;
};

void VelodyneCapture::Reader::take(const sensors::Datagram& datagram) {
    if (datagram.size == kPositionBytes && datagram.to_port == kPositionPort) {
        ++position_packets;
    } else if (!sensors::isVelodyneData(datagram.bytes, datagram.size)) {
        others.add(datagram);
    } else if (sensors::isOfHdl64(datagram.bytes)) {
        ++hdl64_packets;
        if (calibration) takePacket(datagram, sensors::hdl64Model());
    } else if (const auto* model =
                   sensors::findVelodyneModel(datagram.bytes[sensors::kVelodyneModelAt])) {
        takePacket(datagram, *model);
    } else {
        ++unknown_ids[datagram.bytes[sensors::kVelodyneModelAt]];
    }
}

void VelodyneCapture::Reader::takePacket(const sensors::Datagram& datagram,
                                         const sensors::VelodyneModel& model) {
    const SensorKey key{datagram.from_ip, datagram.to_port, model.id};
    auto sensor = sensors.find(key);
    if (sensor == sensors.end()) {
        if (sensors.size() == kMostSensors) {
            ++further_sensors;
            return;
        }
        order.push_back(key);
        const std::string label =
            order.size() == 1 ? "velodyne" : "velodyne_" + std::to_string(order.size());
        const std::string name = model.name + " at " + sensors::ipText(datagram.from_ip) +
                                 ", port " + std::to_string(datagram.to_port);
        const bool is_hdl64 = &model == &sensors::hdl64Model();
        VelodyneTurns turns(model, label, is_hdl64 ? &*calibration : nullptr);
        sensor = sensors.emplace(key, Sensor{label, name, std::move(turns)}).first;
    }
    sensors::VelodynePacket packet;
    std::copy_n(datagram.bytes, packet.bytes.size(), packet.bytes.begin());
    packet.time_ns = datagram.time_ns;
    ++packets;
    VelodyneTurns& turns = sensor->second.turns;
    turns.add(packet);
    std::move(turns.complete().begin(), turns.complete().end(), std::back_inserter(complete));
    turns.complete().clear();
}

void VelodyneCapture::Reader::finish() {
    is_at_end = true;
    for (const SensorKey& key : order) {
        VelodyneTurns& turns = sensors.at(key).turns;
        turns.finish();
        std::move(turns.complete().begin(), turns.complete().end(), std::back_inserter(complete));
        turns.complete().clear();
    }
}

/// The datagrams that are not of a known Velodyne.
std::string VelodyneCapture::Reader::textOfOthers() const {
    std::string text;
    if (!calibration) {
        addCount(hdl64_packets, "packet",
                 "of an HDL-64E, which need its calibration: --calibration FILE", text);
    }
    for (const auto& [id, count] : unknown_ids) {
        char hex[8];
        std::snprintf(hex, sizeof hex, "0x%02x", id);
        addCount(count, "packet", "of an unknown Velodyne (model id " + std::string(hex) + ")",
                 text);
    }
    addCount(further_sensors, "packet", "of further sensors", text);
    others.describe(text);
    return text;
}

std::string VelodyneCapture::Reader::whyEmpty() const {
    std::string found = textOfOthers();
    const std::string losses = textOfLosses(capture.counts());
    if (!losses.empty()) found += (found.empty() ? "" : ", ") + losses;
    addCount(position_packets, "position packet", "", found);
    return file.string() + ": has no data packets of a known Velodyne (" +
           sensors::knownVelodynes().substr(1) + "); it has " +
           (found.empty() ? "no frames" : found) +
           ". Packets of an Ouster need its metadata: --sensor-json FILE";
}

VelodyneCapture::VelodyneCapture(const std::filesystem::path& file,
                                 const std::filesystem::path& calibration)
    : reader_(std::make_unique<Reader>(file, calibration)) {}

VelodyneCapture::~VelodyneCapture() = default;

CObservationVelodyneScan::Ptr VelodyneCapture::next() {
    Reader& r = *reader_;
    sensors::Datagram datagram;
    while (r.complete.empty() && !r.is_at_end) {
        try {
            if (r.capture.next(datagram)) {
                r.take(datagram);
            } else {
                r.finish();
            }
        } catch (const sensors::BrokenCapture& e) {
            r.broken_because = e.what();
            r.finish();
        }
    }
    if (!r.complete.empty()) {
        const auto turn = r.complete.front();
        r.complete.pop_front();
        return turn;
    }
    if (!r.broken_because.empty()) throw sensors::BrokenCapture(r.broken_because);
    if (r.packets == 0) throw sensors::BrokenCapture(r.whyEmpty());
    return nullptr;
}

void VelodyneCapture::checkWhileReading(const std::function<void()>& check) {
    reader_->capture.checkWhileReading(check);
}

double VelodyneCapture::fractionRead() const { return reader_->capture.fractionRead(); }

std::vector<std::string> VelodyneCapture::remarks() const {
    const Reader& r = *reader_;
    std::vector<std::string> remarks;
    for (const SensorKey& key : r.order) {
        const Reader::Sensor& sensor = r.sensors.at(key);
        remarks.push_back(sensor.label + " (" + sensor.name +
                          "): " + textOf(sensor.turns.counts()));
    }
    std::string left_out;
    addCount(r.position_packets, "position packet", "(GPS)", left_out);
    const std::string others = r.textOfOthers();
    if (!others.empty()) left_out += (left_out.empty() ? "" : ", ") + others;
    if (r.calibration && r.hdl64_packets == 0) {
        remarks.push_back(r.calibration_file.string() +
                          " is not used: there are no packets of an HDL-64E");
    }
    remarks.push_back(textOfFrames(r.capture.counts(), left_out));
    return remarks;
}

}  // namespace hagen::recordings
