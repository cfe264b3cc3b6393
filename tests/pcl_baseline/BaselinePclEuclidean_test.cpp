#include <gtest/gtest.h>
#include <hagen/pcl_baseline/BaselinePclEuclidean.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "support/BaselineRules.h"
#include "support/PointScan.h"

namespace hagen::evaluation {
namespace {

const SensorModel kSensor = sensorModel("VLP-16");

/// `count` points from `from_m` upwards, one per voxel of 0.2 m.
void addPost(const Eigen::Vector3f& from_m, int count, std::vector<Eigen::Vector3f>& points_m) {
    for (int i = 0; i < count; ++i) {
        points_m.push_back(from_m + 0.4f * static_cast<float>(i) * Eigen::Vector3f::UnitZ());
    }
}

/// Level ground around the sensor.
std::vector<Eigen::Vector3f> ground() {
    std::vector<Eigen::Vector3f> points_m;
    for (float x = -12.0f; x <= 12.0f; ++x) {
        for (float y = -12.0f; y <= 12.0f; ++y) points_m.emplace_back(x, y + 0.1f, -1.5f);
    }
    return points_m;
}

int roiCount(const std::vector<Eigen::Vector3f>& points_m, const PclEuclideanOptions& options) {
    const auto labels = pclEuclideanLabels(test::scanOf(kSensor, points_m), kSensor, options);
    return static_cast<int>(std::count(labels.begin(), labels.end(), Label::Roi));
}

TEST(PclEuclidean, SeparatesObstaclesFromFlatGround) {
    test::SimpleScene scene;
    scene.poles.push_back({6.0, 3.0, 0.3, 4.0});
    scene.boxes.push_back({{-9.0, -8.0, 0.0}, {-8.5, 8.0, 3.0}});
    const auto labelled = test::scanScene(scene, kSensor, 720, {0.0, 0.0, 1.5});
    const std::vector<Label> labels = pclEuclideanLabels(labelled.scan, kSensor);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const float height_m = labelled.scan.z_m[i] + 1.5f;
        const bool is_near = labelled.scan.range_m[i] <= 20.0f;
        if (!is_near || std::abs(height_m - 0.2f) < 0.15f) continue;  // half a voxel, plus tilt
        EXPECT_EQ(labels[i], height_m > 0.2f ? Label::Roi : Label::Rou) << "at height " << height_m;
    }
}

TEST(PclEuclidean, FitsTiltedPlane) {
    std::vector<Eigen::Vector3f> points_m = ground();
    const std::size_t of_ground = points_m.size();
    addPost({8.0f, 0.0f, -0.9f}, 12, points_m);
    const Eigen::Matrix3f tilt =
        Eigen::AngleAxisf(0.35f, Eigen::Vector3f(0.6f, 0.8f, 0.0f)).toRotationMatrix();  // 20 deg
    for (Eigen::Vector3f& p : points_m) p = tilt * p;
    const auto labels = pclEuclideanLabels(test::scanOf(kSensor, points_m), kSensor);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        EXPECT_EQ(labels[i], i < of_ground ? Label::Rou : Label::Roi) << i;
    }
}

TEST(PclEuclidean, JoinsClustersWithinTolerance) {
    PclEuclideanOptions options;
    options.min_cluster_points = 10;  // each post has six points
    const auto twoPosts = [&](float gap_m) {
        std::vector<Eigen::Vector3f> points_m = ground();
        addPost({6.5f, 2.05f, -0.9f}, 6, points_m);
        addPost({6.5f, 2.05f + gap_m, -0.9f}, 6, points_m);
        return roiCount(points_m, options);
    };
    EXPECT_EQ(twoPosts(0.6f), 12);
    EXPECT_EQ(twoPosts(0.8f), 0);
    options.min_cluster_points = 6;
    EXPECT_EQ(twoPosts(0.8f), 12);
}

TEST(PclEuclidean, LabelsReturnsByVoxel) {
    std::vector<Eigen::Vector3f> points_m = ground();
    addPost({6.5f, 2.05f, -0.9f}, 12, points_m);
    for (int i = 0; i < 12; ++i) {  // adds a second return to each voxel
        points_m.push_back(points_m[points_m.size() - 12] + Eigen::Vector3f(0.01f, 0.01f, 0.01f));
    }
    EXPECT_EQ(roiCount(points_m, {}), 24);
}

TEST(PclEuclidean, RejectsWallsAsGround) {
    std::vector<Eigen::Vector3f> points_m;  // only a wall
    for (int y = -20; y <= 20; ++y)
        addPost({6.0f, 0.3f * static_cast<float>(y), -1.0f}, 8, points_m);
    EXPECT_EQ(roiCount(points_m, {}), static_cast<int>(points_m.size()));
}

TEST(PclEuclidean, RejectsInvalidOptions) {
    PclEuclideanOptions options;
    options.leaf_m = 0.0f;
    EXPECT_THROW(pclEuclideanLabels({}, kSensor, options), std::invalid_argument);
    options.leaf_m = 0.01f;  // 4000 voxels per side
    EXPECT_THROW(pclEuclideanLabels({}, kSensor, options), std::invalid_argument);
    options = {};
    options.min_cluster_points = 0;
    EXPECT_THROW(pclEuclideanLabels({}, kSensor, options), std::invalid_argument);
}

TEST(PclEuclidean, FollowsCommonRules) {
    for (const float zone_m : {8.0f, 20.0f}) {
        for (const Baseline& baseline : pclBaselines(zone_m)) {
            test::expectBaselineRules(baseline, zone_m);
        }
    }
}

}  // namespace
}  // namespace hagen::evaluation
