#include "sensors/ouster/OusterSensor.h"
#include "base/ReadFile.h"

#include <hagen/scan/Angle.h>
#include "base/FileKind.h"
#include "base/Json.h"
#include "base/NumberText.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>

#include "sensors/LittleEndian.h"

namespace hagen::sensors {
namespace {

using nlohmann::json;

constexpr std::size_t kLegacyColumnHeader = 16, kLegacyColumnFooter = 4;
constexpr std::size_t kPixelsWithoutFormat = 64;  // generation 1
constexpr std::size_t kColumnHeader = 12, kPacketHeader = 32, kPacketFooter = 32;

const std::vector<OusterProfile>& profiles() {
    static const std::vector<OusterProfile> known{
        {"LEGACY", true, 12, 0xfffff, 0.001f, 4, 0, 0},
        {"RNG19_RFL8_SIG16_NIR16", false, 12, 0x7ffff, 0.001f, 4, 0, 0},
        {"RNG19_RFL8_SIG16_NIR16_DUAL", false, 16, 0x7ffff, 0.001f, 3, 4, 7},
        {"RNG19_RFL8_SIG16_NIR16_ZONE16", false, 12, 0x7ffff, 0.001f, 4, 0, 0},
        {"RNG15_RFL8_NIR8", false, 4, 0x7fff, 0.008f, 2, 0, 0},
        {"RNG15_RFL8_WIN8", false, 4, 0x7fff, 0.008f, 2, 0, 0},
        {"RNG15_RFL8_NIR8_ZONE16", false, 8, 0x7fff, 0.008f, 2, 0, 0},
        {"RNG15_RFL8_NIR8_DUAL", false, 8, 0x7fff, 0.008f, 2, 4, 6},
        {"FUSA_RNG15_RFL8_NIR8_DUAL", false, 8, 0x7fff, 0.008f, 2, 4, 6},
        {"FIVE_WORD_PIXEL", false, 20, 0x7ffff, 0.001f, 3, 4, 7}};
    return known;
}

/// Returns a member; nullptr if `object` is not an object or lacks the key.
const json* member(const json& object, const std::string& key) {
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

/// Parsed metadata. Keys are at the top level or, since firmware 3, in sections.
class Metadata {
 public:
    explicit Metadata(const json& root) : root_(root) {}

    const json* find(const std::string& key) const {
        if (const json* found = member(root_, key)) return found;
        for (const char* section : {"sensor_info", "beam_intrinsics", "lidar_intrinsics",
                                    "lidar_data_format", "data_format", "config_params"}) {
            const json* const in = member(root_, section);
            const json* const found = in == nullptr ? nullptr : member(*in, key);
            if (found != nullptr) return found;
        }
        return nullptr;
    }
    const json& at(const std::string& key) const {
        if (const json* found = find(key)) return *found;
        throw std::runtime_error("the key '" + key + "' is missing");
    }
    template <class Value>
    Value value(const std::string& key) const {
        try {
            return at(key).get<Value>();
        } catch (const json::exception& e) {
            throw std::runtime_error("'" + key + "': " + e.what());
        }
    }
    /// Returns "" if the key is missing.
    std::string text(const std::string& key) const {
        return find(key) == nullptr ? "" : value<std::string>(key);
    }
    /// Reads an integer within limits.
    std::size_t count(const std::string& key, std::size_t min, std::size_t max) const {
        const auto number = value<double>(key);
        if (number >= static_cast<double>(min) && number <= static_cast<double>(max) &&
            number == std::floor(number)) {
            return static_cast<std::size_t>(number);
        }
        throw std::runtime_error("'" + key + "' is " + at(key).dump() + ", not " +
                                 std::to_string(min) + " ... " + std::to_string(max));
    }
    /// Reads numbers within +-`max`.
    std::vector<double> numbers(const std::string& key, std::size_t count, double max) const {
        const auto values = value<std::vector<double>>(key);
        if (values.size() != count) {
            throw std::runtime_error("'" + key + "' has " + std::to_string(values.size()) +
                                     " numbers, not " + std::to_string(count));
        }
        for (const double value : values) {
            if (std::abs(value) <= max) continue;  // false if NaN
            throw std::runtime_error("'" + key + "' has a number outside +-" +
                                     std::to_string(static_cast<int>(max)));
        }
        return values;
    }

 private:
    const json& root_;
};

/// Number of columns in a mode such as "1024x10".
std::size_t columnsOfMode(const std::string& mode) {
    for (const std::size_t columns : {512, 1024, 2048, 4096}) {
        if (mode.rfind(std::to_string(columns) + "x", 0) == 0) return columns;
    }
    throw std::runtime_error("'lidar_mode' is '" + mode + "'; expected a mode such as '1024x10'");
}

/// The duration of a turn in a mode such as "1024x10"; 0 for other texts.
double turnTimeOfMode(const Metadata& metadata) {
    const json* const found = metadata.find("lidar_mode");
    if (found == nullptr || !found->is_string()) return 0;
    const std::string mode = *found;
    const std::size_t at = mode.find('x');
    const auto turns =
        at == std::string::npos ? std::nullopt : base::numberFrom<unsigned>(mode.substr(at + 1));
    return turns && *turns > 0 && *turns <= 100 ? 1.0 / *turns : 0;
}

const OusterProfile& profileNamed(const std::string& name) {
    std::string known;
    for (const OusterProfile& profile : profiles()) {
        if (profile.name == name) return profile;
        known += (known.empty() ? "" : ", ") + profile.name;
    }
    throw std::runtime_error("'udp_profile_lidar' is '" + name + "', which is not supported; " +
                             "known: " + known +
                             ". Set one of these in the sensor's configuration and record again");
}

/// Metadata before firmware 3.2 lack the header type, which then follows from the profile.
bool hasFusaHeader(const Metadata& metadata, const OusterProfile& profile) {
    if (profile.is_legacy) return false;
    const std::string header = metadata.text("header_type");
    if (header.empty()) return profile.name.rfind("FUSA_", 0) == 0;
    if (header == "FUSA" || header == "STANDARD") return header == "FUSA";
    throw std::runtime_error("'header_type' is '" + header + "', not 'STANDARD' or 'FUSA'");
}

void readFormat(const Metadata& metadata, OusterSensor& sensor) {
    constexpr std::size_t kMaxFrameColumns = 4096, kMaxBeams = 256;
    const bool has_format = metadata.find("pixels_per_column") != nullptr;
    sensor.pixels =
        has_format ? metadata.count("pixels_per_column", 3, kMaxBeams) : kPixelsWithoutFormat;
    sensor.columns_per_frame = has_format
                                   ? metadata.count("columns_per_frame", 1, kMaxFrameColumns)
                                   : columnsOfMode(metadata.value<std::string>("lidar_mode"));
    sensor.turn_s = turnTimeOfMode(metadata);
    const std::size_t max_of_packet = std::min<std::size_t>(64, sensor.columns_per_frame);
    sensor.columns_per_packet =
        has_format ? metadata.count("columns_per_packet", 1, max_of_packet) : 16;
    const std::string profile = metadata.text("udp_profile_lidar");
    sensor.profile = profileNamed(profile.empty() ? "LEGACY" : profile);
    sensor.has_fusa_header = hasFusaHeader(metadata, sensor.profile);
    sensor.first_column = 0;
    sensor.last_column = sensor.columns_per_frame - 1;
    if (metadata.find("column_window") == nullptr) return;
    const std::vector<double> window =
        metadata.numbers("column_window", 2, static_cast<double>(sensor.last_column));
    sensor.first_column = static_cast<std::size_t>(std::max(0.0, window[0]));
    sensor.last_column = static_cast<std::size_t>(std::max(0.0, window[1]));
}

void readGeometry(const Metadata& metadata, OusterSensor& sensor) {
    // Packets of generation 1 have 64 pixels; those of 16 or 32 beams are the last of each group.
    const std::size_t listed = metadata.at("beam_altitude_angles").size();
    const bool is_spread = sensor.profile.is_legacy && listed > 0 && listed < sensor.pixels;
    const std::size_t beams = is_spread ? listed : sensor.pixels;
    const auto in_radians = [&](const std::string& key, double max_deg) {
        std::vector<double> angles(sensor.pixels);
        const std::vector<double> of_beams = metadata.numbers(key, beams, max_deg);
        for (std::size_t beam = 0; beam < beams; ++beam) {
            angles[(beam + 1) * sensor.pixels / beams - 1] = radians(of_beams[beam]);
        }
        return angles;
    };
    sensor.altitude_rad = in_radians("beam_altitude_angles", 90);
    sensor.azimuth_rad = in_radians("beam_azimuth_angles", 360);
    for (double& azimuth_rad : sensor.azimuth_rad)
        azimuth_rad = -azimuth_rad;  // clockwise in metadata
    if (metadata.find("beam_to_lidar_transform") != nullptr) {
        const std::vector<double> to_lidar = metadata.numbers("beam_to_lidar_transform", 16, 1000);
        sensor.beam_origin_m = 1e-3 * to_lidar[3];
        sensor.beam_origin_up_m = 1e-3 * to_lidar[11];
    } else if (metadata.find("lidar_origin_to_beam_origin_mm") != nullptr) {
        const double origin_mm = metadata.value<double>("lidar_origin_to_beam_origin_mm");
        if (!(std::abs(origin_mm) <= 1000)) {
            throw std::runtime_error("'lidar_origin_to_beam_origin_mm' exceeds 1 m");
        }
        sensor.beam_origin_m = 1e-3 * origin_mm;
    }
    // All sensors have this transform unless the metadata override it.
    std::vector<double> to_sensor{-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36.18, 0, 0, 0, 1};
    if (metadata.find("lidar_to_sensor_transform") != nullptr) {
        to_sensor = metadata.numbers("lidar_to_sensor_transform", 16, 1000);
    }
    for (int i = 0; i < 12; ++i) {
        const double scale = i % 4 == 3 ? 1e-3 : 1.0;
        sensor.lidar_to_sensor.matrix()(i / 4, i % 4) = scale * to_sensor[i];
    }
    const Eigen::Matrix3d rotation = sensor.lidar_to_sensor.linear();
    if (!(rotation * rotation.transpose()).isIdentity(1e-3)) {
        throw std::runtime_error("'lidar_to_sensor_transform' is not a rigid transformation");
    }
    // Other rotations would change rows and sweep direction. Mounts belong in the settings.
    if (!(rotation(2, 2) > 0.999) || !(rotation.determinant() > 0)) {
        throw std::runtime_error("'lidar_to_sensor_transform' rotates about other axes than z");
    }
}

/// Finds the pixels with a beam. Unused pixels have two angles of 0, as one beam may have, too.
void findBeams(OusterSensor& sensor) {
    std::vector<std::size_t> pixels(sensor.pixels), used;
    std::iota(pixels.begin(), pixels.end(), std::size_t{0});
    std::copy_if(pixels.begin(), pixels.end(), std::back_inserter(used), [&](std::size_t pixel) {
        return sensor.altitude_rad[pixel] != 0 || sensor.azimuth_rad[pixel] != 0;
    });
    sensor.beam_pixels = used.size() + 1 == pixels.size() ? pixels : used;
}

/// Assigns rows to pixels and creates the sensor model.
void sortBeams(OusterSensor& sensor) {
    std::vector<std::size_t> by_altitude = sensor.beam_pixels;
    std::sort(by_altitude.begin(), by_altitude.end(), [&](std::size_t a, std::size_t b) {
        return sensor.altitude_rad[a] < sensor.altitude_rad[b];
    });
    sensor.row.resize(sensor.pixels);
    std::vector<double> elevations_deg;
    for (std::size_t row = 0; row < by_altitude.size(); ++row) {
        sensor.row[by_altitude[row]] = static_cast<std::uint8_t>(row);
        elevations_deg.push_back(degrees(sensor.altitude_rad[by_altitude[row]]));
    }
    SensorModel model;
    try {
        model = customSensorModel(elevations_deg);
    } catch (const std::invalid_argument& e) {
        throw std::runtime_error("'beam_altitude_angles': " + std::string(e.what()));
    }
    model.name = sensor.name;
    const bool is_os0 = sensor.name.rfind("OS-0", 0) == 0,
               is_os1 = sensor.name.rfind("OS-1", 0) == 0;
    model.min_range_m = is_os0 ? 0.3f : 0.5f;
    model.max_range_m = is_os0 ? 100.0f : is_os1 ? 200.0f : 500.0f;
    sensor.model = std::make_shared<const SensorModel>(std::move(model));
}

constexpr std::size_t kMaxMetadataBytes = 1 << 20;

/// Checks the text of metadata before parsing.
void checkText(const std::string& text) {
    if (text.empty()) throw std::runtime_error("is empty");
    const base::FileKind kind = base::kindOfBytes(text.substr(0, base::kFileKindBytes));
    const bool is_text = kind.what.rfind("text", 0) == 0;
    if (!kind.what.empty() && !is_text) throw std::runtime_error(kind.text());
    if (text.size() > kMaxMetadataBytes) throw std::runtime_error("is larger than 1 MB");
}

}  // namespace

std::size_t OusterSensor::columnBytes() const {
    return profile.is_legacy
               ? kLegacyColumnHeader + pixels * profile.pixel_bytes + kLegacyColumnFooter
               : kColumnHeader + pixels * profile.pixel_bytes;
}

std::size_t OusterSensor::packetBytes() const {
    return columns_per_packet * columnBytes() +
           (profile.is_legacy ? 0 : kPacketHeader + kPacketFooter);
}

std::size_t OusterSensor::windowColumns() const {
    return (last_column + columns_per_frame - first_column) % columns_per_frame + 1;
}

const std::uint8_t* OusterSensor::columnOf(const std::uint8_t* packet, std::size_t column) const {
    return packet + (profile.is_legacy ? 0 : kPacketHeader) + column * columnBytes();
}

bool OusterSensor::isValid(const std::uint8_t* column) const {
    if (!profile.is_legacy) return (column[10] & 1) != 0;
    const std::uint8_t* const footer = column + columnBytes() - kLegacyColumnFooter;
    return std::all_of(footer, footer + kLegacyColumnFooter,
                       [](std::uint8_t byte) { return byte == 0xff; });
}

OusterPacketKind kindOf(const Datagram& datagram, const OusterSensor& sensor) {
    constexpr std::size_t kImuBytes = 48;
    const bool has_size = datagram.size == sensor.packetBytes();
    if (!has_size && datagram.size == kImuBytes) return OusterPacketKind::Imu;
    if (!has_size || !isOfLidar(datagram.bytes, sensor)) return OusterPacketKind::Other;
    if (!sensor.hasSerial()) return OusterPacketKind::Lidar;
    const bool is_same = std::to_string(serialOf(datagram.bytes, sensor)) == sensor.serial;
    return is_same ? OusterPacketKind::Lidar : OusterPacketKind::OtherSensor;
}

bool isOfLidar(const std::uint8_t* packet, const OusterSensor& sensor) {
    if (sensor.profile.is_legacy) return true;
    return packet[0] == 1 && (sensor.has_fusa_header || packet[1] == 0);
}

std::uint64_t serialOf(const std::uint8_t* packet, const OusterSensor& sensor) {
    if (sensor.profile.is_legacy) return 0;
    const std::size_t at = sensor.has_fusa_header ? 11 : 7;
    return little<std::uint64_t>(packet + at) & 0xffffffffff;
}

std::uint16_t frameIdOf(const std::uint8_t* packet, const OusterSensor& sensor) {
    const std::size_t at = sensor.profile.is_legacy ? 10 : sensor.has_fusa_header ? 4 : 2;
    return little<std::uint16_t>(packet + at);
}

std::optional<std::uint32_t> initializationOf(const std::uint8_t* packet,
                                              const OusterSensor& sensor) {
    if (sensor.profile.is_legacy) return std::nullopt;
    const std::size_t at = sensor.has_fusa_header ? 1 : 4;
    return little<std::uint32_t>(packet + at) & 0xffffff;
}

OusterSensor ousterSensorOf(const std::string& text, const std::string& origin) {
    try {
        checkText(text);
        const json root = base::parseJson(text);
        const Metadata metadata(root);
        if (metadata.find("beam_altitude_angles") == nullptr) {
            throw std::runtime_error(
                "the key 'beam_altitude_angles' is missing; is this file Ouster metadata?");
        }
        OusterSensor sensor;
        sensor.name = metadata.text("prod_line");
        if (sensor.name.empty()) sensor.name = "Ouster";
        sensor.serial = metadata.text("prod_sn");
        readFormat(metadata, sensor);
        readGeometry(metadata, sensor);
        findBeams(sensor);
        sortBeams(sensor);
        return sensor;
    } catch (const std::exception& e) {
        throw std::runtime_error(origin + ": not Ouster metadata: " + e.what());
    }
}

OusterSensor readOusterSensor(const std::filesystem::path& file) {
    return ousterSensorOf(base::readText(file, kMaxMetadataBytes), file.string());
}

}  // namespace hagen::sensors
