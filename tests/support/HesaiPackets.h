#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::test {

/// The range that a channel measures at an azimuth in hagen's packets below.
inline double hesaiRange_m(int channel, double azimuth_deg) {
    return 5 + 0.1 * channel + 2 * std::sin(azimuth_deg * 3.14159265358979 / 180);
}

/// Packets as in the manual of the XT32 and XT16: eight blocks, 0.18 degrees and 50 us per firing.
inline std::vector<std::string> hesaiPackets(int channels, int returns, int count,
                                             int first_azimuth = 0) {
    std::vector<std::string> packets;
    const auto put = [&](std::uint64_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) {
            packets.back() += static_cast<char>(value >> (8 * i) & 0xff);
        }
    };
    for (int p = 0; p < count; ++p) {
        packets.emplace_back("\xee\xff\x06\x01\0\0", 6);
        for (const int byte : {channels, 8, 1, 4, returns, 1}) put(byte, 1);
        const int first = 8 / returns * p;  // firing
        for (int block = 0; block < 8; ++block) {
            const int azimuth = (first_azimuth + 18 * (first + block / returns)) % 36000;
            put(azimuth, 2);
            for (int channel = 0; channel < channels; ++channel) {
                put(std::lround(hesaiRange_m(channel, 0.01 * azimuth) / 0.004), 2);
                put(channel, 2);
            }
        }
        packets.back() += std::string(10, '\0');
        put(returns == 2 ? 0x39 : 0x37, 1);
        put(600, 2);
        const int time_us = 999000 + 50 * first;  // across a full hour
        for (const int byte : {126, 2, 28, 23, 59, 59 + time_us / 1000000}) put(byte, 1);
        put(time_us % 1000000, 4);
        put(0x42, 1);
        put(65530 + p, 4);  // wraps
    }
    return packets;
}

}  // namespace hagen::test
