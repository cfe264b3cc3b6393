#pragma once
#include <hagen/sensors/LivoxSequence.h>
#include <hagen/sensors/SensorTable.h>
#include <hagen/sensors/SweepReader.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace hagen::sensors {

/// The Livox Mid-360 sensors of a recording (Livox SDK 2, Cartesian data), by address. A sweep is
/// the points of a tenth of a second by the sensor's clock, with the time of its first packet. Late
/// packets join the sweep in progress.
class LivoxSweeps : public SweepReader {
 public:
    void add(const Datagram& datagram) override;
    void finish() override;
    std::vector<std::string> remarks() const override;
    std::string ignored() const override;

 private:
    struct Sensor {
        PacketCounts counts;
        LivoxSequence sequence{false};
        bool is_begun = false;
        std::uint64_t start_ns = 0;  ///< of the sweep in progress, by the sensor's clock
        std::size_t packets = 0;     ///< likewise
        LidarSweep sweep;
    };
    void add(const LivoxPacket& packet, const Datagram& datagram, Sensor& sensor);
    void endSweep(Sensor& sensor);

    const std::shared_ptr<const SensorModel> model_ =
        std::make_shared<const SensorModel>(sensorModel("Mid-360"));
    SensorTable<std::uint32_t, Sensor> sensors_{"livox"};
    std::size_t imu_packets_ = 0;
};

}  // namespace hagen::sensors
