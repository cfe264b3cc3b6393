#include "sensors/SweepReader.h"

#include <utility>

#include "sensors/PacketSequence.h"
#include "sensors/SensorTable.h"
#include "sensors/hesai/HesaiPacket.h"

namespace hagen::sensors {
namespace {

/// Sweep reader of makeHesaiSweeps().
class HesaiSweeps : public SweepReader {
    static constexpr std::uint64_t kMaxTurn_ns = 250000000;  // the slowest sensors turn at 5 Hz
    static constexpr int kMinWrap = 100;  // 0.01 degrees; smaller steps are jitter

 public:
    void add(const Datagram& datagram) override {
        const auto packet = hesaiPacketOf(datagram);
        if (!packet) return others_.add(datagram);
        Sensor* const sensor = sensors_.find(
            std::pair(datagram.from_ip, std::string(packet->model)), [&](const std::string& label) {
                Sensor made;
                made.model = std::make_shared<const SensorModel>(sensorModel(packet->model));
                made.sweep.label = label;
                return made;
            });
        if (sensor != nullptr) add(*packet, datagram.time_ns, *sensor);
    }

    void finish() override {
        for (auto& entry : sensors_.entries()) endSweep(entry.sensor);
    }

    std::vector<std::string> remarks() const override {
        std::vector<std::string> remarks;
        for (const auto& [key, label, sensor] : sensors_.entries()) {
            const std::string at = key.first == 0 ? "" : " at " + ipText(key.first);
            std::string text =
                label + " (" + key.second + at + "): " + describe(sensor.counts, "turn");
            addCount(sensor.dual, "packet", "with dual returns", text);
            remarks.push_back(text);
        }
        return remarks;
    }

    std::string ignored() const override {
        std::string text;
        addCount(sensors_.further(), "packet", "from further sensors", text);
        others_.describe(text);
        return text;
    }

 private:
    struct Sensor {
        std::shared_ptr<const SensorModel> model;
        PacketCounts counts;
        PacketSequence sequence{false};
        std::size_t dual = 0;  ///< packets
        bool is_begun = false;
        std::uint64_t start_ns = 0;  ///< sensor time at which the sweep in progress starts
        int last_azimuth = -1;
        LidarSweep sweep;
    };

    void add(const HesaiPacket& packet, std::int64_t time_ns, Sensor& sensor) {
        using Step = PacketSequence::Step;
        const Step step = sensor.sequence.add(packet.number, packet.time_ns,
                                              1e-9 * static_cast<double>(time_ns), sensor.counts);
        if (step == Step::Duplicate) return;
        sensor.dual += packet.returns == 2;
        const int azimuth = packet.azimuthOf(0);
        const bool is_complete =
            step == Step::Next && (azimuth < sensor.last_azimuth - kMinWrap ||
                                   packet.time_ns - sensor.start_ns > kMaxTurn_ns);
        if (step == Step::Interruption || is_complete) endSweep(sensor);
        if (!sensor.is_begun) {
            sensor.is_begun = true;
            sensor.start_ns = packet.time_ns;
            sensor.sweep.time_ns = time_ns;
        }
        if (step != Step::Late) sensor.last_azimuth = azimuth;
        appendReturns(packet, *sensor.model, sensor.start_ns, sensor.sweep.returns);
    }

    void endSweep(Sensor& sensor) {
        if (!std::exchange(sensor.is_begun, false)) return;
        ++sensor.counts.scans;
        sensor.sweep.sensor = sensor.model;
        LidarSweep next;
        next.label = sensor.sweep.label;
        complete_.push_back(std::exchange(sensor.sweep, std::move(next)));
    }

    SensorTable<std::pair<IpAddress, std::string>, Sensor> sensors_{"hesai"};
};

}  // namespace

std::unique_ptr<SweepReader> makeHesaiSweeps() { return std::make_unique<HesaiSweeps>(); }

}  // namespace hagen::sensors
