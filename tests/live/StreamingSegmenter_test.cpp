#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/live/StreamingSegmenter.h>
#include <hagen/scan/Angle.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "support/PointScan.h"
#include "support/Program.h"
#include "support/SimpleScene.h"

namespace hagen::live {
namespace {

using testing::HasSubstr;

constexpr int kColumns = 870, kPacketsOfTurn = 75;

/// Flat ground with a pole and a wall.
test::SimpleScene sceneWithPole() {
    return test::sceneOf({{{-12, -6, 0}, {-11, 6, 4}}}, {{8, 3, 0.2, 6}});
}

/// The returns of each packet of a turn, clockwise from behind, as a sensor sends them.
std::vector<Scan> packetsOf(const test::LabelledScan& turn, std::vector<Label>* truth = nullptr) {
    std::vector<Scan> packets(kPacketsOfTurn);
    std::vector<std::vector<Label>> labels(kPacketsOfTurn);
    for (std::size_t i = 0; i < turn.scan.size(); ++i) {
        const double clockwise_rad = kPi - static_cast<double>(turn.scan.azimuth_rad[i]);
        const int packet = std::min(static_cast<int>(clockwise_rad / kTurn_rad * kPacketsOfTurn),
                                    kPacketsOfTurn - 1);
        Scan& scan = packets[packet];
        scan.x_m.push_back(turn.scan.x_m[i]);
        scan.y_m.push_back(turn.scan.y_m[i]);
        scan.z_m.push_back(turn.scan.z_m[i]);
        scan.intensity.push_back(0.5f);
        scan.range_m.push_back(turn.scan.range_m[i]);
        scan.azimuth_rad.push_back(turn.scan.azimuth_rad[i]);
        scan.row.push_back(turn.scan.row[i]);
        labels[packet].push_back(turn.truth[i]);
    }
    if (truth != nullptr) {
        for (const auto& part : labels) truth->insert(truth->end(), part.begin(), part.end());
    }
    return packets;
}

Sweep sweepOfPacket(int turn, int packet) {
    const double from_rad = kPi + turn * kTurn_rad + packet * kTurn_rad / kPacketsOfTurn;
    return {from_rad, from_rad + kTurn_rad / kPacketsOfTurn};
}

class StreamingSegmenterTest : public testing::Test {
 protected:
    struct Taken {
        std::vector<Label> label;
        Sweep sweep;
        double first_s, last_s;
        bool has_turn, is_cut;
    };

    StreamingSegmenter::Take take() {
        return [this](const LabelledSector& sector) {
            EXPECT_EQ(sector.returns.size(), sector.label.size());
            taken_.push_back({sector.label, sector.sweep.value_or(Sweep{}), sector.first_time_s,
                              sector.last_time_s, sector.has_turn, sector.is_cut});
        };
    }
    static void addTurn(int turn, const std::vector<Scan>& packets, StreamingSegmenter& segmenter,
                        int from = 0, int to = kPacketsOfTurn) {
        for (int p = from; p < to; ++p) {
            segmenter.add(packets[p], sweepOfPacket(turn, p),
                          0.1 * turn + 0.1 * p / kPacketsOfTurn);
        }
    }
    std::vector<Label> labels() const {
        std::vector<Label> all;
        for (const Taken& sector : taken_) {
            all.insert(all.end(), sector.label.begin(), sector.label.end());
        }
        return all;
    }

    const SensorModel sensor_ = sensorModel("VLP-16");
    std::vector<Taken> taken_;
};

TEST_F(StreamingSegmenterTest, StaticSensorMatchesWholeScan) {
    const auto turn = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    std::vector<Label> truth;
    const std::vector<Scan> packets = packetsOf(turn, &truth);
    HagenFilter filter(sensor_);
    Scan all;
    for (const Scan& packet : packets) {
        for (std::size_t i = 0; i < packet.size(); ++i) {
            all.x_m.push_back(packet.x_m[i]);
            all.y_m.push_back(packet.y_m[i]);
            all.z_m.push_back(packet.z_m[i]);
        }
    }
    all.intensity.resize(all.size());
    locateBeams(sensor_, all);
    const std::vector<Label> whole = filter.segment(all).returns.label;

    StreamingSegmenter segmenter(sensor_, {}, take());
    segmenter.setPose(Eigen::Isometry3d::Identity());
    addTurn(0, packets, segmenter);
    segmenter.flush();
    taken_.clear();
    addTurn(1, packets, segmenter);
    segmenter.flush();
    const std::vector<Label> streamed = labels();
    ASSERT_EQ(streamed.size(), whole.size());
    std::size_t same = 0, obstacles = 0, missed = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        same += streamed[i] == whole[i];
        obstacles += truth[i] == Label::Roi && whole[i] == Label::Roi;
        missed += truth[i] == Label::Roi && whole[i] == Label::Roi && streamed[i] != Label::Roi;
    }
    EXPECT_GT(static_cast<double>(same), 0.998 * static_cast<double>(whole.size()));
    EXPECT_GT(obstacles, 100u);
    EXPECT_EQ(missed, 0u);
}

// An obstacle of the previous turn is gone. As in the paper, the closest return counts; or the
// newest turn decides the pixels that it sees.
TEST_F(StreamingSegmenterTest, WindowKeepsOlderTurns) {
    const auto before = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    const auto now = test::scanScene(test::sceneOf({}), sensor_, kColumns, {0, 0, 2});
    const auto rowsAtPole = [&](int window_scans, bool fills_gaps) {
        Options options;
        options.window_scans = window_scans;
        options.window_fills_gaps = fills_gaps;
        std::size_t near = 0;  // pixels at the pole's range, in the sector of the pole
        StreamingSegmenter segmenter(sensor_, options, [&](const LabelledSector& sector) {
            const Image<float>& depth_m = sector.result.range_image.depth_m;
            const bool is_pole_ahead = std::any_of(
                sector.returns.azimuth_rad.begin(), sector.returns.azimuth_rad.end(),
                [](float azimuth_rad) { return std::abs(azimuth_rad - 0.3588F) < 0.01F; });
            if (!is_pole_ahead || sector.sweep->from_rad < kPi + kTurn_rad) return;
            near += static_cast<std::size_t>((depth_m > 8.2F && depth_m < 8.6F).count());
        });
        segmenter.setPose(Eigen::Isometry3d::Identity());
        addTurn(0, packetsOf(before), segmenter);
        addTurn(1, packetsOf(now), segmenter);
        segmenter.flush();
        return near;
    };
    const std::size_t alone = rowsAtPole(1, true), closest = rowsAtPole(2, false);
    EXPECT_GT(closest, alone + 20);         // also in front of the ground
    EXPECT_GT(rowsAtPole(2, true), alone);  // only where nothing is behind it
    EXPECT_LT(rowsAtPole(2, true), closest);
}

TEST_F(StreamingSegmenterTest, FullContextHasEachReturnOnce) {
    const auto turn = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    const std::vector<Scan> packets = packetsOf(turn);
    StreamingOptions options;
    options.window_rad = kTurn_rad;
    options.skip_ahead_rad = 0;
    std::size_t sectors = 0, with_all = 0;
    const auto check = [&](const LabelledSector& sector) {
        if (sector.sweep->from_rad < kPi + kTurn_rad) return;  // skips the first turn
        const std::size_t returns = sector.result.range_image.depth_mapper.size();
        EXPECT_LE(returns, turn.scan.size());
        with_all += returns == turn.scan.size();
        ++sectors;
    };
    StreamingSegmenter segmenter(sensor_, {}, check, options);
    for (int k = 0; k < 2; ++k) addTurn(k, packets, segmenter);
    // Due to rounding, the packet ahead may be treated as overwritten.
    EXPECT_GT(2 * with_all, sectors);
    EXPECT_GT(sectors, 10u);
}

TEST_F(StreamingSegmenterTest, SectorEndsWithLastFittingPacket) {
    const auto turn = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    const std::vector<Scan> packets = packetsOf(turn);
    StreamingOptions options;
    options.sector_rad = radians(20.0);  // four packets of 4.8 degrees
    StreamingSegmenter segmenter(sensor_, {}, take(), options);
    addTurn(0, packets, segmenter, 0, 3);
    EXPECT_TRUE(taken_.empty());
    addTurn(0, packets, segmenter, 3, 4);
    ASSERT_EQ(taken_.size(), 1u);
    EXPECT_NEAR(taken_[0].sweep.from_rad, kPi, 1e-9);
    EXPECT_NEAR(taken_[0].sweep.to_rad, kPi + radians(19.2), 1e-9);
    EXPECT_NEAR(taken_[0].last_s - taken_[0].first_s, 0.3 / kPacketsOfTurn, 1e-9);
    EXPECT_FALSE(taken_[0].has_turn);
    EXPECT_FALSE(taken_[0].is_cut);
    std::size_t returns = 0;
    for (int p = 0; p < 4; ++p) returns += packets[p].size();
    EXPECT_EQ(taken_[0].label.size(), returns);
}

TEST_F(StreamingSegmenterTest, LabelsEachReturnOnce) {
    const auto turn = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    const std::vector<Scan> packets = packetsOf(turn);
    StreamingSegmenter segmenter(sensor_, {}, take());
    for (int k = 0; k < 3; ++k) addTurn(k, packets, segmenter);
    addTurn(3, packets, segmenter, 0, 2);
    segmenter.flush();
    segmenter.flush();  // no returns are left
    EXPECT_EQ(labels().size(), 3 * turn.scan.size() + packets[0].size() + packets[1].size());
    EXPECT_EQ(segmenter.sectors(), taken_.size());
    EXPECT_TRUE(taken_.back().has_turn);
    EXPECT_TRUE(taken_.back().is_cut);
}

TEST_F(StreamingSegmenterTest, NoGroundBeforeHalfTurn) {
    const test::SimpleScene ground;
    const auto turn = test::scanScene(ground, sensor_, kColumns, {0, 0, 2});
    const std::vector<Scan> packets = packetsOf(turn);
    StreamingSegmenter segmenter(sensor_, {}, take());
    addTurn(0, packets, segmenter);
    for (const Taken& sector : taken_) {
        const double known_rad = sector.sweep.to_rad - kPi;
        const auto rou = std::count(sector.label.begin(), sector.label.end(), Label::Rou);
        const auto roi = std::count(sector.label.begin(), sector.label.end(), Label::Roi);
        if (known_rad < kPi - 0.02) {
            EXPECT_GT(roi, 50) << known_rad;
            EXPECT_LT(rou, roi) << known_rad;  // ROU returns are beyond the zone
        } else {
            EXPECT_EQ(roi, 0) << known_rad;
        }
    }
}

TEST_F(StreamingSegmenterTest, FirstTurnMissesNoObstacle) {
    std::vector<Label> truth;
    const auto turn = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    const std::vector<Scan> packets = packetsOf(turn, &truth);
    StreamingSegmenter segmenter(sensor_, {}, take());
    addTurn(0, packets, segmenter);
    segmenter.flush();
    const std::vector<Label> streamed = labels();
    ASSERT_EQ(streamed.size(), truth.size());
    std::size_t at = 0, missed = 0;
    for (const Scan& packet : packets) {
        for (std::size_t i = 0; i < packet.size(); ++i, ++at) {
            // Obstacles above the filter's height tolerance.
            const bool is_obstacle = truth[at] == Label::Roi && packet.z_m[i] > -1.5f;
            missed += is_obstacle && streamed[at] != Label::Roi;
        }
    }
    EXPECT_EQ(missed, 0u);
}

TEST_F(StreamingSegmenterTest, ReplacesOldReturns) {
    test::SimpleScene before = sceneWithPole(), after;
    before.poles.push_back({3, 0, 0.5, 6});
    const auto first = test::scanScene(before, sensor_, kColumns, {0, 0, 2});
    const auto second = test::scanScene(after, sensor_, kColumns, {0, 0, 2});
    StreamingSegmenter segmenter(sensor_, {}, take());
    const auto roiOfTurn = [&](int turn, const test::LabelledScan& scan) {
        taken_.clear();
        addTurn(turn, packetsOf(scan), segmenter);
        segmenter.flush();
        std::size_t roi = 0;
        for (const Label label : labels()) roi += label == Label::Roi;
        return roi;
    };
    roiOfTurn(0, first);
    EXPECT_GT(roiOfTurn(1, first), 400u);
    EXPECT_EQ(roiOfTurn(2, second), 0u);
}

TEST_F(StreamingSegmenterTest, ContextFollowsTilt) {
    // The nose goes down by 3 degrees between two turns.
    const test::SimpleScene scene = sceneWithPole();
    const auto level = test::scanScene(scene, sensor_, kColumns, {0, 0, 2});
    const Attitude tilt{0, static_cast<float>(radians(3.0))};
    // The returns of a tilted sensor, in the sensor frame.
    test::LabelledScan tilted;
    const Eigen::Matrix3d turn = levelFromSensor(tilt).cast<double>();
    for (int column = 0; column < kColumns; ++column) {
        for (int row = 0; row < sensor_.rows(); ++row) {
            const auto elevation_rad = static_cast<double>(sensor_.elevations_rad[row]);
            const double azimuth_rad = kPi - (column + 0.5) * kTurn_rad / kColumns;
            const Eigen::Vector3d ray = test::directionOf(azimuth_rad, elevation_rad);
            const auto hit = test::castRay(scene, {0, 0, 2}, turn * ray);
            if (!(hit.range_m < 100)) continue;
            const Eigen::Vector3f at = (hit.range_m * ray).cast<float>();
            tilted.scan.x_m.push_back(at.x());
            tilted.scan.y_m.push_back(at.y());
            tilted.scan.z_m.push_back(at.z());
            tilted.truth.push_back(hit.label);
        }
    }
    tilted.scan.intensity.resize(tilted.scan.size());
    locateBeams(sensor_, tilted.scan);
    std::optional<Attitude> mount;
    const auto errorsWith = [&](bool knows_tilt, double skip_ahead_rad,
                                bool motion_from_ground = false) {
        taken_.clear();
        StreamingOptions options;
        options.skip_ahead_rad = skip_ahead_rad;
        options.estimate_motion_from_ground = motion_from_ground;
        StreamingSegmenter segmenter(sensor_, {}, take(), options);
        segmenter.setMount(mount);
        if (knows_tilt) segmenter.setAttitude(Attitude{});
        addTurn(0, packetsOf(level), segmenter);
        segmenter.flush();
        taken_.clear();
        if (knows_tilt) segmenter.setAttitude(tilt);
        std::vector<Label> truth;
        addTurn(1, packetsOf(tilted, &truth), segmenter);
        segmenter.flush();
        const std::vector<Label> streamed = labels();
        EXPECT_EQ(streamed.size(), truth.size());
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            wrong += streamed[i] == Label::Roi && truth[i] == Label::Rou;
        }
        return wrong;
    };
    const std::size_t with_tilt = errorsWith(true, 0), without_tilt = errorsWith(false, 0);
    EXPECT_GT(without_tilt, 50u);
    EXPECT_LT(4 * with_tilt, without_tilt);
    // Omitting the oldest returns beside the sector reduces the errors of an unknown tilt.
    EXPECT_LT(errorsWith(false, radians(30.0)), without_tilt);
    // Motion is estimated from the first sectors that contain ground.
    EXPECT_LT(4 * errorsWith(false, 0, true), without_tilt);
    // A mount provides a tilt, but the vehicle need not stay level.
    mount = Attitude{};
    EXPECT_GT(errorsWith(false, 0), 50u);
    EXPECT_LT(2 * errorsWith(false, radians(30.0)), errorsWith(false, 0));
}

TEST_F(StreamingSegmenterTest, RestartClearsState) {
    // The ground seems to fall by 0.2 m per turn, then stays.
    const test::SimpleScene scene = sceneWithPole();
    const auto packetsAt = [&](double height_m) {
        return packetsOf(test::scanScene(scene, sensor_, kColumns, {0, 0, height_m}));
    };
    const std::vector<Scan> latest = packetsAt(1.4);
    const auto labelsOfLatest = [&](StreamingSegmenter& segmenter) {
        taken_.clear();
        addTurn(3, latest, segmenter);
        addTurn(4, latest, segmenter, 0, kPacketsOfTurn / 2);
        segmenter.flush();
        return labels();
    };
    StreamingSegmenter fresh(sensor_, {}, take());
    const std::vector<Label> expected = labelsOfLatest(fresh);
    StreamingSegmenter restarted(sensor_, {}, take());
    for (int k = 0; k < 3; ++k) addTurn(k, packetsAt(2 - 0.2 * k), restarted);
    restarted.restart();
    EXPECT_EQ(labelsOfLatest(restarted), expected);
}

TEST_F(StreamingSegmenterTest, RejectsReturnsWithoutAzimuth) {
    StreamingSegmenter segmenter(sensor_, {}, take());
    Scan packet = packetsOf(test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2}))[0];
    for (const float azimuth_rad : {std::nanf(""), 8.0F}) {
        packet.azimuth_rad.back() = azimuth_rad;
        EXPECT_THROW(segmenter.add(packet, sweepOfPacket(0, 0), 0), std::invalid_argument);
    }
}

TEST_F(StreamingSegmenterTest, RejectsInvalidSweepsAndTimes) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const auto turn = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    const std::vector<Scan> packets = packetsOf(turn);
    StreamingSegmenter segmenter(sensor_, {}, take());
    addTurn(0, packets, segmenter, 0, 10);
    for (const Sweep& sweep :
         {Sweep{kNan, 1}, Sweep{0, kNan}, Sweep{0, kInfinity}, Sweep{-kInfinity, 0}, Sweep{4, 3.9},
          Sweep{0, 7}, Sweep{1e15, 1e15}}) {
        EXPECT_THROW(segmenter.add(packets[10], sweep, 0.01), std::invalid_argument);
    }
    for (const double time_s : {kNan, kInfinity, -1e300}) {
        EXPECT_THROW(segmenter.add(packets[10], sweepOfPacket(0, 10), time_s),
                     std::invalid_argument);
        EXPECT_THROW(segmenter.addFrame(packets[10], time_s), std::invalid_argument);
        EXPECT_THROW(segmenter.addFrame(packets[10], 1, 1, time_s), std::invalid_argument);
    }
    addTurn(0, packets, segmenter, 10, kPacketsOfTurn);
    segmenter.flush();
    EXPECT_EQ(labels().size(), turn.scan.size());
}

TEST_F(StreamingSegmenterTest, NonFiniteMotionIsUnknown) {
    const auto turn = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    const std::vector<Scan> packets = packetsOf(turn);
    const auto labelsAfter = [&](auto set) {
        taken_.clear();
        StreamingSegmenter segmenter(sensor_, {}, take());
        for (int k = 0; k < 3; ++k) {
            set(segmenter);
            addTurn(k, packets, segmenter);
        }
        return labels();
    };
    const auto unknown = labelsAfter([](StreamingSegmenter&) {});
    const float nan = std::nanf("");
    EXPECT_EQ(unknown, labelsAfter([&](auto& s) { s.setAttitude(Attitude{nan, 0}); }));
    EXPECT_EQ(unknown, labelsAfter([&](auto& s) { s.setMount(Attitude{0, nan}); }));
    EXPECT_EQ(unknown, labelsAfter([&](auto& s) {
                  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
                  pose.translation().z() = std::numeric_limits<double>::infinity();
                  s.setPose(pose);
              }));
}

/// In any posture, context whose coordinates exceed float is dropped.
TEST_F(StreamingSegmenterTest, HugeMotionLosesNoReturn) {
    const auto turn = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    const std::vector<Scan> packets = packetsOf(turn);
    for (const float roll_rad : {0.0F, 0.7F, 3.1F}) {
        taken_.clear();
        StreamingSegmenter segmenter(sensor_, {}, take());
        segmenter.setAttitude(Attitude{roll_rad, 0});
        for (int k = 0; k < 4; ++k) {
            Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
            pose.translation().x() = k % 2 == 0 ? 0 : 1e39;
            segmenter.setPose(pose);
            addTurn(k, packets, segmenter);
            segmenter.addFrame(packets[0], 0.1 * k + 0.1);
        }
        segmenter.flush();
        EXPECT_EQ(labels().size(), 4 * (turn.scan.size() + packets[0].size()));
    }
}

/// The packets are many turns late.
TEST_F(StreamingSegmenterTest, LabelsMultiTurnSector) {
    const auto turn = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    const std::vector<Scan> packets = packetsOf(turn);
    StreamingSegmenter segmenter(sensor_, {}, take());
    addTurn(0, packets, segmenter);
    segmenter.add(packets[0], {-1e11, -1e11}, 0.1);
    segmenter.flush();
    EXPECT_EQ(labels().size(), turn.scan.size() + packets[0].size());
}

/// Thin plants: every fifth column alone hits few tops, but sectors keep the earlier heights.
TEST_F(StreamingSegmenterTest, CropsAreCanopyInSectors) {
    test::SimpleScene crops;
    for (int i = -14; i <= 14; ++i) {
        for (int j = -14; j <= 14; ++j) {
            crops.poles.push_back({1.2 * i + 0.05 * j, 1.2 * j, 0.05, 0.7});
        }
    }
    const auto turn = test::scanScene(crops, sensor_, kColumns, {0, 0, 2});
    HagenFilter filter(sensor_);
    const auto roiOf = [](const std::vector<Label>& labels) {
        return std::count(labels.begin(), labels.end(), Label::Roi);
    };
    ASSERT_EQ(roiOf(filter.segment(turn.scan).returns.label), 0);
    const std::vector<Scan> packets = packetsOf(turn);
    StreamingSegmenter segmenter(sensor_, {}, take());
    for (int k = 0; k < 2; ++k) addTurn(k, packets, segmenter);
    segmenter.flush();
    taken_.clear();
    addTurn(2, packets, segmenter);
    segmenter.flush();
    EXPECT_EQ(roiOf(labels()), 0);
}

TEST_F(StreamingSegmenterTest, SilenceEndsContext) {
    const auto turn = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    const std::vector<Scan> packets = packetsOf(turn);
    StreamingSegmenter segmenter(sensor_, {}, take());
    addTurn(0, packets, segmenter);
    addTurn(1, packets, segmenter);
    EXPECT_TRUE(taken_.back().has_turn);
    addTurn(20, packets, segmenter, 0, 11);
    EXPECT_FALSE(taken_.back().has_turn);
    segmenter.restart();
    EXPECT_TRUE(taken_.back().is_cut);
}

TEST_F(StreamingSegmenterTest, LabelsStalledSensor) {
    const auto turn = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    const Scan packet = packetsOf(turn)[3];
    StreamingSegmenter segmenter(sensor_, {}, take());
    for (int i = 0; i < 1000; ++i) segmenter.add(packet, {1, 1}, 1e-3 * i);
    EXPECT_GE(taken_.size(), 15u);
    for (const Taken& sector : taken_) EXPECT_LE(sector.last_s - sector.first_s, 0.06);
}

TEST_F(StreamingSegmenterTest, FramesUseEarlierFrames) {
    const auto turn = test::scanScene(sceneWithPole(), sensor_, kColumns, {0, 0, 2});
    const std::vector<Scan> packets = packetsOf(turn);
    StreamingSegmenter segmenter(sensor_, {}, take());
    for (int k = 0; k < 5; ++k) {
        // Every fifth packet forms a frame in all directions.
        Scan frame;
        for (int p = k; p < kPacketsOfTurn; p += 5) {
            const Scan& part = packets[p];
            for (std::size_t i = 0; i < part.size(); ++i) {
                frame.x_m.push_back(part.x_m[i]);
                frame.y_m.push_back(part.y_m[i]);
                frame.z_m.push_back(part.z_m[i]);
            }
        }
        frame.intensity.resize(frame.size());
        locateBeams(sensor_, frame);
        segmenter.addFrame(frame, 0.02 * k);
        EXPECT_EQ(taken_.size(), static_cast<std::size_t>(k + 1));
        EXPECT_EQ(taken_.back().label.size(), frame.size());
        EXPECT_EQ(taken_.back().has_turn, k > 0);
    }
}

TEST_F(StreamingSegmenterTest, RejectsInvalidOptionsAndScans) {
    const auto messageWith = [&](auto change) {
        StreamingOptions options;
        change(options);
        return test::messageOf<std::invalid_argument>(
            [&] { const StreamingSegmenter segmenter(sensor_, {}, take(), options); });
    };
    EXPECT_THAT(messageWith([](auto& o) { o.sector_rad = 0; }), HasSubstr("sector_rad"));
    EXPECT_THAT(messageWith([](auto& o) { o.window_rad = -1; }), HasSubstr("window_rad"));
    EXPECT_THAT(messageWith([](auto& o) { o.keep_every = -1; }), HasSubstr("keep_every"));
    EXPECT_THAT(messageWith([](auto& o) { o.skip_ahead_rad = kPi; }), HasSubstr("skip_ahead_rad"));
    EXPECT_THAT(messageWith([](auto& o) { o.skip_ahead_moved_rad = -0.1; }),
                HasSubstr("skip_ahead_moved_rad"));
    EXPECT_THAT(messageWith([](auto& o) { o.context_s = 0; }), HasSubstr("context_s"));
    EXPECT_EQ(messageWith([](auto&) {}), "");
    StreamingSegmenter segmenter(sensor_, {}, take());
    Scan unlocated;
    unlocated.x_m = unlocated.y_m = unlocated.z_m = {1};
    EXPECT_THROW(segmenter.add(unlocated, {0, 0.1}, 0), std::invalid_argument);
    EXPECT_TRUE(taken_.empty());
}

}  // namespace
}  // namespace hagen::live
