#include "sensors/SweepReader.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sensors/PacketSequence.h"
#include "sensors/SensorTable.h"
#include "sensors/livox/LivoxPacket.h"

namespace hagen::sensors {
namespace {

constexpr std::uint64_t kSweep_ns = 100000000;
constexpr std::size_t kMaxPackets = 10000;  // max. size of a sweep; normally 210

/// Sweep reader of makeLivoxSweeps(). A sweep has the time of its first packet.
class LivoxSweeps : public SweepReader {
 public:
    void add(const Datagram& datagram) override {
        const auto packet = livoxPacketOf(datagram);
        if (isLivoxImu(datagram)) {
            ++imu_packets_;
        } else if (!packet) {
            others_.add(datagram);
        } else if (Sensor* const sensor =
                       sensors_.find(datagram.from_ip, [](const std::string& label) {
                           Sensor made;
                           made.sweep.label = label;
                           return made;
                       })) {
            add(*packet, datagram, *sensor);
        }
    }

    void finish() override {
        for (auto& entry : sensors_.entries()) endSweep(entry.sensor);
    }

    std::vector<std::string> remarks() const override {
        std::vector<std::string> remarks;
        for (const auto& [ip, label, sensor] : sensors_.entries()) {
            remarks.push_back(label + " (Livox, read as a Mid-360, at " + ipText(ip) +
                              "): " + describe(sensor.counts, "scan"));
        }
        return remarks;
    }

    std::string ignored() const override {
        std::string text;
        addCount(sensors_.further(), "packet", "from further sensors", text);
        addCount(imu_packets_, "IMU packet", "(rates and accelerations, no attitude)", text);
        others_.describe(text);
        return text;
    }

 private:
    struct Sensor {
        PacketCounts counts;
        PacketSequence sequence{false};
        bool is_begun = false;
        std::uint64_t start_ns = 0;  ///< sensor time at which the sweep in progress starts
        std::size_t packets = 0;
        LidarSweep sweep;
    };
    void add(const LivoxPacket& packet, const Datagram& datagram, Sensor& sensor) {
        using Step = PacketSequence::Step;
        const double time_s = 1e-9 * static_cast<double>(datagram.time_ns);
        const Step step = sensor.sequence.add(packet.number, packet.time_ns, time_s, sensor.counts);
        if (step == Step::Duplicate) return;
        const bool is_complete =
            step == Step::Next && packet.time_ns - sensor.start_ns >= kSweep_ns;
        if (step == Step::Interruption || is_complete || sensor.packets == kMaxPackets) {
            endSweep(sensor);
        }
        if (!sensor.is_begun) {
            sensor.is_begun = true;
            sensor.start_ns = packet.time_ns;
            sensor.sweep.time_ns = datagram.time_ns;
        }
        ++sensor.packets;
        appendPoints(packet, sensor.start_ns, sensor.sweep.returns, sensor.sweep.tags);
    }

    void endSweep(Sensor& sensor) {
        if (!sensor.is_begun) return;
        sensor.is_begun = false;
        sensor.packets = 0;
        ++sensor.counts.scans;
        locateBeams(*model_, sensor.sweep.returns);
        sensor.sweep.sensor = model_;
        sensor.sweep.has_tags = true;
        LidarSweep next;
        next.label = sensor.sweep.label;
        complete_.push_back(std::exchange(sensor.sweep, std::move(next)));
    }

    const std::shared_ptr<const SensorModel> model_ =
        std::make_shared<const SensorModel>(sensorModel("Mid-360"));
    SensorTable<IpAddress, Sensor> sensors_{"livox"};
    std::size_t imu_packets_ = 0;
};

}  // namespace

std::unique_ptr<SweepReader> makeLivoxSweeps() { return std::make_unique<LivoxSweeps>(); }

}  // namespace hagen::sensors
