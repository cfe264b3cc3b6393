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

/// How the packets of an Ouster hold their pixels: a profile of its firmware manual.
struct OusterProfile {
    std::string name;
    bool is_legacy;            ///< no packet header, a footer per column
    std::size_t pixel_bytes;   ///< of a beam in a column
    std::uint32_t range_mask;  ///< of the little-endian number at the start of a pixel
    float range_unit_m;
    std::size_t reflectivity_at;
    std::size_t second_at;  ///< of the second return's range; 0: there is none
    std::size_t second_reflectivity_at;
};

/// An Ouster as its metadata describe it.
struct OusterSensor {
    std::string name;    ///< product line: "OS-0-32-U1"
    std::string serial;  ///< empty: not known
    OusterProfile profile;
    bool has_fusa_header = false;  ///< that of functional safety, with its fields elsewhere
    std::size_t columns_per_frame = 0, columns_per_packet = 0, pixels = 0;
    double turn_s = 0;  ///< as long as a turn takes, by its mode; 0: not known
    std::size_t first_column = 0, last_column = 0;  ///< of the window; it may wrap around
    std::vector<double> altitude_rad, azimuth_rad;  ///< of each pixel; azimuth counter-clockwise
    std::vector<std::uint8_t> row;                  ///< of each pixel: 0 is the lowest beam
    double beam_origin_m = 0;                       ///< of the beams, from the axis outwards
    double beam_origin_up_m = 0;                    ///< and upwards
    Eigen::Isometry3d lidar_to_sensor = Eigen::Isometry3d::Identity();
    std::shared_ptr<const SensorModel> model;  ///< the beams, lowest first

    /// Whether its packets and metadata have a serial number.
    bool hasSerial() const { return !profile.is_legacy && !serial.empty(); }
    std::size_t packetBytes() const;
    std::size_t columnBytes() const;
    std::size_t windowColumns() const;
    /// A column of a packet, and whether the sensor says that it is valid.
    const std::uint8_t* columnOf(const std::uint8_t* packet, std::size_t column) const;
    bool isValid(const std::uint8_t* column) const;
};

enum class OusterPacketKind { Lidar, Imu, OtherSensor, Other };
/// Whether a datagram is of this sensor.
OusterPacketKind kindOf(const Datagram& datagram, const OusterSensor& sensor);

/// What the header of a packet of OusterSensor::packetBytes() says. LEGACY packets have no header:
/// all are of the LiDAR, with the serial number 0, and the frame is that of the first column.
bool isOfLidar(const std::uint8_t* packet, const OusterSensor& sensor);
std::uint64_t serialOf(const std::uint8_t* packet, const OusterSensor& sensor);
std::uint16_t frameIdOf(const std::uint8_t* packet, const OusterSensor& sensor);  ///< it wraps
/// Another one each time the sensor starts, for which a change of its mode suffices; none: LEGACY.
std::optional<std::uint32_t> initializationOf(const std::uint8_t* packet,
                                              const OusterSensor& sensor);

/// Reads the metadata of a sensor, as the sensor or the maker's tools write it. Profiles: LEGACY,
/// RNG19_RFL8_SIG16_NIR16, the same with _DUAL and _ZONE16, RNG15_RFL8_NIR8, the same with _DUAL
/// (also FUSA_...) and _ZONE16, RNG15_RFL8_WIN8 and FIVE_WORD_PIXEL, laid out as the maker's SDK
/// publishes them. Throws std::runtime_error naming the file and what is missing or wrong.
OusterSensor readOusterSensor(const std::filesystem::path& file);
/// The same for metadata that were read from `origin`, which the message names.
OusterSensor ousterSensorOf(const std::string& text, const std::string& origin);

}  // namespace hagen::sensors
