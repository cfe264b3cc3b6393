#pragma once
#include <hagen/scan/SensorModel.h>
#include <hagen/sensors/Datagram.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hagen::sensors {

/// The pixel layout of Ouster packets ("profile" in the firmware manual).
struct OusterProfile {
    std::string name;
    bool is_legacy;  ///< packets without header, but with a footer per column
    std::size_t pixel_bytes;
    std::uint32_t range_mask;  ///< bits of the range in a pixel's first little-endian number
    float range_unit_m;
    std::size_t reflectivity_at;
    std::size_t second_at;  ///< offset of the second return's range; 0 in single-return profiles
    std::size_t second_reflectivity_at;
};

/// An Ouster sensor, as described by its metadata.
struct OusterSensor {
    std::string name;    ///< product line, such as "OS-0-32-U1"
    std::string serial;  ///< empty if unknown
    OusterProfile profile;
    bool has_fusa_header = false;  ///< header with functional-safety fields, in another layout
    std::size_t columns_per_frame = 0, columns_per_packet = 0, pixels = 0;
    double turn_s = 0;  ///< duration of a turn in the sensor's mode; 0 if unknown
    std::size_t first_column = 0, last_column = 0;  ///< azimuth window; may wrap around
    std::vector<double> altitude_rad, azimuth_rad;  ///< per pixel; azimuth counter-clockwise
    std::vector<std::uint8_t> row;                  ///< per pixel; 0 is the lowest beam
    std::vector<std::size_t> beam_pixels;  ///< pixels with a beam, ascending; others are unused
    double beam_origin_m = 0;              ///< horizontal offset of the beams from the axis
    double beam_origin_up_m = 0;
    Eigen::Isometry3d lidar_to_sensor = Eigen::Isometry3d::Identity();
    std::shared_ptr<const SensorModel> model;  ///< beams, lowest first

    /// True if both packets and metadata contain a serial number.
    bool hasSerial() const { return !profile.is_legacy && !serial.empty(); }
    std::size_t packetBytes() const;
    std::size_t columnBytes() const;
    std::size_t windowColumns() const;
    /// Returns a column of a packet, and whether the sensor flagged it as valid.
    const std::uint8_t* columnOf(const std::uint8_t* packet, std::size_t column) const;
    bool isValid(const std::uint8_t* column) const;
};

enum class OusterPacketKind { Lidar, Imu, OtherSensor, Other };
/// Checks whether a datagram is a packet of this sensor.
OusterPacketKind kindOf(const Datagram& datagram, const OusterSensor& sensor);

/// Header fields of a packet of OusterSensor::packetBytes(). LEGACY packets have no header: all are
/// LiDAR packets with serial number 0 and the frame ID of their first column.
bool isOfLidar(const std::uint8_t* packet, const OusterSensor& sensor);
std::uint64_t serialOf(const std::uint8_t* packet, const OusterSensor& sensor);
std::uint16_t frameIdOf(const std::uint8_t* packet, const OusterSensor& sensor);  ///< wraps
/// The initialization ID, which changes with each restart or mode change; nullopt in LEGACY
/// packets.
std::optional<std::uint32_t> initializationOf(const std::uint8_t* packet,
                                              const OusterSensor& sensor);

/// Reads a sensor's metadata file, as written by the sensor or the vendor's tools. Supports the
/// profiles LEGACY, RNG19_RFL8_SIG16_NIR16 (with _DUAL or _ZONE16), RNG15_RFL8_NIR8 (with _DUAL,
/// FUSA_..._DUAL or _ZONE16), RNG15_RFL8_WIN8 and FIVE_WORD_PIXEL, with the layouts in the vendor's
/// SDK. Throws std::runtime_error naming the file and the missing or invalid key.
OusterSensor readOusterSensor(const std::filesystem::path& file);
/// Like readOusterSensor(), for metadata text. `origin`: name in error messages.
OusterSensor ousterSensorOf(const std::string& text, const std::string& origin);

}  // namespace hagen::sensors
