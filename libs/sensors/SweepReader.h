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

/// A sweep of a recorded sensor: one turn, or 0.1 s of a sensor that does not rotate.
struct LidarSweep {
    std::string label;         ///< sensor label: "velodyne", "velodyne_2"
    std::int64_t time_ns = 0;  ///< recording time of the first packet
    std::shared_ptr<const SensorModel> sensor;
    Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< of the beams, from the base
    Scan returns;                                        ///< empty if `packets` contain them
    bool has_tags = false;
    std::vector<std::uint8_t> tags;  ///< Livox only: one per return
    /// Velodyne only: packets of kVelodynePacketBytes each, and their calibration.
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
    /// The complete sweeps, oldest first. The caller removes them.
    std::deque<LidarSweep>& complete() { return complete_; }

    /// Counts per sensor. Complete after finish(), like the following.
    virtual std::vector<std::string> remarks() const = 0;
    /// ", "-separated counts of the ignored datagrams; "" if there are none.
    virtual std::string ignored() const = 0;
    /// The reason why there are no sweeps; "" if that is not an error. `losses`: of the capture.
    virtual std::string whyEmpty(const std::string& /*losses*/) const { return ""; }

 protected:
    std::deque<LidarSweep> complete_;
    OtherDatagrams others_;
};

/// Velodyne sensors, distinguished by address, port and model: VLP-16, Puck Hi-Res, HDL-32E and
/// VLP-32C by the id in their packets, HDL-64E by their blocks. `calibration`: HDL-64E calibration
/// (readVelodyneCalibration()); empty: HDL-64E packets are ignored. Throws std::runtime_error
/// naming an invalid calibration.
std::unique_ptr<SweepReader> makeVelodyneSweeps(const std::filesystem::path& calibration = {});

/// One Ouster with these metadata. Throws std::runtime_error naming unusable metadata.
std::unique_ptr<SweepReader> makeOusterSweeps(const std::filesystem::path& sensor_json);

/// Livox Mid-360 sensors (Livox SDK 2, Cartesian data), distinguished by address. A sweep is 0.1 s
/// of the sensor's clock; late packets join the sweep in progress.
std::unique_ptr<SweepReader> makeLivoxSweeps();

}  // namespace hagen::sensors
