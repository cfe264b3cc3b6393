
#include "sensors/PacketSequence.h"
#include "sensors/SensorTable.h"
#include "sensors/SweepReader.h"
#include "sensors/hesai/HesaiPacket.h"
#include "sensors/livox/LivoxPacket.h"

namespace hagen::sensors {
namespace {

constexpr std::uint64_t kLivoxSweep_ns = 100000000;
constexpr std::uint64_t kMaxTurn_ns = 250000000;  // the slowest sensors turn at 5 Hz
constexpr std::size_t kMaxPackets = 10000;        // max. size of a sweep; normally 210
constexpr int kMinHesaiWrap = 100;                // 0.01 degrees; smaller steps are jitter
constexpr const char* kLivox = "Livox, read as a Mid-360,";

/// Sweep reader of the sensors with numbered packets, Livox and Hesai. A sweep has the time of its
/// first packet.
class NumberedSweeps : public SweepReader {
 public:
    explicit NumberedSweeps(const char* label) : sensors_(label) {}

    void add(const Datagram& datagram) override {
        const auto livox = livoxPacketOf(datagram);
        const auto hesai = hesaiPacketOf(datagram);
        if (isLivoxImu(datagram)) {
            ++imu_packets_;
            return;
        }
        if (!livox && !hesai) return others_.add(datagram);
        const auto make = [&](const std::string& label) {
            Sensor made;
            made.model =
                std::make_shared<const SensorModel>(sensorModel(hesai ? hesai->model : "Mid-360"));
            made.sweep.label = label;
            return made;
        };
        const Key key{datagram.from_ip, hesai ? hesai->model : kLivox};
        Sensor* const sensor = sensors_.find(key, make);
        if (sensor == nullptr) return;
        if (hesai) {
            add(*hesai, datagram.time_ns, *sensor);
        } else {
            add(*livox, datagram.time_ns, *sensor);
        }
    }

    void finish() override {
        for (auto& entry : sensors_.entries()) endSweep(entry.sensor);
    }

    std::vector<std::string> remarks() const override {
        std::vector<std::string> remarks;
        for (const auto& [key, label, sensor] : sensors_.entries()) {
            const std::string at = key.first == 0 ? "" : " at " + ipText(key.first);
            std::string text = label + " (" + key.second + at + "): " +
                               describe(sensor.counts, key.second == kLivox ? "scan" : "turn");
            addCount(sensor.dual, "packet", "with dual returns", text);
            remarks.push_back(text);
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
    using Key = std::pair<IpAddress, std::string>;
    using Step = PacketSequence::Step;

    struct Sensor {
        std::shared_ptr<const SensorModel> model;
        PacketCounts counts;
        PacketSequence sequence{false};
        std::size_t dual = 0;  ///< packets
        bool is_begun = false;
        std::uint64_t start_ns = 0;  ///< sensor time at which the sweep in progress starts
        std::size_t packets = 0;     ///< of the sweep in progress
        int last_azimuth = -1;
        LidarSweep sweep;
    };

    void add(const LivoxPacket& packet, std::int64_t time_ns, Sensor& sensor) {
        const bool is_whole = packet.time_ns - sensor.start_ns >= kLivoxSweep_ns;
        if (stepTo(packet, is_whole, time_ns, sensor) == Step::Duplicate) return;
        sensor.sweep.has_tags = true;
        appendPoints(packet, sensor.start_ns, sensor.sweep.returns, sensor.sweep.tags);
    }

    void add(const HesaiPacket& packet, std::int64_t time_ns, Sensor& sensor) {
        const int azimuth = packet.azimuthOf(0);
        const bool is_whole = azimuth < sensor.last_azimuth - kMinHesaiWrap ||
                              packet.time_ns - sensor.start_ns > kMaxTurn_ns;
        const Step step = stepTo(packet, is_whole, time_ns, sensor);
        if (step == Step::Duplicate) return;
        sensor.dual += packet.returns == 2;
        if (step != Step::Late) sensor.last_azimuth = azimuth;
        appendReturns(packet, *sensor.model, sensor.start_ns, sensor.sweep.returns);
    }

    /// Counts a packet, and begins a sweep with it if the sweep in progress is whole.
    template <class Packet>
    Step stepTo(const Packet& packet, bool is_whole, std::int64_t time_ns, Sensor& sensor) {
        const Step step = sensor.sequence.add(packet.number, packet.time_ns,
                                              1e-9 * static_cast<double>(time_ns), sensor.counts);
        if (step == Step::Duplicate) return step;
        if (step == Step::Interruption || (step == Step::Next && is_whole) ||
            sensor.packets == kMaxPackets) {
            endSweep(sensor);
        }
        if (!std::exchange(sensor.is_begun, true)) {
            sensor.start_ns = packet.time_ns;
            sensor.sweep.time_ns = time_ns;
        }
        ++sensor.packets;
        return step;
    }

    void endSweep(Sensor& sensor) {
        if (!std::exchange(sensor.is_begun, false)) return;
        sensor.packets = 0;
        ++sensor.counts.scans;
        if (sensor.sweep.has_tags) locateBeams(*sensor.model, sensor.sweep.returns);
        sensor.sweep.sensor = sensor.model;
        LidarSweep next;
        next.label = sensor.sweep.label;
        complete_.push_back(std::exchange(sensor.sweep, std::move(next)));
    }

    SensorTable<Key, Sensor> sensors_;
    std::size_t imu_packets_ = 0;
};

}  // namespace

std::unique_ptr<SweepReader> makeLivoxSweeps() { return std::make_unique<NumberedSweeps>("livox"); }
std::unique_ptr<SweepReader> makeHesaiSweeps() { return std::make_unique<NumberedSweeps>("hesai"); }

}  // namespace hagen::sensors
