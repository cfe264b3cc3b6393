#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/sensors/Datagram.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <Eigen/Core>
#include "sensors/captures/Remarks.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hagen::sensors {

/// A sweep of a recorded sensor: one turn; of a sensor that does not turn, a tenth of a second.
struct LidarSweep {
    std::string label;         ///< of its sensor: "velodyne", "velodyne_2"
    std::int64_t time_ns = 0;  ///< of the recording, at its first packet
    std::shared_ptr<const SensorModel> sensor;
    Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< of the beams, on the sensor's base
    Scan returns;                                        ///< empty: `packets` hold them
    bool has_tags = false;
    std::vector<std::uint8_t> tags;  ///< of the returns of a Livox
    /// Of a Velodyne, each of kVelodynePacketBytes, and what decodes them.
    std::vector<std::uint8_t> packets;
    VelodyneCalibration calibration;
};

/// Groups the datagrams of a recording into sweeps, for all sensors of one vendor.
class SweepReader {
 public:
    virtual ~SweepReader() = default;

    virtual void add(const Datagram& datagram) = 0;
    /// Completes the sweeps in progress.
    virtual void finish() = 0;
    /// The complete sweeps, oldest first. The caller takes them out.
    std::deque<LidarSweep>& complete() { return complete_; }

    /// Counts per sensor. Complete at the end, as the following.
    virtual std::vector<std::string> remarks() const = 0;
    /// ", "-separated counts of the ignored datagrams; "" if there are none.
    virtual std::string ignored() const = 0;
    /// Why there is no sweep; "" if that is not an error. `losses`: of the capture.
    virtual std::string whyEmpty(const std::string& /*losses*/) const { return ""; }

 protected:
    std::deque<LidarSweep> complete_;
    OtherDatagrams others_;
};

/// Velodyne sensors, by address, port and model: VLP-16, Puck Hi-Res, HDL-32E and VLP-32C by the id
/// in their packets, HDL-64E by their blocks. `calibration`: of the HDL-64E
/// (readVelodyneCalibration()); empty: its packets are ignored. Throws std::runtime_error naming a
/// wrong calibration.
std::unique_ptr<SweepReader> makeVelodyneSweeps(const std::filesystem::path& calibration = {});

/// One Ouster, by its metadata. Throws std::runtime_error naming metadata that cannot be used.
std::unique_ptr<SweepReader> makeOusterSweeps(const std::filesystem::path& sensor_json);

/// Livox Mid-360 sensors (Livox SDK 2, Cartesian data), by address. A sweep is a tenth of a second
/// by the sensor's clock; late packets join the sweep in progress.
std::unique_ptr<SweepReader> makeLivoxSweeps();

}  // namespace hagen::sensors
