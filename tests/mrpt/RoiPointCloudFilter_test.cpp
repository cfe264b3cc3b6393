#include <gtest/gtest.h>
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/RoiPointCloudFilter.h>

#include "support/SimpleScene.h"

namespace hagen::observations {
namespace {

using mrpt::poses::CPose3D;

/// A pole on flat ground, and the result of HagenFilter.
struct Example {
    Scan scan;
    LabelledReturns expected;
    mrpt::maps::CSimplePointsMap cloud;

    explicit Example(const CPose3D& sensor_pose = {}) {
        const test::SimpleScene scene = test::sceneOf({}, {{12, 2, 0.15, 8}});
        scan = test::scanScene(scene, sensorModel("VLP-16"), 870, {0, 0, 2}).scan;
        HagenFilter filter(sensorModel("VLP-16"));
        expected = filter.segment(scan).returns;
        for (std::size_t i = 0; i < scan.size(); ++i) {
            const auto point = sensor_pose.composePoint({scan.x_m[i], scan.y_m[i], scan.z_m[i]});
            cloud.insertPoint(point);
        }
    }
};

TEST(RoiPointCloudFilter, KeepsRoiPoints) {
    Example example;
    RoiPointCloudFilter filter{Settings()};
    filter.filter(&example.cloud, mrpt::Clock::now(), CPose3D());
    ASSERT_EQ(example.cloud.size(), example.expected.roi.size());
    EXPECT_GT(example.cloud.size(), 40u);
    for (const float x_m : example.cloud.getPointsBufferRef_x()) EXPECT_NEAR(x_m, 12.0f, 0.2f);
}

TEST(RoiPointCloudFilter, RecoversUnnamedSensor) {
    const test::SimpleScene scene = test::sceneOf({}, {{12, 2, 0.15, 8}});
    const SensorModel sensor = sensorModel("HDL-64E");
    const Scan scan = test::scanScene(scene, sensor, 600, {0, 0, 2}).scan;
    Options options;
    options.columns = 600;
    HagenFilter expected(sensor, options);
    mrpt::maps::CSimplePointsMap cloud;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        cloud.insertPoint(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
    }
    RoiPointCloudFilter filter{Settings()};
    filter.filter(&cloud, mrpt::Clock::now(), CPose3D());
    EXPECT_EQ(cloud.size(), expected.segment(scan).returns.roi.size());
    EXPECT_GT(cloud.size(), 50u);
}

TEST(RoiPointCloudFilter, MarksWithoutDeleting) {
    Example example;
    RoiPointCloudFilter filter{Settings()};
    std::vector<bool> deleted;
    mrpt::maps::CPointCloudFilterBase::TExtraFilterParams params;
    params.out_deletion_mask = &deleted;
    params.do_not_delete = true;
    filter.filter(&example.cloud, mrpt::Clock::now(), CPose3D(), &params);
    EXPECT_EQ(example.cloud.size(), example.scan.size());
    ASSERT_EQ(deleted.size(), example.scan.size());
    for (std::size_t i = 0; i < deleted.size(); ++i) {
        EXPECT_EQ(deleted[i], example.expected.label[i] != Label::Roi);
    }
}

TEST(RoiPointCloudFilter, AcceptsVehicleFrameClouds) {
    const CPose3D sensor_pose(0.3, -0.1, 0.8, 0.5, 0.0, 0.0);
    Example example(sensor_pose);
    RoiPointCloudFilter filter(Settings(), sensor_pose);
    filter.filter(&example.cloud, mrpt::Clock::now(), CPose3D());
    EXPECT_EQ(example.cloud.size(), example.expected.roi.size());
}

TEST(RoiPointCloudFilter, AcceptsEmptyClouds) {
    mrpt::maps::CSimplePointsMap cloud;
    RoiPointCloudFilter filter{Settings()};
    filter.filter(&cloud, mrpt::Clock::now(), CPose3D());
    EXPECT_EQ(cloud.size(), 0u);
}

TEST(RoiPointCloudFilter, RejectsInvalidSettings) {
    Settings settings;
    settings.options.window_size = 40;
    EXPECT_THROW(RoiPointCloudFilter{settings}, SettingsError);
}

}  // namespace
}  // namespace hagen::observations
