#include <gtest/gtest.h>
#include <hagen/range_image/Angle.h>
#include <hagen/segmentation/GapRepair.h>
#include <hagen/segmentation/HagenFilter.h>
#include <hagen/segmentation/Labelling.h>
#include <hagen/segmentation/RangeAngle.h>
#include <hagen/segmentation/RoiComponents.h>
#include <hagen/segmentation/Sharpening.h>
#include <hagen/segmentation/SingularSpectrumAnalysis.h>

#include <cmath>
#include <stdexcept>

#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

using test::LabelledScan;
using test::SimpleScene;

const Eigen::Vector3d kTwoMetresUp(0, 0, 2);

/// Returns in the zone whose label is not what geometry says.
int mistakes(const LabelledScan& labelled, const SegmentationResult& result, Label truth) {
    int wrong = 0;
    for (std::size_t i = 0; i < labelled.scan.size(); ++i) {
        if (labelled.scan.range_m[i] > 20.0f || labelled.truth[i] != truth) continue;
        wrong += result.returns.label[i] != truth;
    }
    return wrong;
}

int count(const LabelledScan& labelled, Label truth) {
    int number = 0;
    for (std::size_t i = 0; i < labelled.scan.size(); ++i) {
        number += labelled.scan.range_m[i] <= 20.0f && labelled.truth[i] == truth;
    }
    return number;
}

TEST(HagenFilter, APlaneIsNoObstacle) {
    for (const char* name : {"VLP-16", "HDL-32E", "HDL-64E"}) {
        const auto ground = test::scanScene({}, sensorModel(name), 870, kTwoMetresUp);
        HagenFilter filter(sensorModel(name));
        EXPECT_EQ(mistakes(ground, filter.segment(ground.scan), Label::Rou), 0) << name;
        EXPECT_GT(count(ground, Label::Rou), 4000) << name;
    }
}

TEST(HagenFilter, AWallIsAnObstacleAndTheGroundBeforeItIsNot) {
    SimpleScene scene;
    scene.boxes.push_back({{10, -5, 0}, {11, 5, 30}});
    const auto wall = test::scanScene(scene, sensorModel("VLP-16"), 870, kTwoMetresUp);
    HagenFilter filter(sensorModel("VLP-16"));
    const auto& result = filter.segment(wall.scan);
    EXPECT_GT(count(wall, Label::Roi), 1500);
    EXPECT_EQ(mistakes(wall, result, Label::Roi), 0);
    // Where a beam meets the ground just before the wall, its slope to the beam above is the
    // wall's.
    const double wall_columns = 870 * 2 * std::atan(5.0 / 10.0) / (2 * kPi);
    EXPECT_LE(mistakes(wall, result, Label::Rou), wall_columns);
}

TEST(HagenFilter, APoleIsOneObstacle) {
    SimpleScene scene;
    scene.poles.push_back({12, 2, 0.15, 8});
    const auto pole = test::scanScene(scene, sensorModel("VLP-16"), 870, kTwoMetresUp);
    HagenFilter filter(sensorModel("VLP-16"));
    const auto& result = filter.segment(pole.scan);
    EXPECT_GT(count(pole, Label::Roi), 40);
    EXPECT_EQ(mistakes(pole, result, Label::Roi), 0);
    EXPECT_EQ(mistakes(pole, result, Label::Rou), 0);
    for (const auto i : result.returns.roi) EXPECT_EQ(result.returns.component[i], 1);
}

TEST(HagenFilter, SomethingInMidAirIsAnObstacle) {
    SimpleScene scene;
    scene.boxes.push_back({{9, -1, 1.8}, {10, 1, 2.4}});
    const auto box = test::scanScene(scene, sensorModel("VLP-16"), 870, kTwoMetresUp);
    HagenFilter filter(sensorModel("VLP-16"));
    EXPECT_GT(count(box, Label::Roi), 20);
    EXPECT_EQ(mistakes(box, filter.segment(box.scan), Label::Roi), 0);
}

// What the paper's seeds cannot do: whatever the lowest beam of a column meets is taken for ground.
TEST(HagenFilter, AWallNearerThanTheLowestGroundRingIsTakenForGround) {
    SimpleScene scene;
    scene.boxes.push_back({{5, -2, 0}, {6, 2, 30}});
    const auto wall = test::scanScene(scene, sensorModel("VLP-16"), 870, kTwoMetresUp);
    HagenFilter filter(sensorModel("VLP-16"));
    EXPECT_GT(mistakes(wall, filter.segment(wall.scan), Label::Roi), 0.9 * count(wall, Label::Roi));
}

TEST(HagenFilter, BeyondTheZoneNothingIsAnObstacle) {
    SimpleScene scene;
    scene.boxes.push_back({{25, -50, 0}, {26, 50, 30}});
    const auto wall = test::scanScene(scene, sensorModel("VLP-16"), 870, kTwoMetresUp);
    for (const float context_m : {20.0f, 100.0f}) {
        Options options;
        options.context_m = context_m;
        HagenFilter filter(sensorModel("VLP-16"), options);
        const auto& result = filter.segment(wall.scan);
        for (const auto i : result.returns.roi) EXPECT_LE(wall.scan.range_m[i], 20.0f);
        EXPECT_EQ(result.returns.unclassified.size(), 0u);
    }
}

TEST(HagenFilter, TheImageNeverEndsBeforeTheZone) {
    SimpleScene scene;
    scene.poles.push_back({12, 2, 0.15, 8});
    const auto pole = test::scanScene(scene, sensorModel("VLP-16"), 870, kTwoMetresUp);
    Options options;
    HagenFilter as_far(sensorModel("VLP-16"), options);
    options.context_m = 5.0f;
    HagenFilter nearer(sensorModel("VLP-16"), options);
    EXPECT_EQ(nearer.segment(pole.scan).returns.label, as_far.segment(pole.scan).returns.label);
}

Scan randomScan(unsigned seed, const SensorModel& sensor) {
    test::Random random(seed);
    Scan scan;
    const int returns = random.whole(1000, 20000);
    for (int i = 0; i < returns; ++i) {
        const float spread = random.chance(0.1) ? 200.0f : 20.0f;
        scan.x_m.push_back(random.chance(0.01) ? kNoValue : random.real(-spread, spread));
        scan.y_m.push_back(random.real(-spread, spread));
        scan.z_m.push_back(random.real(-3.0f, 3.0f));
        scan.intensity.push_back(0.0f);
    }
    locateBeams(sensor, scan);
    return scan;
}

TEST(HagenFilter, EveryReturnOfARandomScanEndsInExactlyOneList) {
    for (unsigned seed = 20; seed < 40; ++seed) {
        const SensorModel sensor = sensorModel(seed % 2 == 0 ? "VLP-16" : "HDL-64E");
        const Scan scan = randomScan(seed, sensor);
        HagenFilter filter(sensor);
        const LabelledReturns& returns = filter.segment(scan).returns;
        std::vector<int> seen(scan.size(), 0);
        for (const auto& [indices, label] : {std::pair{&returns.roi, Label::Roi},
                                             {&returns.rou, Label::Rou},
                                             {&returns.unclassified, Label::Unclassified}}) {
            for (const auto i : *indices) {
                ++seen[i];
                ASSERT_EQ(returns.label[i], label);
                ASSERT_EQ(returns.component[i] > 0, label == Label::Roi);
            }
        }
        ASSERT_TRUE(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
    }
}

TEST(HagenFilter, KeepsNothingFromTheScanBefore) {
    const SensorModel sensor = sensorModel("VLP-16");
    const Scan first = randomScan(40, sensor), other = randomScan(41, sensor);
    HagenFilter filter(sensor);
    const auto labels = filter.segment(first).returns.label;
    filter.segment(other);
    EXPECT_EQ(filter.segment(first).returns.label, labels);
    EXPECT_EQ(filter.segment(first).returns.label, labels);
    EXPECT_EQ(HagenFilter(sensor).segment(first).returns.label, labels);
}

TEST(HagenFilter, AnEmptyScanHasNoReturns) {
    HagenFilter filter(sensorModel("VLP-16"));
    const auto& result = filter.segment(Scan());
    EXPECT_TRUE(result.returns.label.empty());
    EXPECT_TRUE(result.maxima.empty());
    EXPECT_TRUE((result.labels == Label::Unclassified).all());
}

TEST(HagenFilter, EveryIntermediateImageIsThere) {
    SimpleScene scene;
    scene.poles.push_back({6, 2, 0.15, 8});
    const auto pole = test::scanScene(scene, sensorModel("VLP-16"), 870, kTwoMetresUp);
    HagenFilter filter(sensorModel("VLP-16"));
    const auto& r = filter.segment(pole.scan);
    for (const auto* image : {&r.range_image.depth_m, &r.repaired_m, &r.proximity_m, &r.sharpened_m,
                              &r.merged_m, &r.pixel_angle_rad}) {
        EXPECT_EQ(image->rows(), 16);
        EXPECT_EQ(image->cols(), 870);
        EXPECT_FALSE(image->isNaN().all());
    }
    EXPECT_EQ(r.range_angle_rad.rows(), 15);
    EXPECT_EQ(r.smoothed_rad.rows(), 15);
    EXPECT_FALSE(r.maxima.empty());
}

// Each image is what its stage makes of the one before, with every option off its default: no stage
// is left out, none gets another's option.
TEST(HagenFilter, EachStageWorksOnTheOneBeforeWithItsOwnOptions) {
    SensorModel sensor = sensorModel("HDL-32E");
    sensor.min_range_m = 2.0f;
    Options o;
    o.zone_m = 15.0f;
    o.context_m = 25.0f;
    o.columns = 400;
    o.repair_max_step_m = 3.0f;
    o.persistence_m = 0.3f;
    o.sharpening_sigma_px = 0.7f;
    o.sharpening_sigma_m = 2.5f;
    o.window_size = 10;
    o.principal_components = 3;
    o.beta_deg = 12.0f;
    o.component_gap_m = 0.4f;
    for (const Seeds seeds : {Seeds::Lowest, Seeds::TopAndNearest}) {
        o.seeds = seeds;
        const Scan scan = randomScan(42, sensor);
        HagenFilter filter(sensor, o);
        const SegmentationResult& r = filter.segment(scan);

        RangeImage image;
        Image<float> repaired, proximity, sharpened, merged, angles, smoothed, carried;
        std::vector<Maximum> maxima;
        Image<Label> labels;
        Image<std::int32_t> components;
        LabelledReturns returns;
        projectScan(scan, sensor, 400, 25.0f, image);
        repairGaps(image.depth_m, 3.0f, repaired);
        proximityOf(repaired, 15.0f, proximity);
        findPersistentMaxima(proximity, 0.3f, maxima);
        sharpenMaxima(proximity, maxima, 0.7f, 2.5f, sharpened);
        mergeMaxima(repaired, proximity, sharpened, maxima, 2.0f, merged);
        rangeAngles(merged, sensor, angles);
        smoothColumns(angles, 10, 3, smoothed);
        carryAngles(smoothed, carried);
        labelRegions(repaired, carried, static_cast<float>(radians(12.0)), seeds, labels);
        limitToZone(repaired, 15.0f, labels);
        numberRoiComponents(repaired, labels, 0.4f, components);
        extractReturns(scan, sensor, image, labels, components, 15.0f, returns);

        EXPECT_TRUE(test::same(r.range_image.depth_m, image.depth_m));
        EXPECT_TRUE(test::same(r.repaired_m, repaired));
        EXPECT_FALSE(test::same(repaired, image.depth_m));
        EXPECT_TRUE(test::same(r.proximity_m, proximity));
        EXPECT_EQ(r.maxima.size(), maxima.size());
        EXPECT_TRUE(test::same(r.sharpened_m, sharpened));
        EXPECT_TRUE(test::same(r.merged_m, merged));
        EXPECT_FALSE(test::same(merged, repaired));
        EXPECT_TRUE(test::same(r.range_angle_rad, angles));
        EXPECT_TRUE(test::same(r.smoothed_rad, smoothed));
        EXPECT_FALSE(test::same(smoothed, angles));
        EXPECT_TRUE(test::same(r.pixel_angle_rad, carried));
        EXPECT_TRUE((r.labels == labels).all());
        EXPECT_TRUE((r.components == components).all());
        EXPECT_EQ(r.returns.label, returns.label);
        EXPECT_EQ(r.returns.component, returns.component);
    }
}

TEST(HagenFilter, RefusesOptionsThatDoNotFitTheSensor) {
    Options options;
    options.window_size = 16;
    EXPECT_THROW(HagenFilter(sensorModel("VLP-16"), options), std::invalid_argument);
    EXPECT_NO_THROW(HagenFilter(sensorModel("HDL-32E"), options));
}

}  // namespace
}  // namespace hagen
