// Ouster packets with arbitrary content. The first byte of the input selects the profile.
#include <hagen/mrpt/ObservationScan.h>
#include "recordings/SweepObservation.h"
#include "sensors/ouster/OusterScan.h"

#include "fuzz/Target.h"
#include "support/OusterPackets.h"

namespace hagen::fuzz {
namespace {

const char* const kProfiles[] = {
    "LEGACY",          "RNG19_RFL8_SIG16_NIR16", "RNG19_RFL8_SIG16_NIR16_DUAL",
    "RNG15_RFL8_NIR8", "RNG15_RFL8_NIR8_DUAL",   "FUSA_RNG15_RFL8_NIR8_DUAL",
    "FIVE_WORD_PIXEL"};

void decode(std::string_view input) {
    Parts parts(input);
    const std::string profile = kProfiles[parts.below(std::size(kProfiles))];
    const sensors::OusterSensor sensor =
        sensors::ousterSensorOf(test::ousterJson(profile), "metadata");
    sensors::OusterFrames frames(sensor);
    std::size_t complete = 0;
    const auto takeOut = [&] {
        for (; !frames.complete().empty(); frames.complete().pop_front()) {
            ++complete;
            const auto observation =
                recordings::observationOf(sweepOf(frames.complete().front(), sensor));
            observations::ObservedScan observed;
            observations::readObservation(*observation, {}, observed);
            for (const std::uint8_t row : observed.scan.row) {
                require(row < observed.sensor.rows(), "a row that the sensor has not");
            }
        }
    };
    while (!parts.isAtEnd()) {
        std::string packet(parts.take(sensor.packetBytes()));
        packet.resize(sensor.packetBytes());
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(packet.data());
        isOfLidar(bytes, sensor);
        serialOf(bytes, sensor);
        frames.add(bytes, 1000);
        takeOut();
    }
    frames.finish();
    takeOut();
    require(complete == frames.counts().frames, "a frame is lost");
    sensors::textOf(frames.counts());
}

Seeds packetSeeds() {
    Seeds seeds;
    char number = 0;
    for (const char* const profile : kProfiles) {
        const auto sensor = sensors::ousterSensorOf(test::ousterJson(profile), "metadata");
        const auto packets = test::packetsOf(sensor, test::randomFrame(sensor, 3));
        seeds.push_back(number++ + packets[0] + packets[1]);
    }
    return seeds;
}

const bool kAdded = add({"ouster_packets", decode, packetSeeds, {"\xff\xff\xff\xff"}, 8000});

}  // namespace
}  // namespace hagen::fuzz
