#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/filter/HagenFilter.h>
#include <hagen/scan/Angle.h>
#include "filter/OptionKeys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "support/PaperOptions.h"
#include "support/PointScan.h"
#include "support/Random.h"

namespace hagen {
namespace {

using test::LabelledScan;
using test::paperOptions;
using test::SimpleScene;

const Eigen::Vector3d kTwoMetresUp(0, 0, 2);

/// Number of returns in the zone whose label differs from the ground truth.
int mistakes(const LabelledScan& labelled, const SegmentationResult& result, Label truth) {
    int wrong = 0;
    for (std::size_t i = 0; i < labelled.scan.size(); ++i) {
        if (labelled.scan.range_m[i] > 20.0f || labelled.truth[i] != truth) continue;
        wrong += result.returns.label[i] != truth;
    }
    return wrong;
}

/// Number of missed returns higher than grass, with the ground 2 m below the sensor.
int missedAboveGrass(const LabelledScan& labelled, const SegmentationResult& result) {
    int missed = 0;
    for (std::size_t i = 0; i < labelled.scan.size(); ++i) {
        if (labelled.scan.range_m[i] > 20.0f || labelled.truth[i] != Label::Roi) continue;
        missed += labelled.scan.z_m[i] + 2 > 0.2f && result.returns.label[i] != Label::Roi;
    }
    return missed;
}

int count(const LabelledScan& labelled, Label truth) {
    int number = 0;
    for (std::size_t i = 0; i < labelled.scan.size(); ++i) {
        number += labelled.scan.range_m[i] <= 20.0f && labelled.truth[i] == truth;
    }
    return number;
}

TEST(HagenFilter, PlaneIsRou) {
    for (const char* name : {"VLP-16", "HDL-32E", "HDL-64E"}) {
        const auto ground = test::scanScene({}, sensorModel(name), 870, kTwoMetresUp);
        for (const Options& options : {paperOptions(), Options()}) {
            HagenFilter filter(sensorModel(name), options);
            EXPECT_EQ(mistakes(ground, filter.segment(ground.scan), Label::Rou), 0) << name;
        }
        EXPECT_GT(count(ground, Label::Rou), 4000) << name;
    }
}

TEST(HagenFilter, WallIsRoiAndGroundIsRou) {
    const SimpleScene scene = test::sceneOf({{{10, -5, 0}, {11, 5, 30}}});
    const auto wall = test::scanScene(scene, sensorModel("VLP-16"), 870, kTwoMetresUp);
    EXPECT_GT(count(wall, Label::Roi), 1500);
    HagenFilter papers(sensorModel("VLP-16"), paperOptions());
    const auto& result = papers.segment(wall.scan);
    EXPECT_EQ(mistakes(wall, result, Label::Roi), 0);
    // If a beam hits the ground just before the wall, the slope to the next beam is the wall's.
    const double wall_columns = 870 * 2 * std::atan(5.0 / 10.0) / (2 * kPi);
    EXPECT_LE(mistakes(wall, result, Label::Rou), wall_columns);
    // By height, these returns are ground again; of the wall, at most the lowest row is missed.
    HagenFilter filter(sensorModel("VLP-16"));
    EXPECT_EQ(missedAboveGrass(wall, filter.segment(wall.scan)), 0);
    EXPECT_EQ(mistakes(wall, filter.segment(wall.scan), Label::Rou), 0);
}

TEST(HagenFilter, FloatingBoxIsRoi) {
    const SimpleScene scene = test::sceneOf({{{9, -1, 1.8}, {10, 1, 2.4}}});
    const auto box = test::scanScene(scene, sensorModel("VLP-16"), 870, kTwoMetresUp);
    EXPECT_GT(count(box, Label::Roi), 20);
    for (const Options& options : {paperOptions(), Options()}) {
        HagenFilter filter(sensorModel("VLP-16"), options);
        EXPECT_EQ(mistakes(box, filter.segment(box.scan), Label::Roi), 0);
    }
}

// Limitation of the paper's seeds: the lowest return of each column is labelled ground.
TEST(HagenFilter, NearWallIsRouOnlyInPaper) {
    const SimpleScene scene = test::sceneOf({{{5, -2, 0}, {6, 2, 4}}});
    const auto wall = test::scanScene(scene, sensorModel("VLP-16"), 870, kTwoMetresUp);
    ASSERT_GT(count(wall, Label::Roi), 1500);
    HagenFilter papers(sensorModel("VLP-16"), paperOptions());
    EXPECT_GT(mistakes(wall, papers.segment(wall.scan), Label::Roi), 0.9 * count(wall, Label::Roi));
    HagenFilter filter(sensorModel("VLP-16"));
    EXPECT_EQ(mistakes(wall, filter.segment(wall.scan), Label::Roi), 0);
    EXPECT_EQ(mistakes(wall, filter.segment(wall.scan), Label::Rou), 0);
}

/// The scan of a sensor with this attitude at the same place.
Scan tilted(const Scan& level, const SensorModel& sensor, const Attitude& attitude) {
    const Eigen::Matrix3f sensor_from_level = levelFromSensor(attitude).transpose();
    std::vector<Eigen::Vector3f> points;
    for (std::size_t i = 0; i < level.size(); ++i) {
        points.push_back(sensor_from_level *
                         Eigen::Vector3f(level.x_m[i], level.y_m[i], level.z_m[i]));
    }
    return test::scanOf(sensor, points);
}

TEST(HagenFilter, LoneReturnIsRoi) {
    HagenFilter filter(sensorModel("VLP-16"));
    // The previous scan contains ground.
    filter.segment(test::scanScene({}, sensorModel("VLP-16"), 870, {0, 0, 2}).scan);
    Scan scan;
    scan.x_m = {5.0f};
    scan.y_m = {0.0f};
    scan.z_m = {0.1f};
    scan.intensity = {0.5f};
    locateBeams(filter.sensor(), scan);
    EXPECT_EQ(filter.segment(scan).returns.label, std::vector<Label>{Label::Roi});
}

TEST(HagenFilter, IgnoresUnusedAttitude) {
    const SensorModel sensor = sensorModel("VLP-16");
    const SimpleScene scene = test::sceneOf({}, {{12, 2, 0.15, 8}});
    const auto pole = test::scanScene(scene, sensor, 870, kTwoMetresUp);
    Options options;
    options.level_by_attitude = false;
    HagenFilter filter(sensor, options);
    const auto range_angle_rad = filter.segment(pole.scan).range_angle_rad;
    const auto labels = filter.segment(pole.scan).returns.label;
    EXPECT_TRUE(test::same(filter.segment(pole.scan, Attitude{0.2f, 0.2f}).range_angle_rad,
                           range_angle_rad));
    EXPECT_EQ(filter.segment(pole.scan, Attitude{0.2f, 0.2f}).returns.label, labels);
}

/// The mount determines the image rows, even if angles are relative to the airframe.
TEST(HagenFilter, UpsideDownLabelsMatchUpright) {
    const SensorModel sensor = sensorModel("VLP-16");
    const SimpleScene scene = test::sceneOf({{{15, -20, 0}, {16, 20, 6}}});
    const auto upright = test::scanScene(scene, sensor, 870, {0, 0, 3});
    const Attitude mount{static_cast<float>(kPi), 0};
    const Scan hanging = tilted(upright.scan, sensor, mount);
    for (Options options : {paperOptions(), Options()}) {
        options.level_by_attitude = false;
        HagenFilter filter(sensor, options);
        const std::vector<Label> labels = filter.segment(upright.scan).returns.label;
        const std::vector<Label>& of_hanging = filter.segment(hanging, mount).returns.label;
        ASSERT_EQ(labels.size(), of_hanging.size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < labels.size(); ++i) different += labels[i] != of_hanging[i];
        EXPECT_LT(different, labels.size() / 100);
    }
}

/// The result of another filter has fewer returns behind pixels.
TEST(HagenFilter, IgnoresResultFromOtherFilter) {
    const SensorModel sensor = sensorModel("VLP-16");
    const SimpleScene scene = test::sceneOf({{{10, -5, 0}, {11, 5, 30}}});
    const auto small = test::scanScene({}, sensor, 200, kTwoMetresUp);
    const auto large = test::scanScene(scene, sensor, 870, kTwoMetresUp);
    const std::vector<Label> expected =
        HagenFilter(sensor, paperOptions()).segment(large.scan).returns.label;
    HagenFilter by_ground(sensor), papers(sensor, paperOptions());
    by_ground.segment(small.scan);
    SegmentationResult result;
    by_ground.exchangeResult(result);
    papers.exchangeResult(result);
    const SegmentationResult& r = papers.segment(large.scan);
    EXPECT_EQ(r.returns.label, expected);
    EXPECT_FALSE(r.ground.has_surface);
    EXPECT_TRUE(r.own_labels.label.empty());
}

TEST(HagenFilter, LowGroundAlarmWorksWithoutSurface) {
    const auto ground = test::scanScene({}, sensorModel("VLP-16"), 870, {0, 0, 1});
    Options options = paperOptions();
    options.ground_is_roi_below_m = 1.5f;
    HagenFilter filter(sensorModel("VLP-16"), options);
    const SegmentationResult& result = filter.segment(ground.scan);
    for (std::size_t i = 0; i < ground.scan.size(); ++i) {
        const bool is_near = ground.scan.range_m[i] <= options.zone_m;
        ASSERT_EQ(result.returns.label[i], is_near ? Label::Roi : Label::Rou) << i;
    }
}

TEST(HagenFilter, ReturnBehindPixelHasOwnLabel) {
    const SensorModel sensor = sensorModel("VLP-16");
    auto ground = test::scanScene({}, sensor, 870, kTwoMetresUp);
    const std::size_t behind = static_cast<std::size_t>(
        std::find(ground.scan.row.begin(), ground.scan.row.end(), 0) - ground.scan.row.begin());
    const double azimuth_deg = degrees(static_cast<double>(ground.scan.azimuth_rad[behind]));
    std::vector<Eigen::Vector3f> points;
    for (std::size_t i = 0; i < ground.scan.size(); ++i) {
        points.emplace_back(ground.scan.x_m[i], ground.scan.y_m[i], ground.scan.z_m[i]);
    }
    points.push_back(test::onBeam(sensor, 0, azimuth_deg, 3));
    const Scan scan = test::scanOf(sensor, points);
    HagenFilter filter(sensor);
    EXPECT_EQ(filter.segment(scan).returns.label.back(), Label::Roi);
    EXPECT_EQ(filter.segment(scan).returns.label[behind], Label::Rou);
    HagenFilter papers(sensor, paperOptions());
    EXPECT_EQ(papers.segment(scan).returns.label[behind],
              papers.segment(scan).returns.label.back());
}

TEST(HagenFilter, BeyondZoneIsNeverRoi) {
    const SimpleScene scene = test::sceneOf({{{25, -50, 0}, {26, 50, 30}}});
    const auto wall = test::scanScene(scene, sensorModel("VLP-16"), 870, kTwoMetresUp);
    for (const float context_m : {20.0f, 100.0f}) {
        for (Options options : {paperOptions(), Options()}) {
            options.context_m = context_m;
            HagenFilter filter(sensorModel("VLP-16"), options);
            const auto& result = filter.segment(wall.scan);
            for (const auto i : result.returns.roi) EXPECT_LE(wall.scan.range_m[i], 20.0f);
            EXPECT_EQ(result.returns.unclassified.size(), 0u);
        }
    }
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

TEST(HagenFilter, EveryReturnIsInOneList) {
    for (unsigned seed = 20; seed < 28; ++seed) {
        const SensorModel sensor = sensorModel(seed % 2 == 0 ? "VLP-16" : "HDL-64E");
        const Scan scan = randomScan(seed, sensor);
        for (const Options& options : {paperOptions(), Options()}) {
            HagenFilter filter(sensor, test::numbered(options));
            const SegmentationResult& result = filter.segment(scan);
            const LabelledReturns& returns = result.returns;
            std::vector<int> seen(scan.size(), 0);
            for (const auto& [indices, label] : {std::pair{&returns.roi, Label::Roi},
                                                 {&returns.rou, Label::Rou},
                                                 {&returns.unclassified, Label::Unclassified}}) {
                for (const auto i : *indices) {
                    ++seen[i];
                    ASSERT_EQ(returns.label[i], label);
                    // RoI returns without a component have their own label or no pixel.
                    const bool is_judged_alone =
                        result.range_image.depth_mapper[i] == RangeImage::kNoPixel ||
                        (!result.own_labels.label.empty() &&
                         result.own_labels.label[i] != Label::Unclassified);
                    ASSERT_TRUE(returns.component[i] == 0 || label == Label::Roi);
                    ASSERT_TRUE(returns.component[i] > 0 || label != Label::Roi || is_judged_alone);
                }
            }
            ASSERT_TRUE(
                std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
        }
    }
}

Scan inOrder(const Scan& scan, const SensorModel& sensor, const std::vector<std::size_t>& order) {
    std::vector<Eigen::Vector3f> points;
    for (const std::size_t i : order) {
        points.emplace_back(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
    }
    return test::scanOf(sensor, points);
}

TEST(HagenFilter, IgnoresReturnOrder) {
    for (unsigned seed = 43; seed < 49; ++seed) {
        const SensorModel sensor = sensorModel(seed % 2 == 0 ? "VLP-16" : "HDL-64E");
        const Scan scan = randomScan(seed, sensor);
        std::vector<std::size_t> order(scan.size());
        std::iota(order.begin(), order.end(), 0);
        test::Random random(seed);
        std::shuffle(order.begin(), order.end(), random.engine());
        HagenFilter filter(sensor);
        const std::vector<Label> labels = filter.segment(scan).returns.label;
        const std::vector<Label>& shuffled =
            filter.segment(inOrder(scan, sensor, order)).returns.label;
        for (std::size_t k = 0; k < order.size(); ++k) ASSERT_EQ(shuffled[k], labels[order[k]]);
    }
}

/// The share of returns whose label changes when the scan is rotated by whole columns.
double changedByTurning(const Scan& scan, const SensorModel& sensor, const Options& options,
                        int columns) {
    const double angle_rad = 2 * kPi * columns / 870;
    const Eigen::Matrix3f turn =
        Eigen::AngleAxisf(static_cast<float>(angle_rad), Eigen::Vector3f::UnitZ())
            .toRotationMatrix();
    std::vector<Eigen::Vector3f> points;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        points.push_back(turn * Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]));
    }
    HagenFilter filter(sensor, options);
    const std::vector<Label> labels = filter.segment(scan).returns.label;
    const std::vector<Label>& turned = filter.segment(test::scanOf(sensor, points)).returns.label;
    double changed = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) changed += turned[i] != labels[i];
    return changed / static_cast<double>(labels.size());
}

TEST(HagenFilter, HeadingBarelyAffectsLabels) {
    const SimpleScene scene =
        test::sceneOf({{{8, -5, 0}, {9, 5, 3}}, {{-6, 3, 0}, {-5, 9, 0.4}}}, {{4, 6, 0.15, 8}});
    const SensorModel sensor = sensorModel("VLP-16");
    const Scan scan = test::scanScene(scene, sensor, 870, kTwoMetresUp).scan;
    for (const int columns : {1, 37, 435, 700}) {
        EXPECT_EQ(changedByTurning(scan, sensor, paperOptions(), columns), 0) << columns;
        // The surface's cells do not rotate with the scan.
        EXPECT_LT(changedByTurning(scan, sensor, Options(), columns), 0.01) << columns;
    }
}

TEST(HagenFilter, IgnoresReturnsBeyondContext) {
    for (unsigned seed = 50; seed < 56; ++seed) {
        const SensorModel sensor = sensorModel(seed % 2 == 0 ? "VLP-16" : "HDL-64E");
        const Scan scan = randomScan(seed, sensor);
        std::vector<std::size_t> inside(scan.size());
        std::iota(inside.begin(), inside.end(), 0);
        inside.erase(std::remove_if(inside.begin(), inside.end(),
                                    [&](std::size_t i) { return scan.range_m[i] > 48.0f; }),
                     inside.end());
        ASSERT_LT(inside.size(), scan.size());
        HagenFilter filter(sensor);
        const std::vector<Label> alone =
            filter.segment(inOrder(scan, sensor, inside)).returns.label;
        const std::vector<Label>& labels = filter.segment(scan).returns.label;
        for (std::size_t k = 0; k < inside.size(); ++k) ASSERT_EQ(labels[inside[k]], alone[k]);
    }
}

TEST(HagenFilter, KeepsNoStateBetweenScans) {
    const SensorModel sensor = sensorModel("VLP-16");
    const Scan first = randomScan(40, sensor), other = randomScan(41, sensor);
    HagenFilter filter(sensor);
    const auto labels = filter.segment(first).returns.label;
    filter.segment(other);
    EXPECT_EQ(filter.segment(first).returns.label, labels);
    EXPECT_EQ(filter.segment(first).returns.label, labels);
    EXPECT_EQ(HagenFilter(sensor).segment(first).returns.label, labels);
}

TEST(HagenFilter, ExchangedResultStaysValid) {
    const SensorModel sensor = sensorModel("VLP-16");
    const auto plane = test::scanScene({}, sensor, 870, kTwoMetresUp);
    const SimpleScene with_wall = test::sceneOf({{{8, -3, 0}, {8.5, 3, 3}}});
    const auto wall = test::scanScene(with_wall, sensor, 870, kTwoMetresUp);
    HagenFilter fresh(sensor);
    const SegmentationResult of_wall = fresh.segment(wall.scan);
    const SegmentationResult of_plane = fresh.segment(plane.scan);
    ASSERT_NE(of_wall.returns.roi, of_plane.returns.roi);

    HagenFilter filter(sensor);
    SegmentationResult taken;
    for (int round = 0; round < 3; ++round) {
        filter.segment(wall.scan);
        filter.exchangeResult(taken);
        EXPECT_EQ(filter.segment(plane.scan).returns.label, of_plane.returns.label);
        EXPECT_EQ(taken.returns.label, of_wall.returns.label);
        EXPECT_TRUE((taken.labels == of_wall.labels).all());
    }
}

TEST(HagenFilter, EmptyScanHasNoReturns) {
    HagenFilter filter(sensorModel("VLP-16"));
    const auto& result = filter.segment(Scan());
    EXPECT_TRUE(result.returns.label.empty());
    EXPECT_TRUE(result.maxima.empty());
    EXPECT_TRUE((result.labels == Label::Unclassified).all());
    EXPECT_TRUE(result.ground.height_m.isNaN().all());
    EXPECT_TRUE((result.ground.surface.height_m == 0).all());
}

/// Gentle hills with plants and obstacles; all ranges are different.
Scan hillyScan(unsigned seed, const SensorModel& sensor) {
    test::Random random(seed);
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 15000; ++i) {
        const float x_m = random.real(-24, 24), y_m = random.real(-24, 24);
        const float ground_m = -2 + 0.05f * x_m + 0.3f * std::sin(0.3f * y_m);
        const bool is_thicket = x_m < -15 && y_m > 0;  // no visible ground
        const float above_m = is_thicket                            ? random.real(0.5f, 0.9f)
                              : random.chance(0.3)                  ? random.real(0, 0.4f)
                              : random.chance(x_m > 0 ? 0.5 : 0.01) ? random.real(0, 3)
                                                                    : 0.0f;
        points.emplace_back(x_m, y_m, ground_m + above_m);
    }
    return test::scanOf(sensor, points);
}

/// All result images that an option may change.
std::vector<Image<float>> imagesWith(const Options& options, const Scan& scan) {
    HagenFilter filter(sensorModel("HDL-32E"), test::numbered(options));
    const SegmentationResult& r = filter.segment(scan, Attitude{0.05f, -0.08f});
    const auto numbers = [](const auto& of) {
        Image<float> image(1, static_cast<Eigen::Index>(of.size()));
        std::transform(of.begin(), of.end(), image.data(),
                       [](const auto value) { return static_cast<float>(value); });
        return image;
    };
    return {
        r.range_image.depth_m,       r.repaired_m,   r.sharpened_m,     r.merged_m,
        r.range_angle_rad,           r.smoothed_rad, r.pixel_angle_rad, numbers(r.returns.label),
        numbers(r.returns.component)};
}

// A voxel filter keeps one return per 0.1 m: rings and columns have gaps.
TEST(HagenFilter, SeparatesVoxelFilteredClouds) {
    const SensorModel sensor = sensorModel("VLP-16");
    const test::LabelledScan seen = test::scanScene(test::yard(), sensor, 870, {0, 0, 2});
    std::set<std::array<int, 3>> voxels;
    test::LabelledScan kept;
    for (std::size_t i = 0; i < seen.scan.size(); ++i) {
        const auto cell = [](float m) { return static_cast<int>(std::floor(10 * m)); };
        const float x_m = seen.scan.x_m[i], y_m = seen.scan.y_m[i], z_m = seen.scan.z_m[i];
        if (!voxels.insert({cell(x_m), cell(y_m), cell(z_m)}).second) continue;
        kept.scan.x_m.push_back(x_m);
        kept.scan.y_m.push_back(y_m);
        kept.scan.z_m.push_back(z_m);
        kept.truth.push_back(seen.truth[i]);
    }
    kept.scan.intensity.resize(kept.scan.size());
    ASSERT_LT(2 * kept.scan.size(), 2 * seen.scan.size() - 2000);
    locateBeams(sensor, kept.scan);
    HagenFilter filter(sensor);
    const std::vector<Label>& label = filter.segment(kept.scan).returns.label;
    std::map<Label, std::size_t> of, right;
    for (std::size_t i = 0; i < label.size(); ++i) {
        if (kept.scan.range_m[i] > 20) continue;
        ++of[kept.truth[i]];
        right[kept.truth[i]] += label[i] == kept.truth[i];
    }
    for (const Label truth : {Label::Roi, Label::Rou}) {
        EXPECT_GT(of[truth], 300u);
        EXPECT_GE(100 * right[truth], 97 * of[truth]) << static_cast<int>(truth);
    }
}

TEST(HagenFilter, RawAnglesEqualDisabledSharpeningAndSmoothing) {
    const Scan scan = hillyScan(58, sensorModel("HDL-32E"));
    for (Options disabled : {paperOptions(), Options()}) {
        Options raw = disabled;
        raw.raw_angles = true;
        disabled.persistence_m = 1000;  // no maximum is sharpened
        disabled.principal_components = disabled.window_size;
        HagenFilter filter(sensorModel("HDL-32E"), raw), slow(sensorModel("HDL-32E"), disabled);
        const SegmentationResult &result = filter.segment(scan), &expected = slow.segment(scan);
        EXPECT_TRUE(test::same(result.pixel_angle_rad, expected.pixel_angle_rad));
        EXPECT_EQ(result.returns.label, expected.returns.label);
        EXPECT_TRUE(result.maxima.empty());
        EXPECT_EQ(result.smoothed_rad.size(), 0);
    }
}

/// The name of the first image that an option changes; each stage has its own options.
TEST(HagenFilter, EveryOptionReachesItsStage) {
    enum { Depth, Repaired, Sharpened, Merged, Angle, Smoothed, OfPixel, Labels, Components };
    const std::map<std::string, int> stages{{"context_m", Depth},
                                            {"columns", Depth},
                                            {"repair_max_step_m", Repaired},
                                            {"persistence_m", Sharpened},
                                            {"sharpening_sigma_px", Sharpened},
                                            {"sharpening_sigma_m", Sharpened},
                                            {"sharpen_by_neighbours", Sharpened},
                                            {"sharpen_proximity", Sharpened},
                                            {"raw_angles", Sharpened},
                                            {"level_by_attitude", Angle},
                                            {"gaps_are_level", Angle},
                                            {"window_size", Smoothed},
                                            {"principal_components", Smoothed},
                                            {"angle_to_beam_above", OfPixel},
                                            {"component_gap_m", Components}};
    const Scan scan = hillyScan(57, sensorModel("HDL-32E"));
    Options standard;
    standard.ground_is_roi_below_m = 1.2f;
    standard.canopy_layer = false;  // it would hide the other tolerances
    standard.ground_tolerance_per_m = 0.02f;
    standard.ground_tolerance_beside_tall = 0.2f;
    standard.ground_evidence = false;  // this ground is too rough
    const auto expected = imagesWith(standard, scan);
    for (const OptionKey& key : optionKeys()) {
        const bool is_of_window = key.name.find("window_") == 0 || key.name == "label_window";
        if (key.name == "zone_m" || key.name == "bridge_dead_beams" ||
            (is_of_window && key.name != "window_size")) {
            continue;  // tested separately
        }
        Options changed = standard;
        if (const auto* real = std::get_if<float Options::*>(&key.field)) {
            changed.*(*real) *= 0.5f;
        } else if (const auto* whole = std::get_if<int Options::*>(&key.field)) {
            changed.*(*whole) -= 1;
        } else if (const auto* yes = std::get_if<bool Options::*>(&key.field)) {
            changed.*(*yes) = !(changed.*(*yes));
        } else {
            changed.seeds = Seeds::TopAndNearest;
        }
        const auto found = imagesWith(changed, scan);
        const int first = stages.count(key.name) > 0 ? stages.at(key.name) : Labels;
        for (int image = Depth; image < first; ++image) {
            EXPECT_TRUE(test::same(found[image], expected[image])) << key.name << " " << image;
        }
        EXPECT_FALSE(test::same(found[first], expected[first]))
            << key.name << " has no effect; if it is off by default, set it in `standard`";
    }
}

TEST(HagenFilter, RejectsRowsFromOtherSensor) {
    for (const auto& [own, other] : {std::pair{"VLP-16", "HDL-64E"}, {"HDL-64E", "VLP-16"}}) {
        HagenFilter filter(sensorModel(own));
        const auto ground = test::scanScene({}, sensorModel(own), 870, kTwoMetresUp);
        const SegmentationResult& result = filter.segment(ground.scan);
        const std::vector<Label> labels = result.returns.label;
        auto others = test::scanScene({}, sensorModel(other), 870, kTwoMetresUp);
        EXPECT_THAT([&] { filter.segment(others.scan); },
                    testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr(own)));
        EXPECT_EQ(result.returns.label, labels);
        EXPECT_EQ(filter.segment(ground.scan).returns.label, labels);
        locateBeams(filter.sensor(), others.scan);  // as the message suggests
        EXPECT_NO_THROW(filter.segment(others.scan));
    }
}

TEST(HagenFilter, RejectsOptionsUnfitForSensor) {
    Options options;
    options.window_size = 16;
    EXPECT_THROW(HagenFilter(sensorModel("VLP-16"), options), std::invalid_argument);
    EXPECT_NO_THROW(HagenFilter(sensorModel("HDL-32E"), options));
}

}  // namespace
}  // namespace hagen
