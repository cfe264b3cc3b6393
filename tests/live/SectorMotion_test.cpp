#include <gtest/gtest.h>
#include <hagen/live/SectorDistances.h>
#include <hagen/live/StreamingSegmenter.h>
#include <hagen/scan/Angle.h>

#include <algorithm>

#include "support/SimpleScene.h"

namespace hagen::live {
namespace {

constexpr int kPacketsPerSweep = 75;

/// The packets of a turn over flat ground with a pole and a wall.
std::vector<Scan> packetsOfATurn(const SensorModel& sensor) {
    const test::SimpleScene scene = test::sceneOf({{{-12, -6, 0}, {-11, 6, 4}}}, {{8, 3, 0.2, 6}});
    const Scan turn = test::scanScene(scene, sensor, 870, {0, 0, 2}).scan;
    std::vector<Scan> packets(kPacketsPerSweep);
    for (std::size_t i = 0; i < turn.size(); ++i) {
        const double clockwise_rad = kPi - static_cast<double>(turn.azimuth_rad[i]);
        const int p = std::min(static_cast<int>(clockwise_rad / kTurn_rad * kPacketsPerSweep),
                               kPacketsPerSweep - 1);
        packets[p].x_m.push_back(turn.x_m[i]);
        packets[p].y_m.push_back(turn.y_m[i]);
        packets[p].z_m.push_back(turn.z_m[i]);
    }
    for (Scan& packet : packets) locateBeams(sensor, packet);
    return packets;
}

Sweep sweepOf(int turn, int packet) {
    const double from_rad = kPi + turn * kTurn_rad + packet * kTurn_rad / kPacketsPerSweep;
    return {from_rad, from_rad + kTurn_rad / kPacketsPerSweep};
}

TEST(SectorPackets, LostPacketLeavesGap) {
    const SensorModel sensor = sensorModel("VLP-16");
    const auto packets = packetsOfATurn(sensor);
    double covered_rad = 0, swept_rad = 0;
    StreamingSegmenter segmenter(sensor, {}, [&](const LabelledSector& sector) {
        ASSERT_NE(sector.packets, nullptr);
        for (const Sweep& packet : *sector.packets) {
            EXPECT_GE(packet.from_rad, sector.sweep->from_rad - 1e-9);
            EXPECT_LE(packet.to_rad, sector.sweep->to_rad + 1e-9);
            covered_rad += packet.to_rad - packet.from_rad;
        }
        swept_rad += sector.sweep->to_rad - sector.sweep->from_rad;
    });
    for (int p = 0; p < kPacketsPerSweep; ++p) {
        if (p != 13) segmenter.add(packets[p], sweepOf(0, p), 0.1 * p / kPacketsPerSweep);
    }
    segmenter.flush();
    EXPECT_NEAR(swept_rad, kTurn_rad, 1e-6);
    EXPECT_NEAR(covered_rad, kTurn_rad * (kPacketsPerSweep - 1) / kPacketsPerSweep, 1e-6);
}

TEST(SectorPackets, LostSweepIsNotFree) {
    const SensorModel sensor = sensorModel("VLP-16");
    SectorDistances distances(sensor);
    Scan none;
    SegmentationResult result;
    // Five packets form a sector of 25 degrees, clockwise from ahead; the middle packet is missing.
    std::vector<Sweep> packets;
    for (const int p : {0, 1, 3, 4}) packets.push_back({radians(5.0 * p), radians(5.0 * (p + 1))});
    distances.take(
        {none, {}, Sweep{0, radians(25.0)}, 1, 1.01, true, false, false, result, &packets});
    const auto at = distances.at(1.02);
    using State = SectorDistances::State;
    EXPECT_EQ(at[1].state, State::SeenNothing);
    EXPECT_EQ(at[2].state, State::Unknown);
    EXPECT_EQ(at[3].state, State::SeenNothing);
    EXPECT_EQ(at[5].state, State::Unknown);
}

/// The labels of a second turn with a known tilt; the first turn may have a pose.
std::vector<Label> labelsAfter(const std::optional<Eigen::Isometry3d>& first) {
    const SensorModel sensor = sensorModel("VLP-16");
    const auto packets = packetsOfATurn(sensor);
    std::vector<Label> labels;
    bool is_second = false;
    StreamingSegmenter segmenter(sensor, {}, [&](const LabelledSector& sector) {
        if (is_second) labels.insert(labels.end(), sector.label.begin(), sector.label.end());
    });
    segmenter.setPose(first);
    for (int turn = 0; turn < 2; ++turn) {
        for (int p = 0; p < kPacketsPerSweep; ++p) {
            segmenter.add(packets[p], sweepOf(turn, p), 0.1 * turn + 0.1 * p / kPacketsPerSweep);
        }
        segmenter.flush();
        segmenter.setPose({});
        segmenter.setAttitude(Attitude{});
        is_second = true;
    }
    return labels;
}

TEST(SectorMotion, LostPositionCausesNoMotion) {
    Eigen::Isometry3d far_away = Eigen::Isometry3d::Identity();
    far_away.translation() = Eigen::Vector3d(100, -20, 5);
    far_away.linear() = Eigen::AngleAxisd(2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const auto labels = labelsAfter(far_away);
    EXPECT_GT(labels.size(), 5000u);
    EXPECT_EQ(labels, labelsAfter({}));
}

}  // namespace
}  // namespace hagen::live
