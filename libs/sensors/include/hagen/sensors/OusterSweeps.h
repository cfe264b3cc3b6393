#pragma once
#include <hagen/sensors/OusterFrames.h>
#include <hagen/sensors/SweepReader.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hagen::sensors {

/// A frame as a sweep with the label "ouster".
LidarSweep sweepOf(const OusterFrame& frame, const OusterSensor& sensor);

/// The frames of one Ouster in a recording, by its metadata.
class OusterSweeps : public SweepReader {
 public:
    /// Throws std::runtime_error naming metadata that cannot be used.
    explicit OusterSweeps(const std::filesystem::path& sensor_json);

    void add(const Datagram& datagram) override;
    void finish() override;
    std::vector<std::string> remarks() const override;
    std::string ignored() const override;
    std::string whyEmpty(const std::string& losses) const override;

 private:
    void collect();

    std::filesystem::path json_;
    OusterSensor sensor_;
    OusterFrames frames_{sensor_};
    std::optional<std::uint32_t> from_ip_;  ///< of the sensor, once known
    std::size_t imu_packets_ = 0, other_sources_ = 0;
    std::map<std::uint64_t, std::size_t> other_serials_;
};

/// "64 packets in 2 turns, 16 columns missing".
std::string textOf(const OusterFrames::Counts& counts);

}  // namespace hagen::sensors
