#include "sensors/LidarFamily.h"

#include "sensors/livox/LivoxPacket.h"

namespace hagen::sensors {

const std::vector<LidarFamily>& lidarFamilies() {
    static const std::vector<LidarFamily> families{
        {"Mid-360", "a Livox",
         [](const Datagram& datagram) { return livoxPacketOf(datagram).has_value(); },
         makeLivoxDriver, makeLivoxSweeps}};
    return families;
}

}  // namespace hagen::sensors
