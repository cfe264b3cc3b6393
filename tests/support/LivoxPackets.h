#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::test {

struct LivoxPoint {
    int x, y, z;  ///< in the unit of the packet
    int reflectivity;
    int tag = 0;
};

/// A packet as defined by Livox SDK 2: points 5 us apart in millimetres (1) or centimetres (2).
std::string livoxPacket(const std::vector<LivoxPoint>& points, std::int64_t time_ns, int number,
                        int data_type = 1);

/// A packet of points all around, 2 m above flat ground, with a wall at x = 6 m.
std::string livoxPacketOfWall(int number, std::int64_t time_ns);

/// A .lvx2 file of the sensor 192.168.1.12 with these packets, five per frame.
std::string lvx2Of(const std::vector<std::string>& packets);

/// Duration of a packet: 96 points at 200 kHz.
constexpr std::int64_t kLivoxPacket_ns = 480000;
constexpr int kLivoxPoints = 96;

}  // namespace hagen::test
