#include "filter/ground/FartherReturns.h"
#include <gtest/gtest.h>
#include "filter/FilterWorkspace.h"

#include <cmath>

#include "support/PointScan.h"

namespace hagen {
namespace {

constexpr float kZone_m = 20;

/// Level ground 2 m below a VLP-16, and the labels of farther returns.
struct TwoMetresUp {
    SensorModel sensor = sensorModel("VLP-16");
    Ground ground;

    TwoMetresUp() {
        ground.has_surface = true;
        ground.from_sensor = Eigen::Isometry3f::Identity();
        ground.from_sensor.translation().z() = 2;
        ground.surface.height_m =
            Eigen::ArrayXXf::Zero(GroundSurface::kCells, GroundSurface::kCells);
        ground.tolerance_m.setConstant(16, 870, 0.2f);
    }

    std::vector<Label> judged(const std::vector<Eigen::Vector3f>& points_m,
                              float min_clearance_m = 0) const {
        static FilterWorkspace work;  // reused, as in a filter
        const Scan scan = test::scanOf(sensor, points_m);
        RangeImage image;
        projectScan(scan, sensor, 870, 48.0f, image, work.projection);
        OwnLabels own_labels{std::vector<Label>(99, Label::Roi), {7, 8}};  // from an earlier scan
        judgeFartherReturns(scan, image, ground, {Eigen::Vector3f::UnitZ(), min_clearance_m},
                            kZone_m, own_labels, work.farther_returns);
        std::vector<std::int32_t> labelled;
        for (std::size_t i = 0; i < own_labels.label.size(); ++i) {
            if (own_labels.label[i] != Label::Unclassified)
                labelled.push_back(static_cast<std::int32_t>(i));
        }
        EXPECT_EQ(own_labels.returns, labelled);
        return own_labels.label;
    }
    Eigen::Vector3f on(int row, double range_m) const {
        return test::onBeam(sensor, row, 30.1, range_m);
    }
};

constexpr Label kAsItsPixel = Label::Unclassified;

TEST(FartherReturns, FollowPixelWithinThirtyCentimetres) {
    const TwoMetresUp example;
    EXPECT_EQ(example.judged({example.on(8, 5), example.on(8, 5.29), example.on(8, 5.31)}),
              (std::vector<Label>{kAsItsPixel, kAsItsPixel, Label::Roi}));
}

TEST(FartherReturns, MeasuresHeightAboveSurface) {
    TwoMetresUp example;
    const Eigen::Vector3f low_bush = example.on(0, 7);  // 0.19 m above the ground
    const Eigen::Vector3f bush = example.on(0, 6.9);    // 0.21 m
    EXPECT_EQ(example.judged({example.on(0, 3), low_bush})[1], Label::Rou);
    EXPECT_EQ(example.judged({example.on(0, 3), bush})[1], Label::Roi);
    example.ground.surface.height_m.setConstant(-0.1f);
    EXPECT_EQ(example.judged({example.on(0, 3), low_bush})[1], Label::Roi);
    example.ground.surface.height_m.setConstant(0.1f);
    EXPECT_EQ(example.judged({example.on(0, 3), bush})[1], Label::Rou);
}

TEST(FartherReturns, UsesPixelTolerances) {
    TwoMetresUp example;
    const Scan scan = test::scanOf(example.sensor, {example.on(0, 7)});
    RangeImage image;
    ProjectionWorkspace work;
    projectScan(scan, example.sensor, 870, 48.0f, image, work);
    example.ground.tolerance_m.data()[image.depth_mapper[0]] = 0.1f;
    EXPECT_EQ(example.judged({example.on(0, 3), example.on(0, 7)})[1], Label::Roi);
}

TEST(FartherReturns, FarBelowSurfaceIsRoi) {
    TwoMetresUp example;
    const std::vector<Eigen::Vector3f> points{example.on(0, 3), example.on(0, 7)};  // 0.19 m up
    example.ground.surface.height_m.setConstant(1.68f);
    EXPECT_EQ(example.judged(points)[1], Label::Rou);
    example.ground.surface.height_m.setConstant(1.7f);
    EXPECT_EQ(example.judged(points)[1], Label::Roi);
}

// 7 m along the beam end at (6.7, 1.2) m: in the third block along x and the first along y.
TEST(FartherReturns, WithoutEvidenceAreRoi) {
    TwoMetresUp example;
    const auto labelWithout = [&](const std::vector<std::size_t>& blocks) {
        example.ground.has_evidence.assign(PixelCells::kNoBlock + 1u, 1);
        for (const std::size_t block : blocks) example.ground.has_evidence[block] = 0;
        return example.judged({test::onBeam(example.sensor, 0, 10.1, 3),
                               test::onBeam(example.sensor, 0, 10.1, 7)})[1];
    };
    constexpr std::size_t kSide = 32, kOwn = 16 * kSide + 18;
    EXPECT_EQ(labelWithout({}), Label::Rou);
    EXPECT_EQ(labelWithout({kOwn}), Label::Roi);
    EXPECT_EQ(labelWithout({kOwn - 1, kOwn + 1, kOwn - kSide, kOwn + kSide, PixelCells::kNoBlock}),
              Label::Rou);
}

TEST(FartherReturns, IgnoresReturnsBeyondZone) {
    const TwoMetresUp example;
    EXPECT_EQ(example.judged({example.on(8, 5), example.on(8, 19.9), example.on(8, 20.1)}),
              (std::vector<Label>{kAsItsPixel, Label::Roi, kAsItsPixel}));
}

// From 2 m above level ground, every ground return is 2 m below the sensor.
TEST(FartherReturns, TooCloseGroundIsRoi) {
    const TwoMetresUp example;
    const double to_ground_m = 2 / std::sin(radians(15));  // range of the lowest beam
    const std::vector<Eigen::Vector3f> points{example.on(0, to_ground_m), example.on(0, 3)};
    EXPECT_EQ(example.judged(points, 1.9f), (std::vector<Label>{Label::Rou, kAsItsPixel}));
    EXPECT_EQ(example.judged(points, 2.1f), (std::vector<Label>{Label::Roi, kAsItsPixel}));
}

TEST(FartherReturns, NeedsSurface) {
    TwoMetresUp example;
    example.ground.has_surface = false;
    EXPECT_TRUE(example.judged({example.on(8, 5), example.on(8, 12)}, 3).empty());
}

}  // namespace
}  // namespace hagen
