#pragma once
#include <hagen/scan/SensorModel.h>
#include <hagen/sensors/Datagram.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hagen::sensors {

/// The pixel layout of Ouster packets: a profile in the firmware manual.
struct OusterProfile {
    std::string name;
    bool is_legacy;            ///< no packet header, a footer per column
    std::size_t pixel_bytes;   ///< per beam and column
    std::uint32_t range_mask;  ///< mask of the little-endian number at the start of a pixel
    float range_unit_m;
    std::size_t reflectivity_at;
    std::size_t second_at;  ///< offset of the second return's range; 0: single return
    std::size_t second_reflectivity_at;
};

/// An Ouster sensor, as described by its metadata.
struct OusterSensor {
    std::string name;    ///< product line: "OS-0-32-U1"
    std::string serial;  ///< empty: unknown
    OusterProfile profile;
    bool has_fusa_header = false;  ///< functional-safety header with another layout
    std::size_t columns_per_frame = 0, columns_per_packet = 0, pixels = 0;
    double turn_s = 0;                              ///< duration of a turn in its mode; 0: unknown
    std::size_t first_column = 0, last_column = 0;  ///< window; may wrap around
    std::vector<double> altitude_rad, azimuth_rad;  ///< of each pixel; azimuth counter-clockwise
    std::vector<std::uint8_t> row;                  ///< of each pixel: 0 is the lowest beam
    double beam_origin_m = 0;     ///< horizontal offset of the beams from the axis
    double beam_origin_up_m = 0;  ///< vertical offset
    Eigen::Isometry3d lidar_to_sensor = Eigen::Isometry3d::Identity();
    std::shared_ptr<const SensorModel> model;  ///< the beams, lowest first

    /// True if both packets and metadata have a serial number.
    bool hasSerial() const { return !profile.is_legacy && !serial.empty(); }
    std::size_t packetBytes() const;
    std::size_t columnBytes() const;
    std::size_t windowColumns() const;
    /// A column of a packet, and whether the sensor flags it as valid.
    const std::uint8_t* columnOf(const std::uint8_t* packet, std::size_t column) const;
    bool isValid(const std::uint8_t* column) const;
};

enum class OusterPacketKind { Lidar, Imu, OtherSensor, Other };
/// Checks whether a datagram is from this sensor.
OusterPacketKind kindOf(const Datagram& datagram, const OusterSensor& sensor);

/// Fields in the header of a packet of OusterSensor::packetBytes(). LEGACY packets have no header:
/// all are LiDAR packets with the serial number 0 and the first column's frame id.
bool isOfLidar(const std::uint8_t* packet, const OusterSensor& sensor);
std::uint64_t serialOf(const std::uint8_t* packet, const OusterSensor& sensor);
std::uint16_t frameIdOf(const std::uint8_t* packet, const OusterSensor& sensor);  ///< wraps
/// The initialization id, which changes at each restart or mode change of the sensor; none: LEGACY.
std::optional<std::uint32_t> initializationOf(const std::uint8_t* packet,
                                              const OusterSensor& sensor);

/// Reads a sensor's metadata, as written by the sensor or the vendor's tools. Profiles: LEGACY,
/// RNG19_RFL8_SIG16_NIR16, the same with _DUAL and _ZONE16, RNG15_RFL8_NIR8, the same with _DUAL
/// (also FUSA_...) and _ZONE16, RNG15_RFL8_WIN8 and FIVE_WORD_PIXEL, with the layouts in the
/// vendor's SDK. Throws std::runtime_error naming the file and the missing or invalid key.
OusterSensor readOusterSensor(const std::filesystem::path& file);
/// The same for metadata read from `origin`, which error messages name.
OusterSensor ousterSensorOf(const std::string& text, const std::string& origin);

}  // namespace hagen::sensors
