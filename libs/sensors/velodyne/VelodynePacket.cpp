#include <hagen/sensors/VelodynePacket.h>

namespace hagen::sensors {
namespace {

unsigned headerOf(const std::uint8_t* packet, int block) {
    const std::uint8_t* const at = packet + block * kVelodyneBlockBytes;
    return at[0] | unsigned{at[1]} << 8;
}

}  // namespace

double VelodynePacket::sensorTimeUs() const {
    const std::uint8_t* const at = bytes.data() + kVelodyneTimeAt;
    return static_cast<double>(at[0] | std::uint32_t{at[1]} << 8 | std::uint32_t{at[2]} << 16 |
                               std::uint32_t{at[3]} << 24);
}

bool VelodynePacket::isDual() const {
    return !isOfHdl64(bytes.data()) && bytes[kVelodyneModeAt] == kDualReturn;
}

int VelodynePacket::azimuthOf(int block) const {
    const std::uint8_t* const at = bytes.data() + block * kVelodyneBlockBytes;
    const int azimuth = at[2] | at[3] << 8;
    const unsigned header = headerOf(bytes.data(), block);
    const bool is_block = header == kUpperBlock || header == kLowerBlock;
    return is_block && azimuth < kReadingsOfTurn ? azimuth : -1;
}

int VelodynePacket::azimuth() const {
    for (int block = 0; block < kVelodyneBlocks; ++block) {
        const bool is_upper = headerOf(bytes.data(), block) == kUpperBlock;
        if (is_upper && azimuthOf(block) >= 0) return azimuthOf(block);
    }
    return -1;
}

bool isVelodyneData(const std::uint8_t* bytes, std::size_t size) {
    if (size != kVelodynePacketBytes) return false;
    for (int block = 0; block < kVelodyneBlocks; ++block) {
        const unsigned header = headerOf(bytes, block);
        if (header == kUpperBlock || header == kLowerBlock) return true;
    }
    return false;
}

bool isOfHdl64(const std::uint8_t* packet) {
    for (int block = 0; block < kVelodyneBlocks; ++block) {
        if (headerOf(packet, block) == kLowerBlock) return true;
    }
    return false;
}

}  // namespace hagen::sensors
