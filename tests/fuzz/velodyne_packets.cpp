// Velodyne scans with arbitrary packets. The first byte of the input selects the calibration.
#include <hagen/mrpt/ObservationScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>

#include "fuzz/Target.h"
#include "support/CaptureWriter.h"
#include "support/SimpleFirings.h"

namespace hagen::fuzz {
namespace {

using mrpt::obs::CObservationVelodyneScan;

void decode(std::string_view input) {
    Parts parts(input);
    CObservationVelodyneScan observation;
    const char* const calibrations[] = {"VLP16", "HDL32", ""};
    const std::string calibration = calibrations[parts.below(3)];
    if (!calibration.empty()) {
        observation.calibration =
            mrpt::obs::VelodyneCalibration::LoadDefaultCalibration(calibration);
    }
    observation.minRange = parts.number<float>();
    observation.maxRange = parts.number<float>();
    while (!parts.isAtEnd()) {
        CObservationVelodyneScan::TVelodyneRawPacket packet{};
        const std::string_view bytes = parts.take(sizeof packet);
        std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(&packet));
        observation.scan_packets.push_back(packet);
    }
    observations::ObservedScan observed;
    mayRefuse([&] { observations::readObservation(observation, {}, observed); });
    const Scan& scan = observed.scan;
    for (const auto* const values : {&scan.y_m, &scan.z_m, &scan.range_m, &scan.azimuth_rad}) {
        require(values->size() == scan.size(), "arrays of a scan differ in size");
    }
    for (const std::uint8_t row : scan.row) {
        require(row < observed.sensor.rows(), "a return has a row that the sensor has not");
    }
}

Seeds packetSeeds() {
    const auto scan = test::poleScanFrom(0, "velodyne");
    Seeds seeds;
    for (const char calibration : {'\0', '\1', '\2'}) {
        for (const std::size_t first : {std::size_t{0}, scan->scan_packets.size() / 2}) {
            seeds.push_back(calibration + bytesOf(0.5f, 100.0f) +
                            test::bytesOf(scan->scan_packets[first]) +
                            test::bytesOf(scan->scan_packets[first + 1]));
        }
    }
    observations::Firings firings;
    firings.range_m.setConstant(128, 3, 5.0f);
    firings.intensity.setConstant(128, 3, 1.0f);
    for (const bool is_dual : {false, true}) {
        if (is_dual) firings.last_range_m = firings.range_m;
        seeds.push_back('\2' + bytesOf(0.5f, 100.0f));
        for (const auto& packet : test::packetsOf(sensors::velodyneModel("VLS-128"), firings)) {
            seeds.back() += packet;
        }
    }
    return seeds;
}

const bool kAdded =
    add({"velodyne_packets",
         decode,
         packetSeeds,
         {"\xff\xee", "\xff\xdd", "\xff\xcc", "\x37\x22", "\x39\x22", "\x38\x21", "\xa0\x8c"},
         4000});

}  // namespace
}  // namespace hagen::fuzz
