#include "sensors/LidarFamily.h"

#include "sensors/hesai/HesaiPacket.h"
#include "sensors/livox/LivoxPacket.h"

namespace hagen::sensors {
namespace {

bool isHesai(const Datagram& datagram) { return hesaiPacketOf(datagram).has_value(); }

}  // namespace

const std::vector<LidarFamily>& lidarFamilies() {
    static const std::vector<LidarFamily> families{
        {"Mid-360", "a Livox",
         [](const Datagram& datagram) { return livoxPacketOf(datagram).has_value(); },
         makeLivoxDriver, makeLivoxSweeps},
        {"XT32", "a Hesai", isHesai, [] { return makeHesaiDriver("XT32"); }, makeHesaiSweeps},
        {"XT16", "a Hesai", isHesai, [] { return makeHesaiDriver("XT16"); }, makeHesaiSweeps}};
    return families;
}

}  // namespace hagen::sensors
