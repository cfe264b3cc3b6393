#include <hagen/recordings/OusterCapture.h>
#include <hagen/sensors/OusterFrames.h>

#include <map>
#include <optional>

#include <hagen/recordings/OusterObservation.h>
#include <hagen/recordings/Remarks.h>

namespace hagen::recordings {
namespace {

using mrpt::obs::CObservationPointCloud;

constexpr std::size_t kImuBytes = 48;

}  // namespace

struct OusterCapture::Reader {
    std::filesystem::path file, json;
    sensors::OusterSensor sensor;
    sensors::CaptureFile capture;
    sensors::OusterFrames frames;
    std::optional<std::uint32_t> from_ip;  ///< of the sensor, once known
    std::size_t imu_packets = 0, other_sources = 0;
    std::map<std::uint64_t, std::size_t> other_serials;
    OtherDatagrams others;
    bool is_at_end = false;
    std::string broken_because;

    Reader(const std::filesystem::path& name, const std::filesystem::path& metadata)
        : file(name),
          json(metadata),
          sensor(sensors::readOusterSensor(metadata)),
          capture(name),
          frames(sensor) {}

    void take(const sensors::Datagram& datagram);
    bool isOfSensor(const sensors::Datagram& datagram);
    std::string textOfOthers() const;
    std::string whyEmpty() const;
    std::string whyUncertain() const;
};

/// Counts what is not of the sensor.
bool OusterCapture::Reader::isOfSensor(const sensors::Datagram& datagram) {
    if (!sensors::isOfLidar(datagram.bytes, sensor)) {
        others.add(datagram);
        return false;
    }
    const std::uint64_t serial = sensors::serialOf(datagram.bytes, sensor);
    const bool has_serial = !sensor.profile.is_legacy && !sensor.serial.empty();
    if (has_serial && std::to_string(serial) != sensor.serial) {
        constexpr std::size_t kMostSerials = 16;
        const std::uint64_t key = other_serials.size() < kMostSerials ? serial : 0;
        ++other_serials[key];
        return false;
    }
    if (from_ip.value_or(datagram.from_ip) != datagram.from_ip) {
        ++other_sources;
        return false;
    }
    from_ip = datagram.from_ip;
    return true;
}

void OusterCapture::Reader::take(const sensors::Datagram& datagram) {
    if (datagram.size == sensor.packetBytes()) {
        if (isOfSensor(datagram)) frames.add(datagram.bytes, datagram.time_ns);
    } else if (datagram.size == kImuBytes) {
        ++imu_packets;
    } else {
        others.add(datagram);
    }
}

std::string OusterCapture::Reader::textOfOthers() const {
    std::string text;
    addCount(imu_packets, "IMU packet", "", text);
    for (const auto& [serial, count] : other_serials) {
        addCount(count, "packet",
                 serial == 0 ? "of further sensors"
                             : "of the sensor with serial number " + std::to_string(serial),
                 text);
    }
    addCount(other_sources, "packet", "from another address", text);
    others.describe(text);
    return text;
}

std::string OusterCapture::Reader::whyEmpty() const {
    std::string found = textOfOthers();
    const std::string losses = textOfLosses(capture.counts());
    if (!losses.empty()) found += (found.empty() ? "" : ", ") + losses;
    return file.string() + ": has no packets of the " + sensor.name +
           (sensor.serial.empty() ? "" : " with serial number " + sensor.serial) + " in " +
           json.string() + " (" + std::to_string(sensor.packetBytes()) + " bytes, profile " +
           sensor.profile.name + "); it has " + (found.empty() ? "no frames" : found) +
           ". Is it another sensor's metadata?";
}

std::string OusterCapture::Reader::whyUncertain() const {
    return file.string() + ": its turns do not have the " +
           std::to_string(sensor.columns_per_frame) + " columns of " + json.string() +
           ". Are the metadata of another mode?";
}

OusterCapture::OusterCapture(const std::filesystem::path& file,
                             const std::filesystem::path& sensor_json)
    : reader_(std::make_unique<Reader>(file, sensor_json)) {}

OusterCapture::~OusterCapture() = default;

CObservationPointCloud::Ptr OusterCapture::next() {
    Reader& r = *reader_;
    sensors::Datagram datagram;
    while (r.frames.complete().empty() && !r.is_at_end) {
        try {
            r.is_at_end = !r.capture.next(datagram);
            if (!r.is_at_end) r.take(datagram);
        } catch (const sensors::BrokenCapture& e) {
            r.broken_because = e.what();
            r.is_at_end = true;
        }
        if (r.is_at_end) r.frames.finish();
    }
    if (!r.frames.complete().empty()) {
        auto observation = observationOf(r.frames.complete().front(), r.sensor);
        r.frames.complete().pop_front();
        return observation;
    }
    if (!r.broken_because.empty()) throw sensors::BrokenCapture(r.broken_because);
    if (r.frames.counts().packets == 0) throw sensors::BrokenCapture(r.whyEmpty());
    if (r.frames.counts().frames == 0) throw sensors::BrokenCapture(r.whyUncertain());
    return nullptr;
}

void OusterCapture::checkWhileReading(const std::function<void()>& check) {
    reader_->capture.checkWhileReading(check);
}

double OusterCapture::fractionRead() const { return reader_->capture.fractionRead(); }

std::vector<std::string> OusterCapture::remarks() const {
    const Reader& r = *reader_;
    const std::string text = "ouster (" + r.sensor.name + ", " + r.sensor.profile.name +
                             "): " + textOf(r.frames.counts());
    return {text, textOfFrames(r.capture.counts(), r.textOfOthers())};
}

}  // namespace hagen::recordings
