#include "convert/ScanFolderWriter.h"
#include <gmock/gmock.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/settings/Settings.h>
#include "recordings/PoseFile.h"

#include "support/Program.h"

namespace hagen::convert {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

Scan threePoints() {
    Scan scan;
    scan.x_m = {1, 2, 3};
    scan.y_m = {4, 5, 6};
    scan.z_m = {7, 8, 9};
    scan.intensity = {0, 0.5f, 1};
    return scan;
}

LabelledReturns labels() {
    LabelledReturns returns;
    returns.label = {Label::Roi, Label::Rou, Label::Unclassified};
    returns.component = {1, 0, 0};
    return returns;
}

TEST(ScanFolderWriter, WritesReadableFolder) {
    const test::TemporaryFolder folder;
    const SensorModel sensor = sensorModel("HDL-32E");
    ScanFolderWriter writer(folder.path());
    writer.write("000000", threePoints(), labels(), sensor, 50.0);
    writer.write("000001", threePoints(), labels(), sensor, 50.1);
    writer.finish();

    const recordings::ScanFolder read(folder.path());
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read.name(1), "000001");
    EXPECT_EQ(recordings::readLabels(read.labelFile(1)), (std::vector<std::uint16_t>{2, 1, 0}));
    ASSERT_EQ(read.times().size(), 2u);
    EXPECT_NEAR(read.times()[0], 50.0, 1e-6);
    EXPECT_NEAR(read.times()[1], 50.1, 1e-6);
    EXPECT_FALSE(fs::exists(read.tumFile()));
    Scan scan;
    recordings::readScan(read.scanFile(0), scan);
    EXPECT_EQ(scan.z_m, threePoints().z_m);
    EXPECT_EQ(scan.intensity, threePoints().intensity);

    Settings settings;
    mergeSettings(read.sensorFile(), settings);
    EXPECT_EQ(settings.sensorModel().elevations_rad, sensor.elevations_rad);
    EXPECT_EQ(settings.sensorModel().max_range_m, sensor.max_range_m);
}

/// Scans may be written in an order other than that of their names.
TEST(ScanFolderWriter, OrdersTimesAndPosesByName) {
    const test::TemporaryFolder folder;
    ScanFolderWriter writer(folder.path());
    for (const auto& [name, time_s] : {std::pair{"10", 50.0}, {"9", 60.0}}) {
        writer.write(name, threePoints(), labels(), sensorModel("VLP-16"), time_s,
                     mrpt::poses::CPose3D(time_s, 0, 0, 0, 0, 0));
    }
    writer.finish();
    const recordings::ScanFolder read(folder.path());
    EXPECT_EQ(read.name(0), "9");
    EXPECT_EQ(read.times(), (std::vector<double>{60, 50}));
    EXPECT_EQ(recordings::readTumPoses(read.tumFile()).at(0).pose.x(), 60);
    EXPECT_NEAR(recordings::readKittiPoses(read.kittiPosesFile()).at(1).x(), -10, 1e-9);
}

TEST(ScanFolderWriter, KeepsSensorMount) {
    const test::TemporaryFolder folder;
    ScanFolderWriter writer(folder.path(), {2.5f, -0.4f});
    writer.write("000000", threePoints(), labels(), sensorModel("HDL-32E"), 50.0);
    writer.finish();
    Settings settings;
    mergeSettings(recordings::ScanFolder(folder.path()).sensorFile(), settings);
    EXPECT_EQ(settings.mount.roll_rad, 2.5f);
    EXPECT_EQ(settings.mount.pitch_rad, -0.4f);
    EXPECT_EQ(settings.sensorModel().rows(), 32);
}

TEST(ScanFolderWriter, KeepsSensorWithoutRings) {
    const test::TemporaryFolder folder;
    const SensorModel sensor = sensorModel("Mid-360");
    ScanFolderWriter writer(folder.path());
    writer.write("000000", threePoints(), labels(), sensor, 50.0);
    writer.finish();
    const fs::path file = recordings::ScanFolder(folder.path()).sensorFile();
    Settings settings;
    mergeSettings(file, settings);
    EXPECT_FALSE(settings.sensorModel().has_rings);
    EXPECT_EQ(settings.sensorModel().elevations_rad, sensor.elevations_rad);
    EXPECT_EQ(settings.sensorModel().min_range_m, 0.1f);
    EXPECT_EQ(test::readFile(file).find("mount"), std::string::npos);
}

TEST(ScanFolderWriter, ClampsSensorToSettingsLimits) {
    SensorModel sensor = customSensorModel({-90.0, 0.0, 90.0});
    const float usual_m = sensor.max_range_m;
    for (const float min_m : {0.5f, 2000.0f}) {
        const test::TemporaryFolder folder;
        sensor.min_range_m = min_m;
        sensor.max_range_m = 5000;
        ScanFolderWriter writer(folder.path());
        writer.write("000000", threePoints(), labels(), sensor, 50.0);
        writer.finish();
        Settings settings;
        mergeSettings(recordings::ScanFolder(folder.path()).sensorFile(), settings);
        EXPECT_EQ(settings.sensorModel().elevations_rad, sensor.elevations_rad);
        EXPECT_EQ(settings.sensorModel().max_range_m, min_m < 1000 ? 1000.0f : usual_m);
    }
}

TEST(ScanFolderWriter, OmitsUnknownSensor) {
    for (const Attitude mount : {Attitude{}, Attitude{2.5f, -0.4f}}) {
        const test::TemporaryFolder folder;
        ScanFolderWriter writer(folder.path(), mount, GivenLimits{});
        writer.write("000000", threePoints(), labels(), sensorModel("HDL-32E"), 50.0);
        writer.finish();
        Settings settings;
        mergeSettings(recordings::ScanFolder(folder.path()).sensorFile(), settings);
        EXPECT_FALSE(settings.sensor.model);
        EXPECT_FALSE(settings.sensor.min_range_m);
        EXPECT_FALSE(settings.sensor.max_range_m);
        EXPECT_EQ(settings.mount.roll_rad, mount.roll_rad);
        EXPECT_EQ(settings.mount.pitch_rad, mount.pitch_rad);
    }
}

TEST(ScanFolderWriter, KeepsGivenRangeLimits) {
    const test::TemporaryFolder folder;
    ScanFolderWriter writer(folder.path(), {}, GivenLimits{0.7f, std::nullopt});
    writer.write("000000", threePoints(), labels(), sensorModel("HDL-32E"), 50.0);
    writer.finish();
    Settings settings;
    mergeSettings(recordings::ScanFolder(folder.path()).sensorFile(), settings);
    EXPECT_FALSE(settings.sensor.model);
    EXPECT_EQ(settings.sensor.min_range_m, 0.7f);
    EXPECT_FALSE(settings.sensor.max_range_m);
}

TEST(ScanFolderWriter, WritesTumAndKittiPoses) {
    const test::TemporaryFolder folder;
    const mrpt::poses::CPose3D first(5, 6, 7, 1.5, 0.1, -0.2), second(6, 8, 7, 1.0, 0, 0);
    for (const bool is_known : {false, true}) {
        fs::remove_all(folder.path());
        fs::create_directory(folder.path());
        ScanFolderWriter writer(folder.path());
        writer.write("0", threePoints(), labels(), sensorModel("VLP-16"), 50.0, first);
        writer.write("1", threePoints(), labels(), sensorModel("VLP-16"), 50.1,
                     is_known ? std::optional(second) : std::nullopt);
        writer.finish();
        const auto tum = recordings::readTumPoses(folder / "poses.tum");
        ASSERT_EQ(tum.size(), is_known ? 2u : 1u);
        EXPECT_EQ(tum[0].time_s, 50.0);
        EXPECT_NEAR((tum[0].pose - first).norm(), 0.0, 1e-7);
        ASSERT_EQ(fs::exists(folder / "poses.txt"), is_known);
    }
    const auto kitti = recordings::readKittiPoses(folder / "poses.txt");
    ASSERT_EQ(kitti.size(), 2u);
    EXPECT_NEAR(kitti[0].norm(), 0.0, 1e-7);
    EXPECT_NEAR(((first + kitti[1]) - second).norm(), 0.0, 1e-7);
}

TEST(ScanFolderWriter, ReportsWriteError) {
    const test::TemporaryFolder folder;
    ScanFolderWriter writer(folder.path());
    fs::remove(folder / "labels");
    EXPECT_THAT(test::messageOf([&] {
                    writer.write("0", threePoints(), labels(), sensorModel("VLP-16"), 0.0);
                }),
                HasSubstr("labels/0.label"));
}

}  // namespace
}  // namespace hagen::convert
