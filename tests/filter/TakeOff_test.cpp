// A drone that stands in a forest: its sensor is 0.3 m above rough ground, and most grid cells
// contain only tree crowns.
#include <gtest/gtest.h>
#include <hagen/filter/HagenFilter.h>
#include <hagen/filter/SectorFilter.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

constexpr int kClimbColumns = 870;

/// Bumps with a standard deviation of 3 cm and wavelengths of 0.3 to 2 m.
double bump_m(double x_m, double y_m) {
    return 0.03 * (std::sin(3 * x_m + 1) * std::cos(4 * y_m) + std::sin(13 * x_m - 9 * y_m) +
                   std::cos(11 * x_m + 17 * y_m));
}

/// The tilt of the standing drone, unknown to the filter.
Eigen::Matrix3d tilt() {
    return (Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(-0.08, Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
}

/// Trunks every 4 m, and crowns from 2 to 8 m above the ground.
test::LabelledScan forestFrom(double sensor_m, const SensorModel& sensor) {
    test::Random random(7);
    test::SimpleScene scene;
    for (double x_m = -20; x_m < 20; x_m += 4) {
        for (double y_m = -20; y_m < 20; y_m += 4) {
            scene.poles.push_back({x_m + random.real(1, 3), y_m + random.real(1, 3), 0.15, 10});
        }
    }
    const auto roughen = [&](const Eigen::Vector3d& direction, test::Hit& hit) {
        if (hit.label == Label::Rou) {
            const Eigen::Vector3d flat_m = hit.range_m * direction;
            hit.range_m *= 1 - bump_m(flat_m.x(), flat_m.y()) / sensor_m;
        } else if (direction.z() > 0 && random.chance(0.7)) {
            const double crown_m = random.real(2, 8) / direction.z();
            if (crown_m < std::min(hit.range_m, 45.0)) hit = {crown_m, Label::Roi};
        }
    };
    return test::scanScene(scene, sensor, kClimbColumns, {0, 0, sensor_m}, tilt(), roughen);
}

SensorModel sixtyFourBeams(double reach_deg) {
    std::vector<double> elevations_deg;
    for (int beam = 0; beam < 64; ++beam)
        elevations_deg.push_back(reach_deg * (2 * beam / 63.0 - 1));
    return customSensorModel(elevations_deg);
}

struct TakeOffOutcome {
    double ground_share = 0;  ///< of the ground returns, those that are ROU
    int obstacles = 0;        ///< returns more than 0.25 m above the mean ground
    int missed = 0;           ///< of these, returns that are not RoI
};

TakeOffOutcome takeOffOutcome(const test::LabelledScan& seen, double sensor_m,
                              const std::vector<Label>& label) {
    TakeOffOutcome o;
    double ground = 0, rou = 0;
    for (std::size_t i = 0; i < label.size(); ++i) {
        if (seen.scan.range_m[i] < 0.5f || seen.scan.range_m[i] > 20) continue;
        const Eigen::Vector3d at_m(seen.scan.x_m[i], seen.scan.y_m[i], seen.scan.z_m[i]);
        const bool is_ground = seen.truth[i] == Label::Rou;
        const bool is_obstacle = !is_ground && (tilt() * at_m).z() + sensor_m > 0.25;
        ground += is_ground;
        rou += is_ground && label[i] == Label::Rou;
        o.obstacles += is_obstacle;
        o.missed += is_obstacle && label[i] != Label::Roi;
    }
    o.ground_share = rou / ground;
    return o;
}

TEST(TakeOff, GroundInForestIsRou) {
    for (const double reach_deg : {22.5, 45.0}) {
        for (const double sensor_m : {0.2, 0.3, 0.6}) {
            SCOPED_TRACE(testing::Message() << reach_deg << " degrees, " << sensor_m << " m");
            const SensorModel sensor = sixtyFourBeams(reach_deg);
            const test::LabelledScan seen = forestFrom(sensor_m, sensor);
            HagenFilter filter(sensor);
            const TakeOffOutcome whole =
                takeOffOutcome(seen, sensor_m, filter.segment(seen.scan).returns.label);
            EXPECT_GT(whole.ground_share, 0.9);
            EXPECT_GT(whole.obstacles, 10000);
            EXPECT_EQ(whole.missed, 0);

            SectorFilter sectors(sensor, {});  // a sector of the whole turn
            ColumnMap columns;
            mapColumns(kClimbColumns, 1, 0, kClimbColumns, columns);
            const std::vector<ContextReturn> context(seen.scan.size());
            const auto& result = sectors.segment(seen.scan, {}, {seen.scan, columns, context});
            const TakeOffOutcome live = takeOffOutcome(seen, sensor_m, result.returns.label);
            EXPECT_GT(live.ground_share, 0.9);
            EXPECT_EQ(live.missed, 0);
        }
    }
}

}  // namespace
}  // namespace hagen
