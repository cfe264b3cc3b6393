// Writes recordings for the documented commands, based on rawlogs/: make-recordings RAWLOG FOLDER
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/RawlogReader.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cmath>
#include <cstdio>
#include <exception>

#include "support/BagWriter.h"
#include "support/Hdl64.h"
#include "support/LivoxPackets.h"

namespace {

using namespace hagen;

namespace fs = std::filesystem;

std::vector<float> xyziOf(const mrpt::obs::CObservationVelodyneScan& scan) {
    observations::ObservedScan observed;
    observations::readObservation(scan, {}, observed);
    const Scan& s = observed.scan;
    std::vector<float> xyzi;
    for (std::size_t i = 0; i < s.size(); ++i) {
        xyzi.insert(xyzi.end(), {s.x_m[i], s.y_m[i], s.z_m[i], s.intensity[i]});
    }
    return xyzi;
}

void writeVelodyne(const fs::path& rawlog, const fs::path& folder) {
    test::CaptureWriter capture;
    std::vector<test::SentMessage> messages;
    recordings::RawlogReader reader(rawlog);
    while (const auto entry = reader.next()) {
        const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservationVelodyneScan>(entry);
        if (!scan) continue;
        const double time_s = mrpt::Clock::toDouble(scan->timestamp);
        capture.packets(*scan, time_s, 1.3e-3);
        messages.push_back(
            test::cloudMessage("/velodyne_points", time_s, "velodyne", xyziOf(*scan)));
    }
    capture.write(folder / "flight.pcap");
    test::writeBytes(folder / "flight.bag", test::ros1BagOf(messages));
    test::writeBytes(folder / "flight.mcap", test::mcapOf(messages));
    test::writeDb3(folder / "flight.db3", messages);
}

/// Flat ground 1.7 m below the sensor, and a surrounding wall 15 m away.
void writeHdl64(const fs::path& folder) {
    const auto lasers = test::hdl64Lasers();
    const auto packets = test::hdl64Packets(2 * 2000, [&](int laser, double azimuth_deg) {
        const auto direction = lasers[static_cast<std::size_t>(laser)].direction(azimuth_deg);
        const double wall_m = 15 / std::hypot(direction.x(), direction.y());
        return direction.z() < 0 ? std::min(wall_m, -1.7 / direction.z()) : wall_m;
    });
    test::CaptureWriter().datagrams(packets, 288e-6).write(folder / "hdl64.pcap");
    test::writeBytes(folder / "db.xml", test::hdl64Xml(lasers));
}

/// Flat ground 2 m below the sensor, and a wall 6 m away, for 0.5 s.
void writeLivox(const fs::path& folder) {
    std::vector<std::string> packets;
    for (int number = 0; number < 1000; ++number) {
        packets.push_back(test::livoxPacketOfWall(number, 500000 * std::int64_t{number}));
    }
    test::CaptureWriter().datagrams(packets, 5e-4, 56301).write(folder / "livox.pcap");
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 3) {
        std::fprintf(stderr, "usage: make-recordings RAWLOG FOLDER\n");
        return 2;
    }
    writeVelodyne(argv[1], argv[2]);
    writeHdl64(argv[2]);
    writeLivox(argv[2]);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
