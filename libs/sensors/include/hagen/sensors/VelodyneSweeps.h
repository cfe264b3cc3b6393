#pragma once
#include <hagen/sensors/SensorTable.h>
#include <hagen/sensors/SweepReader.h>
#include <hagen/sensors/VelodyneTurns.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace hagen::sensors {

/// The Velodyne sensors of a recording, by address, port and model: VLP-16, Puck Hi-Res, HDL-32E
/// and VLP-32C by the id in their packets, HDL-64E by their blocks.
class VelodyneSweeps : public SweepReader {
 public:
    /// `calibration`: of the HDL-64E (readVelodyneCalibration()); empty: its packets are ignored.
    /// Throws std::runtime_error naming a wrong calibration.
    explicit VelodyneSweeps(const std::filesystem::path& calibration = {});

    void add(const Datagram& datagram) override;
    void finish() override;
    std::vector<std::string> remarks() const override;
    std::string ignored() const override;
    std::string whyEmpty(const std::string& losses) const override;

 private:
    using Key = std::tuple<std::uint32_t, std::uint16_t, std::uint8_t>;

    void add(const Datagram& datagram, const VelodyneModel& model);
    void collect(VelodyneTurns& turns);
    std::string unknown() const;

    std::filesystem::path calibration_file_;
    std::optional<VelodyneCalibration> calibration_;
    SensorTable<Key, VelodyneTurns> sensors_{"velodyne"};
    std::size_t packets_ = 0, position_packets_ = 0, hdl64_packets_ = 0;
    std::map<unsigned, std::size_t> unknown_ids_;
};

}  // namespace hagen::sensors
