#include "support/LivoxPackets.h"

#include <hagen/scan/Angle.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hagen::test {
namespace {

void put(std::string& bytes, std::int64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

}  // namespace

std::string livoxPacket(const std::vector<LivoxPoint>& points, std::int64_t time_ns, int number,
                        int data_type) {
    const int size = data_type == 1 ? 4 : 2;
    std::string bytes;
    put(bytes, 0, 1);
    put(bytes, static_cast<std::int64_t>(36 + points.size() * (3 * size + 2)), 2);
    put(bytes, 4800, 2);  // 480 us
    put(bytes, static_cast<std::int64_t>(points.size()), 2);
    put(bytes, number, 2);
    put(bytes, 0, 1);
    put(bytes, data_type, 1);
    bytes += std::string(1 + 12 + 4, '\0');
    put(bytes, time_ns, 8);
    for (const LivoxPoint& point : points) {
        for (const int value : {point.x, point.y, point.z}) put(bytes, value, size);
        put(bytes, point.reflectivity, 1);
        put(bytes, point.tag, 1);
    }
    return bytes;
}

std::string livoxPacketOfWall(int number, std::int64_t time_ns) {
    std::mt19937 random(static_cast<unsigned>(number));
    std::vector<LivoxPoint> points;
    for (int i = 0; i < kLivoxPoints; ++i) {
        const double azimuth_rad = radians(static_cast<double>(random() % 3600) / 10 - 180);
        const double elevation_rad = radians(static_cast<double>(random() % 590) / 10 - 7);
        const double x = std::cos(azimuth_rad) * std::cos(elevation_rad);
        const double y = std::sin(azimuth_rad) * std::cos(elevation_rad);
        const double z = std::sin(elevation_rad);
        double range_m = z < 0 ? 2 / -z : 0;
        const double wall_m = x > 0.1 ? 6 / x : 1e9;
        if (wall_m * z < 4 && (range_m == 0 || wall_m < range_m) && wall_m < 40) range_m = wall_m;
        if (range_m > 60) range_m = 0;
        const auto mm = [&](double c) { return static_cast<int>(std::lround(1000 * range_m * c)); };
        points.push_back({mm(x), mm(y), mm(z), 100});
    }
    return livoxPacket(points, time_ns, number);
}

std::string lvx2Of(const std::vector<std::string>& packets) {
    const auto little = [](std::uint64_t value, int size) {
        std::string bytes;
        put(bytes, static_cast<std::int64_t>(value), size);
        return bytes;
    };
    std::string file = "livox_tech" + std::string(6, '\0') + std::string("\2\0\0\0", 4) +
                       little(0xac0ea767, 4) + little(50, 4) + '\1' + std::string(63, 's');
    for (std::size_t first = 0; first < packets.size(); first += 5) {
        std::string frame;
        for (std::size_t i = first; i < std::min(first + 5, packets.size()); ++i) {
            const std::string& packet = packets[i];
            frame += '\0' + std::string("\xc0\xa8\x01\x0c", 4) + std::string(2, '\0') +
                     packet.substr(28, 8) + packet.substr(7, 2) + packet[10] +
                     little(packet.size() - 36, 4) + std::string(5, '\0') + packet.substr(36);
        }
        file += little(file.size(), 8) + little(file.size() + 24 + frame.size(), 8) +
                little(first / 5, 8) + frame;
    }
    return file;
}

}  // namespace hagen::test
