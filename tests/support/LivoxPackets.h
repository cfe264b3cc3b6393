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

/// A packet as Livox SDK 2 defines it: points in millimetres (1) or centimetres (2), 5 us apart.
std::string livoxPacket(const std::vector<LivoxPoint>& points, std::int64_t time_ns, int number,
                        int data_type = 1);

/// A packet of points all around, 2 m above flat ground with a wall at x = 6 m.
std::string livoxPacketOfWall(int number, std::int64_t time_ns);

/// Period of such packets: 96 points at 200 kHz.
constexpr std::int64_t kLivoxPacket_ns = 480000;
constexpr int kLivoxPoints = 96;

}  // namespace hagen::test
