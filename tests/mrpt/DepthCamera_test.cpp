#include "mrpt/DepthCamera.h"
#include <gmock/gmock.h>
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/scan/Angle.h>
#include <mrpt/io/lazy_load_path.h>

#include <cmath>

#include "support/Program.h"
#include "support/SimpleScene.h"

namespace hagen::observations {
namespace {

using mrpt::obs::CObservation3DRangeScan;
using testing::HasSubstr;

constexpr int kRows = 48, kColumns = 64;

mrpt::img::TCamera camera() {
    mrpt::img::TCamera camera;
    camera.ncols = kColumns;
    camera.nrows = kRows;
    camera.setIntrinsicParamsFromValues(57.0, 55.0, 31.5, 24.25);
    return camera;
}

/// A range image in which all pixels differ and one has no range.
CObservation3DRangeScan::Ptr rangeImage() {
    auto observation = CObservation3DRangeScan::Create();
    observation->hasRangeImage = true;
    observation->cameraParams = camera();
    observation->rangeUnits = 0.002f;
    observation->rangeImage.resize(kRows, kColumns);
    for (int r = 0; r < kRows; ++r) {
        for (int c = 0; c < kColumns; ++c) {
            observation->rangeImage(r, c) = static_cast<std::uint16_t>(500 + 31 * r + 7 * c);
        }
    }
    observation->rangeImage(3, 5) = 0;
    return observation;
}

/// Coordinates computed by MRPT.
std::vector<float> unprojected(CObservation3DRangeScan observation) {
    mrpt::obs::T3DPointsProjectionParams parameters;
    parameters.USE_SSE2 = false;
    PortableCloud cloud;
    observation.unprojectInto(cloud, parameters);
    std::vector<float> coordinates;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        float x = 0, y = 0, z = 0;
        cloud.getPoint(i, x, y, z);
        coordinates.insert(coordinates.end(), {x, y, z});
    }
    return coordinates;
}

void expectSame(const std::vector<float>& coordinates, const Scan& scan, float tolerance_m) {
    ASSERT_EQ(coordinates.size(), 3 * scan.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
        ASSERT_NEAR(coordinates[3 * i], scan.x_m[i], tolerance_m) << i;
        ASSERT_NEAR(coordinates[3 * i + 1], scan.y_m[i], tolerance_m) << i;
        ASSERT_NEAR(coordinates[3 * i + 2], scan.z_m[i], tolerance_m) << i;
    }
}

std::string errorOf(const CObservation3DRangeScan& observation) {
    Scan scan;
    return test::messageOf([&] { readDepthScan(observation, scan); });
}

TEST(DepthCamera, MatchesMrptUnprojection) {
    const auto observation = rangeImage();
    Scan scan;
    for (const bool is_depth : {true, false}) {
        observation->range_is_depth = is_depth;
        readDepthScan(*observation, scan);
        EXPECT_EQ(scan.size(), std::size_t{kRows * kColumns - 1});
        expectSame(unprojected(*observation), scan, 1e-5f);
    }
}

TEST(DepthCamera, RemovesLensDistortion) {
    const auto observation = rangeImage();
    observation->cameraParams.setDistortionPlumbBob(-0.12, 0.05, 0.002, -0.001, 0.01);
    Scan scan;
    readDepthScan(*observation, scan);
    // MRPT's inversion stops after a few steps, unlike ours.
    expectSame(unprojected(*observation), scan, 2e-3f);
    // By the published formula, each return projects to its pixel.
    const auto& camera = observation->cameraParams;
    std::size_t i = 0;
    for (int r = 0; r < kRows; ++r) {
        for (int c = 0; c < kColumns; ++c) {
            if (observation->rangeImage(r, c) == 0) continue;
            const double x = static_cast<double>(-scan.y_m[i] / scan.x_m[i]);
            const double y = static_cast<double>(-scan.z_m[i] / scan.x_m[i]);
            const double r2 = x * x + y * y;
            const double radial = 1 - 0.12 * r2 + 0.05 * r2 * r2 + 0.01 * r2 * r2 * r2;
            const double right = x * radial + 2 * 0.002 * x * y - 0.001 * (r2 + 2 * x * x);
            const double down = y * radial + 0.002 * (r2 + 2 * y * y) - 2 * 0.001 * x * y;
            ASSERT_NEAR(right * camera.fx() + camera.cx(), c, 1e-3);
            ASSERT_NEAR(down * camera.fy() + camera.cy(), r, 1e-3);
            ++i;
        }
    }
}

TEST(DepthCamera, PrefersStoredPoints) {
    const auto observation = rangeImage();
    observation->hasPoints3D = true;
    observation->points3D_x = {1, 0, 2, NAN};
    observation->points3D_y = {0, 0, 3, 0};
    observation->points3D_z = {0, 0, 4, 0};
    Scan scan;
    readDepthScan(*observation, scan);
    EXPECT_EQ(scan.x_m, (std::vector<float>{1, 2}));
    EXPECT_EQ(scan.z_m, (std::vector<float>{0, 4}));
    EXPECT_TRUE(isLidarScan(*observation));
    EXPECT_TRUE(isCloud(*observation));
    observation->hasPoints3D = observation->hasRangeImage = false;
    EXPECT_FALSE(isLidarScan(*observation));  // only a picture is left
}

TEST(DepthCamera, ReadsAllLayers) {
    const auto observation = rangeImage();
    observation->rangeImageOtherLayers["LAST"] = observation->rangeImage;
    Scan scan;
    readDepthScan(*observation, scan);
    EXPECT_EQ(scan.size(), 2u * (kRows * kColumns - 1));
    observation->rangeImageOtherLayers["LAST"].resize(2, 2);
    EXPECT_THAT(errorOf(*observation), HasSubstr("'LAST'"));
}

TEST(DepthCamera, ReadsExternalFiles) {
    const test::TemporaryFolder folder;
    const std::string path = folder.path().string() + "/";
    const std::string before = mrpt::io::getLazyLoadPathBase();
    mrpt::io::setLazyLoadPathBase(path);
    const auto observation = rangeImage();
    Scan expected, scan;
    readDepthScan(*observation, expected);
    observation->rangeImage_convertToExternalStorage("ranges.bin", path);
    observation->unload();
    EXPECT_EQ(observation->rangeImage.rows(), 0);
    readDepthScan(*observation, scan);
    EXPECT_EQ(scan.x_m, expected.x_m);
    observation->unload();
    std::filesystem::remove(folder / "ranges.bin");
    EXPECT_THAT(errorOf(*observation), HasSubstr("ranges"));
    mrpt::io::setLazyLoadPathBase(before);
}

TEST(DepthCamera, RejectsInvalidScans) {
    const auto errorWith = [](const auto& change) {
        const auto observation = rangeImage();
        change(*observation);
        return errorOf(*observation);
    };
    EXPECT_THAT(errorWith([](auto& o) { o.rangeUnits = 0; }), HasSubstr("unit"));
    EXPECT_THAT(errorWith([](auto& o) { o.rangeUnits = NAN; }), HasSubstr("unit"));
    EXPECT_THAT(errorWith([](auto& o) { o.cameraParams.intrinsicParams.setZero(); }),
                HasSubstr("focal length"));
    EXPECT_THAT(errorWith([](auto& o) { o.cameraParams.setDistortionKannalaBrandt(0.1, 0, 0, 0); }),
                HasSubstr("distortion"));
    using Points = CObservation3DRangeScan;
    for (const auto missing : {&Points::points3D_y, &Points::points3D_z}) {
        EXPECT_THAT(errorWith([&](auto& o) {
                        o.hasPoints3D = true;
                        o.points3D_x = o.points3D_y = o.points3D_z = {1};
                        (o.*missing).clear();
                    }),
                    HasSubstr("differ in size"));
    }
}

/// A camera of 58 x 45 degrees, 1.5 m above flat ground with a pole at 6 m: its view, with the
/// truth of each return.
struct Seen {
    CObservation3DRangeScan::Ptr observation = rangeImage();
    std::vector<Label> truth;
};
Seen groundAndPole(double down_deg) {
    constexpr int kTall = 120, kWide = 160;
    const test::SimpleScene scene = test::sceneOf({}, {{6, 1, 0.15, 4}});
    Seen seen;
    CObservation3DRangeScan& observation = *seen.observation;
    observation.rangeUnits = 0.001f;
    observation.cameraParams.setIntrinsicParamsFromValues(0.9 * kWide, 0.9 * kWide, 79.5, 59.5);
    observation.rangeImage.setZero(kTall, kWide);
    observation.sensorPose = mrpt::poses::CPose3D(0, 0, 1.5, 0, radians(down_deg), 0);
    const auto& camera = observation.cameraParams;
    for (int r = 0; r < kTall; ++r) {
        for (int c = 0; c < kWide; ++c) {
            const mrpt::math::TVector3D ray(1, (camera.cx() - c) / camera.fx(),
                                            (camera.cy() - r) / camera.fy());
            const auto turned = observation.sensorPose.rotateVector(ray);
            const Eigen::Vector3d direction(turned.x, turned.y, turned.z);
            const test::Hit hit = test::castRay(scene, {0, 0, 1.5}, direction.normalized());
            const double depth_m = hit.range_m / ray.norm();
            if (!(depth_m < 20)) continue;
            observation.rangeImage(r, c) = static_cast<std::uint16_t>(std::lround(1000 * depth_m));
            seen.truth.push_back(hit.label);
        }
    }
    return seen;
}

// docs/without-rings.md has results for other sizes.
TEST(DepthCamera, SeparatesPoleFromGround) {
    for (const double down_deg : {0.0, 15.0, 30.0}) {
        const Seen seen = groundAndPole(down_deg);
        ObservationSegmenter segmenter;
        segmenter.setMinLoggingLevel(mrpt::system::LVL_ERROR);
        segmenter.initialize({});
        ObservationSegmenter::Output out;
        ASSERT_TRUE(segmenter.process(*seen.observation, out));
        ASSERT_EQ(out.scan->size(), seen.truth.size());
        ASSERT_NE(out.recovered, nullptr);
        EXPECT_FALSE(out.sensor->has_rings);
        std::size_t pole = 0, found = 0, ground = 0, clear = 0;
        for (std::size_t i = 0; i < seen.truth.size(); ++i) {
            const bool is_roi = out.result->returns.label[i] == Label::Roi;
            const bool is_pole = seen.truth[i] == Label::Roi;
            pole += is_pole;
            ground += !is_pole;
            found += is_pole && is_roi;
            clear += !is_pole && !is_roi;
        }
        EXPECT_GT(pole, 100u);
        EXPECT_GE(100 * found, 98 * pole) << down_deg;
        EXPECT_EQ(clear, ground) << down_deg;
    }
}

}  // namespace
}  // namespace hagen::observations
