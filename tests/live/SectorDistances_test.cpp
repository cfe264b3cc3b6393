#include <gtest/gtest.h>
#include <hagen/live/SectorDistances.h>
#include <hagen/scan/Angle.h>

#include <cmath>

namespace hagen::live {
namespace {

using State = SectorDistances::State;

double turned_deg(double rad) { return rad < 0 ? degrees(rad) + 360 : degrees(rad); }

struct Point {
    double azimuth_deg, distance_m;  ///< clockwise from ahead; horizontal distance
    Label label = Label::Roi;
    float z_m = 0;
};

class SectorDistancesTest : public testing::Test {
 protected:
    /// Adds a sector between two azimuths, in degrees clockwise from ahead.
    void take(double from_deg, double to_deg, double time_s, const std::vector<Point>& points,
              SectorDistances& distances) {
        take(Sweep{radians(from_deg), radians(to_deg)}, time_s, points, distances);
    }
    void take(const std::optional<Sweep>& sweep, double time_s, const std::vector<Point>& points,
              SectorDistances& distances) {
        Scan scan;
        std::vector<Label> labels;
        for (const Point& p : points) {
            scan.x_m.push_back(static_cast<float>(p.distance_m * std::cos(radians(p.azimuth_deg))));
            scan.y_m.push_back(
                static_cast<float>(-p.distance_m * std::sin(radians(p.azimuth_deg))));
            scan.z_m.push_back(p.z_m);
            labels.push_back(p.label);
        }
        distances.take({scan, labels, sweep, time_s, time_s + 0.005, true, false, false, result_});
    }
    /// Adds a whole turn in sectors of 20 degrees, each `turn_s / 18` after the previous one.
    void turn(int number, double turn_s, const std::vector<Point>& points,
              SectorDistances& distances) {
        for (int k = 0; k < 18; ++k) {
            std::vector<Point> of_sector;
            for (const Point& p : points) {
                if (p.azimuth_deg >= 20 * k && p.azimuth_deg < 20 * (k + 1)) of_sector.push_back(p);
            }
            take(360.0 * number + 20 * k, 360.0 * number + 20 * (k + 1),
                 turn_s * (number + k / 18.0), of_sector, distances);
        }
    }

    const SensorModel sensor_ = sensorModel("VLP-16");
    SegmentationResult result_;
};

TEST_F(SectorDistancesTest, LostPacketIsUnknown) {
    const Scan scan;
    const std::vector<Label> labels;
    const std::vector<Sweep> packets{{radians(0), radians(5)}, {radians(10), radians(15)}};
    SectorDistances distances(sensor_);
    distances.take(
        {scan, labels, Sweep{0, radians(15)}, 1, 1.01, true, false, false, result_, &packets});
    EXPECT_EQ(distances.at(1.1)[0].state, State::SeenNothing);
    EXPECT_EQ(distances.at(1.1)[1].state, State::Unknown);
    EXPECT_EQ(distances.at(1.1)[2].state, State::SeenNothing);
}

/// A packet is 1 degree wide, like those of an HDL-32E with dual returns.
TEST_F(SectorDistancesTest, NarrowLostPacketKeepsObstacle) {
    for (const double lost_deg : {12.0, 12.2, 12.5, 12.9}) {
        SectorDistances distances(sensor_);
        turn(0, 0.1, {{lost_deg + 0.5, 5}}, distances);
        take(360, 360 + lost_deg, 0.1, {}, distances);
        take(360 + lost_deg + 1, 540, 0.104, {}, distances);
        const int k = static_cast<int>((lost_deg + 0.5) / 5);
        EXPECT_EQ(distances.at(0.2)[k].state, State::Obstacle) << lost_deg;
        EXPECT_EQ(distances.at(0.29)[k + 1].state, State::SeenNothing) << lost_deg;
        EXPECT_EQ(distances.at(0.32)[k].state, State::Unknown) << lost_deg;
        EXPECT_EQ(distances.at(0.32)[k + 1].state, State::SeenNothing) << lost_deg;
    }
}

TEST_F(SectorDistancesTest, KeepsObstacleIfPacketIsLostTwice) {
    SectorDistances distances(sensor_);
    turn(0, 0.05, {{12.9, 4}}, distances);
    for (const int k : {1, 2}) {
        take(360 * k, 360 * k + 12.5, 0.05 * k, {{12.1, 9}}, distances);
        take(360 * k + 13.5, 360 * (k + 1), 0.05 * k + 0.01, {}, distances);
    }
    EXPECT_NEAR(distances.at(0.15)[2].distance_m, 4, 1e-4);
}

/// Packets of an Ouster with 512 columns are 11 degrees wide, so half a turn has 16 packets.
TEST_F(SectorDistancesTest, LatePacketDoesNotRemoveObstacle) {
    const auto sweepOf = [](int k) { return Sweep{radians(11.25 * k), radians(11.25 * (k + 1))}; };
    for (const int late : {1, 14, 15, 16}) {
        SectorDistances distances(sensor_);
        const auto timeOf = [](int k) { return 0.1 / 32 * k; };
        // In each turn, packet 2 sees a pole near its end, in a degree that packet 3 completes.
        for (int k = 0; k < 67 + late; ++k) {
            std::vector<Point> points;
            if (k % 32 == 2) points.push_back({33.6, 5});
            if (k != 67) take(sweepOf(k), timeOf(k), points, distances);
        }
        const double now_s = timeOf(67 + late);
        EXPECT_EQ(distances.at(now_s)[6].state, State::Obstacle) << late;
        const Scan none;
        const std::vector<Label> no_labels;
        const std::vector<Sweep> packets{sweepOf(67), sweepOf(67 + late)};
        const Sweep both{packets[0].from_rad, packets[1].to_rad};
        distances.take(
            {none, no_labels, both, now_s, now_s, true, false, false, result_, &packets});
        EXPECT_EQ(distances.at(now_s)[6].state, State::Obstacle) << late;
    }
}

TEST_F(SectorDistancesTest, StartsUnknown) {
    for (const auto& sector : SectorDistances(sensor_).at(0)) {
        EXPECT_EQ(sector.state, State::Unknown);
        EXPECT_TRUE(std::isnan(sector.distance_m));
        EXPECT_TRUE(std::isinf(sector.time_s));
    }
}

TEST_F(SectorDistancesTest, SectorsAreClockwiseFromAhead) {
    SectorDistances distances(sensor_);
    // Returns at known distances, including several in the same direction.
    turn(0, 0.1, {{2, 7}, {3, 6}, {92, 5}, {268, 4}, {359, 3}, {181, 9, Label::Rou}}, distances);
    const auto at = distances.at(0.1);
    for (int k = 0; k < SectorDistances::kSectors; ++k) {
        const double expected_m = k == 0    ? 6
                                  : k == 18 ? 5  // right
                                  : k == 53 ? 4  // left
                                  : k == 71 ? 3  // just left of ahead
                                            : 0;
        EXPECT_EQ(at[k].state, expected_m > 0 ? State::Obstacle : State::SeenNothing) << k;
        if (expected_m > 0) {
            EXPECT_NEAR(at[k].distance_m, expected_m, 1e-4) << k;
        }
        EXPECT_NEAR(at[k].time_s, 0.1 * (5 * k / 20) / 18, 1e-9) << k;
    }
}

TEST_F(SectorDistancesTest, StaleDirectionsAreNotFree) {
    SectorDistances distances(sensor_);
    turn(0, 0.1, {{32, 5}}, distances);
    EXPECT_EQ(distances.at(0.29)[0].state, State::SeenNothing);
    EXPECT_EQ(distances.at(0.31)[0].state, State::Unknown);
    EXPECT_EQ(distances.at(0.29)[6].state, State::Obstacle);
    EXPECT_EQ(distances.at(0.5)[6].state, State::Unknown);
    // If the clock steps back, data from the future are not fresh.
    EXPECT_EQ(distances.at(-1)[6].state, State::Unknown);
    EXPECT_EQ(distances.at(-1)[0].state, State::Unknown);
}

TEST_F(SectorDistancesTest, ForgetsTurnsBeforeClockJump) {
    SectorDistances distances(sensor_);
    turn(100, 0.1, {{32, 5}}, distances);  // at 10 s
    take(0, 20, 9.9, {}, distances);
    EXPECT_EQ(distances.latest_s(), 9.9 + 0.005);
    for (const double now_s : {9.9, 10.1}) {
        for (int k = 0; k < SectorDistances::kSectors; ++k) {
            EXPECT_EQ(distances.at(now_s)[k].state, k < 4 ? State::SeenNothing : State::Unknown);
        }
    }
}

TEST_F(SectorDistancesTest, PartlySweptDirectionIsNotFree) {
    SectorDistances distances(sensor_);
    take(0, 13, 1, {{11, 4}}, distances);
    const auto at = distances.at(1);
    EXPECT_EQ(at[0].state, State::SeenNothing);
    EXPECT_EQ(at[1].state, State::SeenNothing);
    EXPECT_EQ(at[2].state, State::Obstacle);  // seen in the swept part
    EXPECT_EQ(at[3].state, State::Unknown);
    SectorDistances others(sensor_);
    take(0, 13, 1, {}, others);
    EXPECT_EQ(others.at(1)[2].state, State::Unknown);
    take(13, 20, 1.01, {}, others);
    EXPECT_EQ(others.at(1.01)[2].state, State::SeenNothing);
    EXPECT_EQ(others.at(1.01)[2].time_s, 1);  // time of the earlier part
}

TEST_F(SectorDistancesTest, ObstacleAtSweepBorderStays) {
    // The degree from 10 to 11 is swept in two parts; the obstacle is in the first part.
    SectorDistances distances(sensor_);
    take(0, 10.4, 1, {{10.2, 4}}, distances);
    take(10.4, 20, 1.005, {{10.8, 9}}, distances);
    EXPECT_EQ(distances.at(1.01)[2].state, State::Obstacle);
    EXPECT_NEAR(distances.at(1.01)[2].distance_m, 4, 1e-4);
}

TEST_F(SectorDistancesTest, NextTurnReplacesLast) {
    for (const double turn_s : {0.05, 0.1, 0.2}) {  // 20, 10 and 5 Hz
        SectorDistances distances(sensor_);
        turn(0, turn_s, {{47, 4}, {100, 3}}, distances);
        turn(1, turn_s, {{47, 8}}, distances);
        const auto at = distances.at(2 * turn_s);
        EXPECT_NEAR(at[9].distance_m, 8, 1e-4) << turn_s;       // the obstacle moved away
        EXPECT_EQ(at[20].state, State::SeenNothing) << turn_s;  // the obstacle is gone
    }
}

TEST_F(SectorDistancesTest, DistancesAreRelativeToBody) {
    SectorDistances::Settings settings;
    // The sensor faces right, 0.5 m ahead of the body's origin.
    settings.body_from_sensor =
        Eigen::Translation3d(0.5, 0, 0) * Eigen::AngleAxisd(-kPi / 2, Eigen::Vector3d::UnitZ());
    SectorDistances distances(sensor_, settings);
    take(0, 20, 1, {}, distances);             // right of the body
    take(260, 280, 1, {{271, 4}}, distances);  // ahead of the body
    const auto at = distances.at(1);
    EXPECT_EQ(at[19].state, State::SeenNothing);
    EXPECT_EQ(at[1].state, State::SeenNothing);
    EXPECT_EQ(at[0].state, State::Obstacle);
    EXPECT_NEAR(at[0].distance_m, 4.5, 0.01);
}

TEST_F(SectorDistancesTest, LimitsHeights) {
    SectorDistances::Settings settings;
    settings.low_m = -1;
    settings.high_m = 2;
    SectorDistances distances(sensor_, settings);
    take(0, 20, 1, {{2, 4, Label::Roi, 3}, {7, 4, Label::Roi, -1.5f}, {12, 4, Label::Roi, 1}},
         distances);
    const auto at = distances.at(1);
    EXPECT_EQ(at[0].state, State::SeenNothing);
    EXPECT_EQ(at[1].state, State::SeenNothing);
    EXPECT_EQ(at[2].state, State::Obstacle);
}

TEST_F(SectorDistancesTest, TiltedSensorLeavesHorizonUnknown) {
    SectorDistances::Settings settings;
    settings.body_from_sensor = Eigen::AngleAxisd(radians(30.0), Eigen::Vector3d::UnitY());
    SectorDistances distances(sensor_, settings);
    take(0, 360, 1, {}, distances);
    const auto at = distances.at(1);
    EXPECT_EQ(at[0].state, State::Unknown);       // ahead, the beams end below the horizon
    EXPECT_EQ(at[36].state, State::Unknown);      // behind, they begin above the horizon
    EXPECT_EQ(at[18].state, State::SeenNothing);  // at the sides, they are level
}

/// The packet ends before the obstacle, within the same degree.
TEST_F(SectorDistancesTest, ObstacleStaysUntilPassed) {
    for (const double end_deg : {11.0, 11.25, 11.6, 11.9}) {
        SectorDistances distances(sensor_);
        turn(0, 0.1, {{11.95, 5}}, distances);
        take(360, 360 + end_deg, 0.1, {{11.0, 10}}, distances);
        EXPECT_EQ(distances.at(0.11)[2].state, State::Obstacle) << end_deg;
        EXPECT_NEAR(distances.at(0.11)[2].distance_m, 5, 1e-4) << end_deg;
        take(360 + end_deg, 360 + 2 * end_deg, 0.11, {}, distances);
        EXPECT_NEAR(distances.at(0.12)[2].distance_m, 10, 1e-4) << end_deg;
    }
}

/// The sensor is 1 m ahead of the body: an obstacle behind the sensor can be ahead of the body, in
/// a direction that is passed up to half a turn later. The same holds if later packets are lost.
TEST_F(SectorDistancesTest, NearObstacleStaysForOffsetSensor) {
    for (const auto& [x_m, y_m] : {std::pair{0.3, 0.6}, {0.3, -0.6}, {0.6, 0.2}, {-0.5, 0.1}}) {
        for (const bool is_lost : {false, true}) {
            SectorDistances::Settings settings;
            settings.body_from_sensor.translation().x() = 1;
            SectorDistances distances(sensor_, settings);
            const double azimuth_deg = turned_deg(-std::atan2(y_m, x_m - 1));
            const Point near{azimuth_deg, std::hypot(x_m - 1, y_m)};
            const int bin = static_cast<int>(turned_deg(-std::atan2(y_m, x_m)) / 5);
            for (int k = 0; k < (is_lost ? 54 : 72); ++k) {  // sectors of 20 degrees
                const bool has_obstacle =
                    azimuth_deg >= 20 * (k % 18) && azimuth_deg < 20 * (k % 18 + 1);
                if (has_obstacle && is_lost && k >= 18) continue;
                const double time_s = 0.1 * k / 18;
                take(20.0 * k, 20.0 * (k + 1), time_s,
                     has_obstacle ? std::vector{near} : std::vector<Point>{}, distances);
                if (k < 18) continue;
                const State state = distances.at(time_s + 0.005)[bin].state;
                EXPECT_NE(state, State::SeenNothing) << x_m << " " << y_m << " " << k;
                EXPECT_TRUE(is_lost || state == State::Obstacle) << x_m << " " << y_m << " " << k;
            }
        }
    }
}

/// Pitched down by 20 degrees, the sensor sees the obstacle at 268 at its own 272.3 degrees.
TEST_F(SectorDistancesTest, ObstacleBelowHorizonStays) {
    SectorDistances::Settings settings;
    settings.body_from_sensor = Eigen::AngleAxisd(radians(20.0), Eigen::Vector3d::UnitY());
    const Eigen::Vector3d left(std::cos(radians(268)), -std::sin(radians(268)),
                               -std::tan(radians(12)));
    const Eigen::Vector3d at_m = settings.body_from_sensor.inverse() * (8 * left);
    const double azimuth_deg = turned_deg(-std::atan2(at_m.y(), at_m.x()));
    ASSERT_NEAR(azimuth_deg, 272.3, 0.1);
    const Point low{azimuth_deg, at_m.head<2>().norm(), Label::Roi, static_cast<float>(at_m.z())};
    SectorDistances distances(sensor_, settings);
    int steps = 0;
    for (double from_deg = 0; from_deg < 1080; from_deg += 3, ++steps) {
        const double time_s = 0.1 * from_deg / 360;
        const bool has_obstacle =
            std::fmod(from_deg, 360) <= azimuth_deg && azimuth_deg < std::fmod(from_deg, 360) + 3;
        take(from_deg, from_deg + 3, time_s, has_obstacle ? std::vector{low} : std::vector<Point>{},
             distances);
        if (from_deg < 360) continue;
        EXPECT_EQ(distances.at(time_s)[53].state, State::Obstacle) << from_deg;
    }
    EXPECT_EQ(steps, 360);
    // The next turn removes the obstacle.
    take(1080, 1440, 0.4, {}, distances);
    EXPECT_EQ(distances.at(0.41)[53].state, State::SeenNothing);
}

TEST_F(SectorDistancesTest, FramesWithLossesAreUnknown) {
    const auto takeFrames = [&](double measured_s, int frames, SectorDistances& distances) {
        const Scan scan;
        const std::vector<Label> labels;
        for (int k = 0; k < frames; ++k) {
            const double time_s = 1 + 0.02 * k;
            distances.take({scan, labels, std::nullopt, time_s, time_s, true, false, false, result_,
                            nullptr, measured_s});
        }
    };
    const auto stateAfter = [&](double measured_s, int frames) {
        SectorDistances distances(sensorModel("Mid-360"));
        takeFrames(measured_s, frames, distances);
        return distances.at(1 + 0.02 * frames)[9].state;
    };
    EXPECT_EQ(stateAfter(0.02, 3), State::Unknown);  // view not yet complete
    EXPECT_EQ(stateAfter(0.02, 5), State::SeenNothing);
    EXPECT_EQ(stateAfter(0.018, 50), State::SeenNothing);
    EXPECT_EQ(stateAfter(0.012, 50), State::Unknown);
    EXPECT_EQ(stateAfter(0.0005, 50), State::Unknown);  // one of 42 packets
    EXPECT_EQ(stateAfter(0, 50), State::Unknown);
}

/// After a network outage, a quarter of the packets from 0.3 s arrive together.
TEST_F(SectorDistancesTest, FrameBurstIsNotFullView) {
    const Scan scan;
    const std::vector<Label> labels;
    const auto stateAfter = [&](double measured_s) {
        SectorDistances distances(sensorModel("Mid-360"));
        for (int k = 0; k < 16; ++k) {
            const double arrival_s = 1.3 + 1e-4 * k;
            distances.take({scan, labels, std::nullopt, arrival_s, arrival_s, true, false, false,
                            result_, nullptr, measured_s, BeamOffsets(), 0.02 * k});
        }
        return distances.at(1.31)[9].state;
    };
    EXPECT_EQ(stateAfter(0.005), State::Unknown);
    EXPECT_EQ(stateAfter(0.019), State::SeenNothing);
}

/// A direction becomes free only after a full view that began after the obstacle was seen.
TEST_F(SectorDistancesTest, FrameObstacleStaysUntilSecondLook) {
    Scan pole, nothing;
    pole.x_m = {5};
    pole.y_m = {-0.1f};
    pole.z_m = {0};
    // With {1, 7}, frames continue for longer than the pole is kept.
    for (const auto& [last_with_pole, last] : {std::pair{1, 5}, {5, 5}, {1, 7}}) {
        for (const double lost_s : {0.0, 5e-4}) {  // followed by silence, or by one of 42 packets
            SectorDistances distances(sensorModel("Mid-360"));
            for (int k = 0; k < 25; ++k) {
                const double time_s = 1 + 0.02 * k;
                const bool is_pole = k == 1 || k == last_with_pole;
                if (k <= last || lost_s > 0) {
                    distances.take({is_pole ? pole : nothing,
                                    is_pole ? std::vector{Label::Roi} : std::vector<Label>{},
                                    std::nullopt, time_s, time_s, true, false, false, result_,
                                    nullptr, k <= last ? 0.019 : lost_s});
                }
                if (k < 1) continue;
                EXPECT_NE(distances.at(time_s + 1e-3)[0].state, State::SeenNothing)
                    << last_with_pole << " " << last << " " << lost_s << " " << k;
            }
        }
    }
}

TEST_F(SectorDistancesTest, FrameObstacleLasts100ms) {
    SectorDistances distances(sensorModel("Mid-360"));
    take(std::nullopt, 1.00, {{2, 4}}, distances);
    for (int k = 1; k < 5; ++k) take(std::nullopt, 1 + 0.02 * k, {{2, 5}}, distances);
    EXPECT_NEAR(distances.at(1.09)[0].distance_m, 4, 1e-4);
    EXPECT_EQ(distances.at(1.09)[9].state, State::SeenNothing);
    for (int k = 5; k < 16; ++k) take(std::nullopt, 1 + 0.02 * k, {{2, 5}}, distances);
    EXPECT_NEAR(distances.at(1.31)[0].distance_m, 5, 1e-4);  // the obstacle expires later
    EXPECT_EQ(distances.at(1.7)[0].state, State::Unknown);
    for (int k = 0; k < 15; ++k) take(std::nullopt, 2 + 0.02 * k, {}, distances);
    EXPECT_EQ(distances.at(2.29)[0].state, State::SeenNothing);
}

}  // namespace
}  // namespace hagen::live
