#include "support/Hdl64.h"

#include <cmath>

namespace hagen::test {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180;

ByteString little16(unsigned value) {
    return {static_cast<char>(value & 0xff), static_cast<char>(value >> 8 & 0xff)};
}

/// The horizontal directions forward and left at an azimuth.
Eigen::Vector3d forwardOf(double azimuth_deg) {
    return {std::cos(kRadians * azimuth_deg), -std::sin(kRadians * azimuth_deg), 0};
}
Eigen::Vector3d leftOf(double azimuth_deg) {
    return {std::sin(kRadians * azimuth_deg), std::cos(kRadians * azimuth_deg), 0};
}

}  // namespace

Eigen::Vector3d Hdl64Laser::direction(double azimuth_deg) const {
    const Eigen::Vector3d forward = forwardOf(azimuth_deg - rot_deg);
    return std::cos(kRadians * vert_deg) * forward +
           std::sin(kRadians * vert_deg) * Eigen::Vector3d::UnitZ();
}

Eigen::Vector3d Hdl64Laser::origin_m(double azimuth_deg) const {
    const Eigen::Vector3d forward = forwardOf(azimuth_deg - rot_deg);
    const Eigen::Vector3d up = std::cos(kRadians * vert_deg) * Eigen::Vector3d::UnitZ() -
                               std::sin(kRadians * vert_deg) * forward;
    return 0.01 * (vert_offset_cm * up + horiz_offset_cm * leftOf(azimuth_deg - rot_deg));
}

std::vector<Hdl64Laser> hdl64Lasers() {
    std::vector<Hdl64Laser> lasers;
    for (int i = 0; i < 64; ++i) {
        const int place = i * 7 % 32;  // lasers are not ordered by elevation
        const bool is_lower = i >= 32;
        const double vert_deg = is_lower ? -24.33 + 0.5 * place : -8.2 + place / 3.0;
        lasers.push_back({(i % 4 - 1.5) * 3.1, vert_deg, 90.0 + i, is_lower ? 12.0 : 20.0,
                          i % 2 == 0 ? 2.6 : -2.6});
    }
    return lasers;
}

std::string hdl64Xml(const std::vector<Hdl64Laser>& lasers) {
    std::string enabled, points;
    for (std::size_t i = 0; i < lasers.size(); ++i) {
        const Hdl64Laser& laser = lasers[i];
        const auto element = [](const std::string& name, double value) {
            return "\t\t<" + name + ">" + std::to_string(value) + "</" + name + ">\n";
        };
        enabled += "<item>1</item>\n";
        points +=
            "<item class_id=\"9\" tracking_level=\"0\" version=\"1\"><px "
            "class_id=\"10\">\n\t\t<id_>" +
            std::to_string(i) + "</id_>\n" + element("rotCorrection_", laser.rot_deg) +
            element("vertCorrection_", laser.vert_deg) + element("distCorrection_", laser.dist_cm) +
            element("distCorrectionX_", 1) + element("distCorrectionY_", 2) +
            element("vertOffsetCorrection_", laser.vert_offset_cm) +
            element("horizOffsetCorrection_", laser.horiz_offset_cm) +
            element("focalDistance_", 0) + element("focalSlope_", 0) + "</px></item>\n";
    }
    return "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\" ?>\n"
           "<!DOCTYPE boost_serialization>\n"
           "<boost_serialization signature=\"serialization::archive\" version=\"4\">\n"
           "<!-- a <comment> --><DB class_id=\"0\" tracking_level=\"1\" version=\"0\">\n"
           "<distLSB_>0.2</distLSB_>\n<enabled_ class_id=\"5\"><count>64</count>\n"
           "<item_version>0</item_version>" +
           enabled + "</enabled_>\n<points_ class_id=\"7\"><count>64</count>\n" + points +
           "</points_></DB>\n</boost_serialization>\n";
}

std::vector<ByteString> hdl64Packets(int firings, const Hdl64Range& range_m) {
    constexpr int kFiringsOfPacket = 6, kReadings = 18;
    const std::vector<Hdl64Laser> lasers = hdl64Lasers();
    std::vector<ByteString> packets;
    for (int first = 0; first < firings; first += kFiringsOfPacket) {
        ByteString packet;
        for (int f = first; f < first + kFiringsOfPacket; ++f) {
            const unsigned reading = static_cast<unsigned>(f * kReadings % 36000);
            for (const int bank : {0, 32}) {
                packet += little16(bank == 0 ? 0xeeff : 0xddff) + little16(reading);
                for (int laser = bank; laser < bank + 32; ++laser) {
                    const double far_m = f < firings ? range_m(laser, 0.01 * reading) : 0;
                    const double units = (far_m - 0.01 * lasers[laser].dist_cm) / 0.002;
                    const bool has_return = far_m > 0 && units >= 1 && units < 65535;
                    packet += little16(has_return ? static_cast<unsigned>(std::lround(units)) : 0);
                    packet += static_cast<char>(has_return ? 51 : 0);
                }
            }
        }
        packet += little32(static_cast<std::uint32_t>(1000000 + first * 48));
        packet += "9W";  // a status byte that smaller sensors use for dual returns
        packets.push_back(packet);
    }
    return packets;
}

}  // namespace hagen::test
