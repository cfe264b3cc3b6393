#include <gtest/gtest.h>
#include <hagen/filter/HagenFilter.h>
#include <hagen/filter/SectorFilter.h>
#include <hagen/scan/Angle.h>
#include "scan/AppendReturn.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "support/SimpleScene.h"

namespace hagen {
namespace {

using test::SimpleScene;

const Eigen::Vector3d kSensorAboveGround(0, 0, 2);
constexpr int kSectorColumns = 870;

/// A turn whose first returns form a sector around the front.
struct Turn {
    Scan scan, sector;
    std::vector<Label> whole;  ///< labels of the whole scan
};

Turn turnOf(const SimpleScene& scene, const SensorModel& sensor, double half_rad) {
    const Scan scan = test::scanScene(scene, sensor, kSectorColumns, kSensorAboveGround).scan;
    Turn turn;
    for (const bool is_of_sector : {true, false}) {
        for (std::size_t i = 0; i < scan.size(); ++i) {
            if ((std::abs(scan.azimuth_rad[i]) < half_rad) != is_of_sector) continue;
            for (Scan* to : {&turn.scan, &turn.sector}) {
                if (to == &turn.sector && !is_of_sector) continue;
                to->x_m.push_back(scan.x_m[i]);
                to->y_m.push_back(scan.y_m[i]);
                to->z_m.push_back(scan.z_m[i]);
                to->intensity.push_back(0.5f);
            }
        }
    }
    locateBeams(sensor, turn.scan);
    locateBeams(sensor, turn.sector);
    HagenFilter filter(sensor);
    turn.whole = filter.segment(turn.scan).returns.label;
    return turn;
}

/// The context from an earlier sector whose only known data are labels.
std::vector<ContextReturn> contextOf(const std::vector<Label>& regions) {
    std::vector<ContextReturn> context;
    for (const Label region : regions) context.push_back({region, kNoValue});
    return context;
}

/// All columns within 35 degrees of the front, and every sixth column elsewhere.
ColumnMap windowInFront() {
    ColumnMap map;
    mapColumns(kSectorColumns, 6, 58, 29, map);
    return map;
}

SimpleScene sceneWithPole() { return test::sceneOf({}, {{5, 0.5, 0.3, 4}, {-8, 2, 0.3, 4}}); }

TEST(SectorFilter, MatchesWholeScan) {
    for (const char* name : {"VLP-16", "HDL-32E"}) {
        const SensorModel sensor = sensorModel(name);
        const Turn turn = turnOf(sceneWithPole(), sensor, radians(20.0));
        const ColumnMap columns = windowInFront();
        SectorFilter filter(sensor, {});
        const auto& found =
            filter.segment(turn.scan, {}, {turn.sector, columns, contextOf(turn.whole)});
        ASSERT_EQ(found.returns.label.size(), turn.sector.size());
        ASSERT_EQ(filter.found().size(), turn.sector.size());
        EXPECT_TRUE(found.ground.has_surface);
        // Compares labels, and the regions before ground estimation, which contain most of the flat
        // ground.
        std::size_t different = 0, ground = 0, rou = 0, pole = 0, roi = 0;
        for (std::size_t i = 0; i < turn.sector.size(); ++i) {
            different += found.returns.label[i] != turn.whole[i];
            const float above_m = turn.sector.z_m[i] + 2;
            ground += above_m < 0.01f;
            rou += above_m < 0.01f && filter.found()[i].region == Label::Rou;
            pole += above_m > 0.5f;
            roi += above_m > 0.5f && filter.found()[i].region == Label::Roi;
        }
        EXPECT_LE(different, turn.sector.size() / 1000) << name;
        EXPECT_GT(ground, 400u) << name;
        EXPECT_GT(rou, ground * 8 / 10) << name;
        EXPECT_GT(pole, 20u) << name;
        EXPECT_GT(roi, pole * 9 / 10) << name;
    }
}

/// If a sector contains only a wall, the context shows the ground.
TEST(SectorFilter, ContextRevealsGround) {
    const SimpleScene scene = test::sceneOf({{{2, -20, 0}, {3, 20, 6}}});
    const SensorModel sensor = sensorModel("VLP-16");
    const Turn turn = turnOf(scene, sensor, radians(8.0));
    const ColumnMap columns = windowInFront();
    SectorFilter filter(sensor, {});
    const auto& seen = filter.segment(turn.scan, {}, {turn.sector, columns, contextOf(turn.whole)});
    EXPECT_TRUE(seen.ground.is_seen);
    EXPECT_NEAR(seen.ground.from_sensor.translation().z(), 2, 0.02);
    const std::vector<Label> unknown(turn.scan.size(), Label::Unclassified);
    const auto& doubtful =
        filter.segment(turn.scan, {}, {turn.sector, columns, contextOf(unknown)});
    EXPECT_FALSE(doubtful.ground.is_seen);
    for (const Label label : doubtful.returns.label) EXPECT_EQ(label, Label::Roi);
}

TEST(SectorFilter, EmptySectorHasNoLabels) {
    const SensorModel sensor = sensorModel("VLP-16");
    SectorFilter filter(sensor, {});
    Scan none;
    locateBeams(sensor, none);
    const ColumnMap columns = windowInFront();
    EXPECT_TRUE(filter.segment(none, {}, {none, columns, {}}).returns.label.empty());
    // A context without a sector.
    const Scan scan = test::scanScene({}, sensor, kSectorColumns, kSensorAboveGround).scan;
    const std::vector<Label> rou(scan.size(), Label::Rou);
    EXPECT_TRUE(filter.segment(scan, {}, {none, columns, contextOf(rou)}).returns.label.empty());
}

TEST(SectorFilter, RejectsUnlocatedReturns) {
    const SensorModel sensor = sensorModel("VLP-16");
    SectorFilter filter(sensor, {});
    Scan scan;
    scan.x_m = scan.y_m = scan.z_m = {1};
    const std::vector<ContextReturn> context(1);
    const ColumnMap columns = windowInFront();
    EXPECT_THROW(filter.segment(scan, {}, {scan, columns, context}), std::invalid_argument);
    Options options;
    options.window_size = 1;
    EXPECT_THROW(SectorFilter(sensor, options), std::invalid_argument);
}

/// Thin plants in rows. Every sixth column alone hits few of their tops.
SimpleScene sceneWithCrops() {
    SimpleScene scene;
    for (int i = -14; i <= 14; ++i) {
        for (int j = -14; j <= 14; ++j) {
            scene.poles.push_back({1.2 * i + 0.05 * j, 1.2 * j, 0.05, 0.7});
        }
    }
    return scene;
}

/// The returns of the sector and, elsewhere, of every sixth column.
Turn thinned(const Turn& turn, std::vector<std::size_t>& kept) {
    Turn thin;
    thin.sector = turn.sector;
    for (std::size_t i = 0; i < turn.scan.size(); ++i) {
        const bool is_context = i >= turn.sector.size();
        if (is_context && nearestColumn(turn.scan.azimuth_rad[i], kSectorColumns) % 6 != 0)
            continue;
        appendReturn(turn.scan, i, thin.scan);
        thin.whole.push_back(turn.whole[i]);
        kept.push_back(i);
    }
    thin.scan.beams = turn.scan.beams;
    return thin;
}

TEST(SectorFilter, CanopyNeedsContextHeights) {
    const SensorModel sensor = sensorModel("VLP-16");
    const Turn turn = turnOf(sceneWithCrops(), sensor, radians(7.5));
    std::vector<std::size_t> kept;
    const Turn thin = thinned(turn, kept);
    // Earlier sectors contained all returns; here, one whole turn.
    SectorFilter all(sensor, {});
    ColumnMap every_column;
    mapColumns(kSectorColumns, 6, 0, kSectorColumns / 6, every_column);
    all.segment(turn.scan, {}, {turn.scan, every_column, contextOf(turn.whole)});
    std::vector<ContextReturn> context;
    for (const std::size_t i : kept) context.push_back(all.found()[i]);

    const ColumnMap columns = windowInFront();
    const auto differentWith = [&](const std::vector<ContextReturn>& known) {
        SectorFilter filter(sensor, {});
        const auto& found = filter.segment(thin.scan, {}, {thin.sector, columns, known});
        std::size_t different = 0;
        for (std::size_t i = 0; i < thin.sector.size(); ++i) {
            different += found.returns.label[i] != turn.whole[i];
        }
        return different;
    };
    const std::size_t with = differentWith(context), without = differentWith(contextOf(thin.whole));
    EXPECT_GT(without, 20u);
    EXPECT_EQ(with, 0u);
}

}  // namespace
}  // namespace hagen
