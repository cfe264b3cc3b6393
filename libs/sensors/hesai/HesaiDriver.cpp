#include <hagen/scan/Angle.h>
#include <hagen/sensors/LidarDriver.h>

#include <cmath>

#include "sensors/PacketSequence.h"
#include "sensors/hesai/HesaiPacket.h"

namespace hagen::sensors {
namespace {

/// Driver of makeHesaiDriver().
class HesaiDriver : public LidarDriver {
    static constexpr double kGap_s = 0.05, kForgotten_s = 0.25;  // then, returns are not context
    static constexpr double kOverlap_rad = 0.2;                  // tolerated overlap of packets

 public:
    explicit HesaiDriver(const std::string& model) : sensor_(sensorModel(model)) {}

    SensorModel sensor() const override { return sensor_; }
    bool isDual() const override { return is_dual_; }
    bool isData(const Datagram& datagram) const override {
        const auto packet = hesaiPacketOf(datagram);
        return packet && packet->model == sensor_.name;
    }

    Taken add(const Datagram& datagram, double arrival_s, ReturnSink& sink) override {
        const auto packet = hesaiPacketOf(datagram);
        if (!packet) {
            ++counts_.wrong_size;
            return Taken::WrongSize;
        }
        if (packet->model != sensor_.name) {
            ++counts_.other_sensor;
            return Taken::OtherSensor;
        }
        const double step = packet->step();
        if (step < 0) {
            ++counts_.unsound;
            return Taken::Unsound;
        }
        using Step = PacketSequence::Step;
        const std::uint64_t last_ns = sequence_.last_ns();
        const Step taken = sequence_.add(packet->number, packet->time_ns, arrival_s, counts_);
        if (taken == Step::Duplicate) return Taken::Duplicate;
        if (taken == Step::TooLate) return Taken::TooLate;
        const double elapsed_s =
            1e-9 * static_cast<double>(static_cast<std::int64_t>(packet->time_ns - last_ns));
        const bool is_gap = taken == Step::Interruption || elapsed_s > kGap_s;
        if (has_last_ && is_gap) sink.flush();
        if (has_last_ && (taken == Step::Interruption || elapsed_s > kForgotten_s)) {
            sink.restart();
            has_last_ = false;
        }
        const Sweep sweep = sweepOf(*packet, step, elapsed_s);
        const bool is_dual = packet->returns == 2;
        if (taken != Step::Late) {
            if (has_last_) {
                counts_.mode_changes += is_dual != is_dual_;
                counts_.scans +=
                    std::floor(sweep.from_rad / kTurn_rad) > std::floor(last_.from_rad / kTurn_rad);
            }
            is_dual_ = is_dual;
            last_ = sweep;
            has_last_ = true;
        }
        returns_.clear();
        appendReturns(*packet, sensor_, packet->time_ns, returns_);
        sink.add(returns_, sweep, arrival_s);
        return Taken::Yes;
    }

 private:
    /// Continues the angles of the last packet, without whole missing turns.
    Sweep sweepOf(const HesaiPacket& packet, double step, double elapsed_s) const {
        const double swept_rad = radians(0.01 * step * packet.firings());
        double from_rad = radians(0.01 * packet.azimuthOf(0));
        if (has_last_) {
            double turned_rad =
                std::remainder(elapsed_s / packet.period_s() * swept_rad, kTurn_rad);
            if (elapsed_s > 0 && turned_rad < -kOverlap_rad) turned_rad += kTurn_rad;
            const double expected_rad = last_.from_rad + turned_rad;
            from_rad = expected_rad + std::remainder(from_rad - expected_rad, kTurn_rad);
        }
        return {from_rad, from_rad + swept_rad};
    }

    const SensorModel sensor_;
    PacketSequence sequence_{true};
    bool has_last_ = false, is_dual_ = false;
    Sweep last_{};
    Scan returns_;
};

}  // namespace

std::unique_ptr<LidarDriver> makeHesaiDriver(const std::string& model) {
    return std::make_unique<HesaiDriver>(model);
}

}  // namespace hagen::sensors
