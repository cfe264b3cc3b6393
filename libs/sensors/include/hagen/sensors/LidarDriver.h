#pragma once
#include <hagen/scan/Angle.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/sensors/Datagram.h>
#include <hagen/sensors/Sweep.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace hagen::sensors {

struct OusterSensor;
struct VelodyneCalibration;
struct VelodyneModel;

/// What a driver did with a datagram.
enum class Taken {
    Yes,
    WrongSize,    ///< not a data packet
    OtherSensor,  ///< another model or serial number
    Auxiliary,    ///< IMU or position packet
    Duplicate,
    TooLate,
    Unsound,   ///< contains no valid data
    Uncertain  ///< the sensor's mode may differ from the metadata
};

struct PacketCounts {
    std::size_t packets = 0;
    std::size_t wrong_size = 0, other_sensor = 0, auxiliary = 0, duplicate = 0, unsound = 0,
                uncertain = 0;
    std::size_t unsound_blocks = 0;  ///< invalid blocks in decoded packets
    std::size_t late = 0;            ///< out-of-order packets
    std::size_t too_late = 0;        ///< out-of-order packets that were dropped
    std::size_t lost = 0;
    std::size_t interruptions = 0;  ///< gaps and jumps of the sensor clock
    std::size_t restarts = 0;       ///< sensor restarts detected in packets
    std::size_t mode_changes = 0;   ///< changes between single and dual return mode
    std::size_t scans = 0;          ///< turns, or 0.1 s intervals if the sensor does not rotate
};

/// Receives the returns of a driver as its packets arrive.
class ReturnSink {
 public:
    virtual ~ReturnSink() = default;
    /// Receives a packet's returns, which the sink may modify, and their azimuth range.
    virtual void add(Scan& returns, const Sweep& sweep, double arrival_s) = 0;
    /// A frame of a sensor that does not rotate.
    struct Frame {
        double first_arrival_s, last_arrival_s;
        double measured_s;     ///< total measuring time of its packets
        double sensor_time_s;  ///< sensor time of its first packet
    };
    virtual void addFrame(Scan& returns, const Frame& frame) = 0;
    /// Called before a gap.
    virtual void flush() = 0;
    /// Called when later returns are not comparable with earlier returns.
    virtual void restart() = 0;
};

/// Checks, counts and decodes the packets of one sensor as they arrive. Decodes packets that are up
/// to 16 packets late and drops older packets, unless so many in a row are late that the sensor
/// clock must have been set. Packet content never causes exceptions.
class LidarDriver {
 public:
    virtual ~LidarDriver() = default;

    virtual SensorModel sensor() const = 0;
    /// The sensor's beam offsets. `min_range_m`: the sensor's minimum range.
    virtual BeamOffsets beamOffsets(double /*min_range_m*/) const { return {}; }
    virtual bool turns() const { return true; }
    /// Horizontal field of view: the angle per turn in which the sensor sends packets, 0 ... 2 pi.
    virtual double view_rad() const { return kTurn_rad; }
    /// True if the latest packet has two returns per firing.
    virtual bool isDual() const { return false; }

    /// True if the datagram appears to contain data of this sensor.
    virtual bool isData(const Datagram& datagram) const = 0;
    /// True if packets have a serial number. Otherwise, sensors of the same model are distinguished
    /// by address.
    virtual bool hasSerial() const { return false; }

    /// Adds a datagram that arrived at `arrival_s` on a monotonic clock.
    virtual Taken add(const Datagram& datagram, double arrival_s, ReturnSink& sink) = 0;
    /// Flushes the frame in progress when the sensor is silent.
    virtual void flush(ReturnSink&) {}
    /// Counts the turn in progress as complete.
    virtual void finish() {}

    const PacketCounts& counts() const { return counts_; }

 protected:
    PacketCounts counts_;
};

/// `calibration`: required for an HDL-64E; null selects the model's default. Throws
/// std::invalid_argument for an HDL-64E without calibration.
std::unique_ptr<LidarDriver> makeVelodyneDriver(const VelodyneModel& model,
                                                const VelodyneCalibration* calibration = nullptr);
std::unique_ptr<LidarDriver> makeOusterDriver(const OusterSensor& sensor);
/// Creates a driver of the Livox Mid-360 (Livox SDK 2, Cartesian data) with frames of 20 ms.
std::unique_ptr<LidarDriver> makeLivoxDriver();
/// `model`: "XT32" or "XT16".
std::unique_ptr<LidarDriver> makeHesaiDriver(const std::string& model);

/// The models that makeDriver() accepts, except Ousters: "VLP-16, ...".
std::string driverModels(const std::string& separator = ", ");

/// Throws std::runtime_error with the reason if there is no driver for this model, or for the
/// Ouster described by a metadata file. An HDL-64E requires `calibration`.
void checkDriver(const std::string& model, const std::filesystem::path& sensor_json = {},
                 const std::filesystem::path& calibration = {});

/// Creates a driver. Throws std::runtime_error like checkDriver(), or naming an unusable file.
std::unique_ptr<LidarDriver> makeDriver(const std::string& model,
                                        const std::filesystem::path& sensor_json = {},
                                        const std::filesystem::path& calibration = {});

}  // namespace hagen::sensors
