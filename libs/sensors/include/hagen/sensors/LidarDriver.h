#pragma once
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

/// The result of a datagram.
enum class Taken {
    Yes,
    WrongSize,    ///< not a data packet
    OtherSensor,  ///< of another model or serial number
    Auxiliary,    ///< of the IMU, or a position packet
    Duplicate,
    TooLate,
    Unsound,   ///< without valid data
    Uncertain  ///< perhaps of another mode than the metadata
};

struct PacketCounts {
    std::size_t packets = 0;  ///< taken
    std::size_t wrong_size = 0, other_sensor = 0, auxiliary = 0, duplicate = 0, unsound = 0,
                uncertain = 0;
    std::size_t unsound_blocks = 0;  ///< of packets that were taken
    std::size_t late = 0;            ///< came after a later one
    std::size_t too_late = 0;        ///< of these: dropped
    std::size_t lost = 0;
    std::size_t interruptions = 0;  ///< gaps, and jumps of the sensor's clock
    std::size_t restarts = 0;       ///< of the sensor, by its packets
    std::size_t mode_changes = 0;   ///< between one return and two per firing
    std::size_t scans = 0;          ///< turns; of a sensor that does not turn, tenths of a second
};

/// Takes the returns of a driver as its packets arrive.
class ReturnSink {
 public:
    virtual ~ReturnSink() = default;
    /// Returns of a packet, which the sink may change, and what the head swept meanwhile.
    virtual void add(Scan& returns, const Sweep& sweep, double arrival_s) = 0;
    /// A frame of a sensor that does not turn.
    struct Frame {
        double first_arrival_s, last_arrival_s;
        double measured_s;     ///< how long its packets measured
        double sensor_time_s;  ///< of its first packet, by the sensor's clock
    };
    virtual void addFrame(Scan& returns, const Frame& frame) = 0;
    /// A gap follows.
    virtual void flush() = 0;
    /// Returns that follow are not comparable with those before.
    virtual void restart() = 0;
};

/// Reads the packets of one sensor in the order in which they arrive: checks, counts and decodes
/// them at once. Packets up to sixteen late are decoded; later ones are dropped, unless so many
/// come in a row that the sensor's clock was set. No content of a packet throws.
class LidarDriver {
 public:
    virtual ~LidarDriver() = default;

    virtual SensorModel sensor() const = 0;
    /// `min_range_m`: the minimum range.
    virtual BeamOffsets beamOffsets(double /*min_range_m*/) const { return {}; }
    virtual bool turns() const { return true; }
    /// Whether the latest packet has two returns per firing.
    virtual bool isDual() const { return false; }

    /// Whether a datagram seems to hold data of this sensor.
    virtual bool isData(const Datagram& datagram) const = 0;
    /// Whether packets have a serial number. Otherwise, sensors of one model differ by address.
    virtual bool hasSerial() const { return false; }

    /// Takes a datagram that arrived at `arrival_s`, in seconds of a clock that does not go back.
    virtual Taken add(const Datagram& datagram, double arrival_s, ReturnSink& sink) = 0;
    /// Passes on the frame in progress: the sensor is silent.
    virtual void flush(ReturnSink&) {}
    /// Counts the turn in progress.
    virtual void finish() {}

    const PacketCounts& counts() const { return counts_; }

 protected:
    PacketCounts counts_;
};

/// `calibration`: of an HDL-64E; null: that of the model. Throws std::invalid_argument for an
/// HDL-64E without calibration.
std::unique_ptr<LidarDriver> makeVelodyneDriver(const VelodyneModel& model,
                                                const VelodyneCalibration* calibration = nullptr);
std::unique_ptr<LidarDriver> makeOusterDriver(const OusterSensor& sensor);
/// Livox Mid-360 (Livox SDK 2, Cartesian data), in frames of 20 ms.
std::unique_ptr<LidarDriver> makeLivoxDriver();

/// The models that makeDriver() knows, without Ousters: "VLP-16, ...".
std::string driverModels(const std::string& separator = ", ");

/// Throws std::runtime_error with the reason unless there is a driver for this model, or for the
/// Ouster of a metadata file; `calibration` is required by an HDL-64E.
void checkDriver(const std::string& model, const std::filesystem::path& sensor_json = {},
                 const std::filesystem::path& calibration = {});

/// Throws std::runtime_error naming the file that cannot be used, or like checkDriver().
std::unique_ptr<LidarDriver> makeDriver(const std::string& model,
                                        const std::filesystem::path& sensor_json = {},
                                        const std::filesystem::path& calibration = {});

}  // namespace hagen::sensors
