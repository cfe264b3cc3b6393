// Labels VLP-16 packets before the turn ends, and prints the nearest obstacle in each direction.
#include <hagen/live/LidarStream.h>
#include <hagen/live/PacketSource.h>
#include <hagen/live/SectorDistances.h>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
    using namespace hagen;
    try {
        // Called for each sector, a few milliseconds after its last packet.
        live::SectorDistances distances(sensorModel("VLP-16"));
        live::LidarStream stream(
            sensors::makeDriver("VLP-16"), {},
            [&](const live::LabelledSector& sector) { distances.take(sector); });
        // With an IMU, call stream.move() before each packet.

        live::UdpSource source(live::parseAddress(argc > 1 ? argv[1] : "0.0.0.0:2368"));
        live::Packet packet;
        for (double next_s = live::steadyNow_s();;) {
            if (source.next(packet) == live::PacketSource::Next::Packet) {
                stream.add(packet.datagram(), packet.arrival_s);
            }
            if (live::steadyNow_s() < next_s) continue;
            next_s += 0.1;
            for (const auto& s : distances.at(live::steadyNow_s())) {
                const bool is_free = s.state == live::SectorDistances::State::SeenNothing;
                if (s.state == live::SectorDistances::State::Obstacle) {
                    std::printf("%4.1f ", static_cast<double>(s.distance_m));
                } else {
                    std::printf("%4s ", is_free ? "-" : "?");
                }
            }
            std::printf("\n");
        }
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
