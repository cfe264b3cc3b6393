// In a recording of a room, only floor returns may be ROU.
#include <gtest/gtest.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstring>
#include <fstream>

#include "support/Program.h"

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationVelodyneScan;

constexpr std::size_t kPacketBytes = 1206;

double azimuthOf(const CObservationVelodyneScan::TVelodyneRawPacket& packet) {
    std::uint16_t hundredths_deg;  // azimuth of the first block, after its header
    std::memcpy(&hundredths_deg, reinterpret_cast<const char*>(&packet) + 2, 2);
    return 0.01 * hundredths_deg;
}

/// The whole revolutions of a file of data packets without headers.
std::vector<CObservationVelodyneScan::Ptr> scansOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::vector<CObservationVelodyneScan::Ptr> scans;
    CObservationVelodyneScan::TVelodyneRawPacket packet;
    double before_deg = 400;
    while (stream.read(reinterpret_cast<char*>(&packet), kPacketBytes)) {
        if (azimuthOf(packet) < before_deg) {
            scans.push_back(CObservationVelodyneScan::Create());
            scans.back()->calibration =
                mrpt::obs::VelodyneCalibration::LoadDefaultCalibration("VLP16");
        }
        before_deg = azimuthOf(packet);
        scans.back()->scan_packets.push_back(packet);
    }
    if (scans.size() < 3) return {};
    return {scans.begin() + 1, scans.end() - 1};  // the first and last are incomplete
}

// Ground truth by height: the floor is 1.02 to 1.15 m below the sensor, which stands on a desk.
// Higher returns are from walls, ceiling, furniture and people.
TEST(IndoorCapture, LabelsEverythingButFloorRoi) {
    const auto folder = test::dataFolder("HAGEN_VELODYNE_DATA");
    if (folder.empty()) GTEST_SKIP() << "HAGEN_VELODYNE_DATA is not a folder of captures";
    const auto scans = scansOf(folder / "vlp16_packets_1206.bin");
    ASSERT_GE(scans.size(), 11u);
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    std::size_t others = 0, missed = 0, unclassified = 0;
    for (const auto& observation : scans) {
        ASSERT_TRUE(segmenter.process(*observation, out));
        unclassified += out.result->returns.unclassified.size();
        for (std::size_t i = 0; i < out.scan->size(); ++i) {
            if (out.scan->z_m[i] < -1.02f) continue;
            ++others;
            missed += out.result->returns.label[i] != Label::Roi;
        }
    }
    EXPECT_GT(others, 150000u);
    EXPECT_LE(missed, others / 1000);
    // A quarter of the returns are nearer than MRPT's default minimum range of 1 m.
    EXPECT_EQ(unclassified, 0u);
}

}  // namespace
}  // namespace hagen::observations
