#pragma once
#include <hagen/sensors/LidarDriver.h>
#include <hagen/sensors/LivoxSequence.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen::sensors {

constexpr double kLivoxFrame_s = 0.02;

/// Reads the packets of one Livox Mid-360 (Livox SDK 2, Cartesian data) in frames of 20 ms.
class LivoxDriver : public LidarDriver {
 public:
    SensorModel sensor() const override;
    bool turns() const override { return false; }
    bool isData(const Datagram& datagram) const override;
    Taken add(const Datagram& datagram, double arrival_s, ReturnSink& sink) override;
    void flush(ReturnSink& sink) override;

 private:
    const SensorModel model_ = sensor();
    LivoxSequence sequence_{true};
    bool is_begun_ = false;
    std::uint64_t start_ns_ = 0;  ///< of the frame, by the sensor's clock
    std::size_t packets_of_frame_ = 0, frames_ = 0;
    ReturnSink::Frame frame_{};
    Scan returns_;  ///< of the frame
    std::vector<std::uint8_t> tags_;
};

}  // namespace hagen::sensors
