#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/sensors/Datagram.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <Eigen/Core>
#include "sensors/captures/Remarks.h"

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hagen::sensors {

/// A sweep of a recorded sensor: one turn, or 0.1 s if the sensor does not rotate.
struct LidarSweep {
    std::string label;         ///< such as "velodyne", "velodyne_2"
    std::int64_t time_ns = 0;  ///< recording time of the first packet
    std::shared_ptr<const SensorModel> sensor;
    Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< beam origin relative to the base
    Scan returns;  ///< empty if `packets` contains the returns
    bool has_tags = false;
    std::vector<std::uint8_t> tags;  ///< Livox only: one per return
    /// Velodyne only: packets of kVelodynePacketBytes each, and the calibration.
    std::vector<std::uint8_t> packets;
    VelodyneCalibration calibration;
};

/// Groups the datagrams of a recording into sweeps, for all sensors of one vendor.
class SweepReader {
 public:
    virtual ~SweepReader() = default;

    /// Learns the field of view from the start of the recording, before add().
    virtual void preview(const Datagram& /*datagram*/) {}
    virtual void add(const Datagram& datagram) = 0;
    /// Ends the sweeps in progress.
    virtual void finish() = 0;
    /// Complete sweeps, oldest first. The caller removes them.
    std::deque<LidarSweep>& complete() { return complete_; }

    /// Packet counts per sensor. Valid after finish(), like the functions below.
    virtual std::vector<std::string> remarks() const = 0;
    /// Counts of ignored datagrams, separated by ", "; "" if there are none.
    virtual std::string ignored() const = 0;
    /// Why there are no sweeps; "" if that is not an error. `losses`: describes the capture's
    /// losses.
    virtual std::string whyEmpty(const std::string& /*losses*/) const { return ""; }

 protected:
    std::deque<LidarSweep> complete_;
    OtherDatagrams others_;
};

/// Reads Velodyne sensors, distinguished by address, port and model: the HDL-64E by its
/// blocks, the others by the ID in their packets. `calibration`: HDL-64E
/// calibration file (readVelodyneCalibration()); if empty, HDL-64E packets are ignored. Throws
/// std::runtime_error naming the file if it is invalid.
std::unique_ptr<SweepReader> makeVelodyneSweeps(const std::filesystem::path& calibration = {});

/// Reads one Ouster with this metadata file. Throws std::runtime_error naming the file if it is
/// unusable.
std::unique_ptr<SweepReader> makeOusterSweeps(const std::filesystem::path& sensor_json);

/// Reads Livox Mid-360 sensors (Livox SDK 2, Cartesian data), distinguished by address. A sweep
/// lasts 0.1 s of the sensor's clock; late packets join the sweep in progress.
std::unique_ptr<SweepReader> makeLivoxSweeps();

/// Reads Hesai XT32 and XT16 sensors, distinguished by address. A sweep ends where the azimuth
/// wraps; late packets join the sweep in progress.
std::unique_ptr<SweepReader> makeHesaiSweeps();

}  // namespace hagen::sensors
