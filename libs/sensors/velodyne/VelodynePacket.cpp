#include <hagen/sensors/VelodynePacket.h>

#include <algorithm>
#include <iterator>

#include "sensors/LittleEndian.h"

namespace hagen::sensors {

int bankOf(const std::uint8_t* packet, int block) {
    const unsigned header = little<std::uint16_t>(packet + block * kVelodyneBlockBytes);
    const auto* const found = std::find(std::begin(kBankHeaders), std::end(kBankHeaders), header);
    return found == std::end(kBankHeaders) ? -1 : static_cast<int>(found - kBankHeaders);
}

double VelodynePacket::sensorTimeUs() const {
    return little<std::uint32_t>(bytes.data() + kVelodyneTimeAt);
}

bool VelodynePacket::isDual() const {
    return !isOfHdl64(bytes.data()) && bytes[kVelodyneModeAt] == kDualReturn;
}

int VelodynePacket::azimuthOf(int block) const {
    const int azimuth = little<std::uint16_t>(bytes.data() + block * kVelodyneBlockBytes + 2);
    const int bank = bankOf(bytes.data(), block);
    const VelodyneModel* const model = bank > 0 ? velodyneModelOf(bytes.data()) : nullptr;
    const bool is_block = bank == 0 || (model != nullptr && bank < model->banks());
    return is_block && azimuth < kReadingsOfTurn ? azimuth : -1;
}

int VelodynePacket::azimuth() const {
    for (int block = 0; block < kVelodyneBlocks; ++block) {
        if (bankOf(bytes.data(), block) == 0 && azimuthOf(block) >= 0) return azimuthOf(block);
    }
    return -1;
}

bool isVelodyneData(const std::uint8_t* bytes, std::size_t size) {
    if (size != kVelodynePacketBytes) return false;
    for (int block = 0; block < kVelodyneBlocks; ++block) {
        if (bankOf(bytes, block) >= 0) return true;
    }
    return false;
}

bool isOfHdl64(const std::uint8_t* packet) {
    int highest = -1;
    for (int block = 0; block < kVelodyneBlocks; ++block) {
        highest = std::max(highest, bankOf(packet, block));
    }
    return highest == 1;
}

const VelodyneModel* velodyneModelOf(const std::uint8_t* packet) {
    return isOfHdl64(packet) ? &hdl64Model() : findVelodyneModel(packet[kVelodyneModelAt]);
}

}  // namespace hagen::sensors
