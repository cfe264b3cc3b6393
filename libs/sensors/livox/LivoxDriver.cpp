#include <hagen/sensors/LidarDriver.h>

#include "sensors/PacketSequence.h"
#include "sensors/livox/LivoxPacket.h"

namespace hagen::sensors {
namespace {

constexpr double kFrame_s = 0.02;
constexpr double kMaxFrame = 2;                 // max. duration by arrival, in nominal durations
constexpr double kPointInterval_s = 5e-6;       // default, for packets without interval
constexpr std::size_t kMaxFramePackets = 1000;  // normally 42
constexpr std::size_t kFramesOfScan = 5;

/// Reads the packets of one Livox Mid-360 (Livox SDK 2, Cartesian data) in frames of 20 ms.
class LivoxDriver : public LidarDriver {
 public:
    SensorModel sensor() const override { return sensorModel("Mid-360"); }
    bool turns() const override { return false; }
    bool isData(const Datagram& datagram) const override {
        return livoxPacketOf(datagram).has_value();
    }
    Taken add(const Datagram& datagram, double arrival_s, ReturnSink& sink) override {
        // After a pause, stale returns must not appear in a new frame.
        if (is_begun_ && arrival_s - frame_.first_arrival_s > kMaxFrame * kFrame_s) flush(sink);
        if (isLivoxImu(datagram)) {
            ++counts_.auxiliary;
            return Taken::Auxiliary;
        }
        const auto packet = livoxPacketOf(datagram);
        if (!packet) {
            ++counts_.wrong_size;
            return Taken::WrongSize;
        }
        const PacketSequence::Step step =
            sequence_.add(packet->number, packet->time_ns, arrival_s, counts_);
        if (step == PacketSequence::Step::Duplicate) return Taken::Duplicate;
        if (step == PacketSequence::Step::TooLate) return Taken::TooLate;
        if (step == PacketSequence::Step::Interruption) {
            flush(sink);
            sink.restart();
        }
        if (!is_begun_) {
            is_begun_ = true;
            start_ns_ = packet->time_ns;
            frame_.first_arrival_s = arrival_s;
        }
        ++packets_of_frame_;
        frame_.last_arrival_s = arrival_s;
        appendPoints(*packet, start_ns_, returns_, tags_);
        const double interval_s =
            packet->point_interval_s > 0 ? packet->point_interval_s : kPointInterval_s;
        const double packet_s = interval_s * static_cast<double>(packet->count);
        frame_.measured_s += packet_s;
        const std::uint64_t last_ns = sequence_.last_ns();
        const bool is_whole =
            last_ns >= start_ns_ &&
            1e-9 * static_cast<double>(last_ns - start_ns_) + 1.5 * packet_s > kFrame_s;
        if (is_whole || packets_of_frame_ >= kMaxFramePackets) flush(sink);
        return Taken::Yes;
    }

    void flush(ReturnSink& sink) override {
        if (!is_begun_) return;
        is_begun_ = false;
        packets_of_frame_ = 0;
        locateBeams(model_, returns_);
        frame_.sensor_time_s = 1e-9 * static_cast<double>(start_ns_);
        sink.addFrame(returns_, frame_);
        counts_.scans = ++frames_ / kFramesOfScan;
        frame_.measured_s = 0;
        returns_.clear();
        tags_.clear();
    }

 private:
    const SensorModel model_ = sensor();
    PacketSequence sequence_{true};
    bool is_begun_ = false;
    std::uint64_t start_ns_ = 0;  ///< sensor time at which the frame starts
    std::size_t packets_of_frame_ = 0, frames_ = 0;
    ReturnSink::Frame frame_{};
    Scan returns_;
    std::vector<std::uint8_t> tags_;
};

}  // namespace

std::unique_ptr<LidarDriver> makeLivoxDriver() { return std::make_unique<LivoxDriver>(); }

}  // namespace hagen::sensors
