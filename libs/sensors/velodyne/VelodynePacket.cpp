#include <hagen/sensors/VelodynePacket.h>

#include "sensors/LittleEndian.h"

namespace hagen::sensors {
namespace {

unsigned headerOf(const std::uint8_t* packet, int block) {
    return little<std::uint16_t>(packet + block * kVelodyneBlockBytes);
}

}  // namespace

double VelodynePacket::sensorTimeUs() const {
    return little<std::uint32_t>(bytes.data() + kVelodyneTimeAt);
}

bool VelodynePacket::isDual() const {
    return !isOfHdl64(bytes.data()) && bytes[kVelodyneModeAt] == kDualReturn;
}

int VelodynePacket::azimuthOf(int block) const {
    const int azimuth = little<std::uint16_t>(bytes.data() + block * kVelodyneBlockBytes + 2);
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

const VelodyneModel* velodyneModelOf(const std::uint8_t* packet) {
    return isOfHdl64(packet) ? &hdl64Model() : findVelodyneModel(packet[kVelodyneModelAt]);
}

}  // namespace hagen::sensors
