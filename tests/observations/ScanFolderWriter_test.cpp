#include <gtest/gtest.h>
#include <hagen/observations/ScanFolder.h>
#include <hagen/observations/ScanFolderWriter.h>
#include <hagen/observations/Settings.h>

#include <stdexcept>

#include "support/Program.h"

namespace hagen {
namespace {

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

TEST(ScanFolderWriter, WritesAFolderThatReadsBack) {
    const test::TemporaryFolder folder;
    const SensorModel sensor = sensorModel("HDL-32E");
    ScanFolderWriter writer(folder / "out", false);
    writer.write(threePoints(), labels(), sensor, 50.0);
    writer.write(threePoints(), labels(), sensor, 50.1);
    EXPECT_FALSE(fs::exists(folder / "out"));  // not before it is whole
    writer.commit();

    const ScanFolder read(folder / "out");
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read.name(1), "000001");
    EXPECT_EQ(readLabels(read.labelFile(1)), (std::vector<std::uint16_t>{2, 1, 0}));
    ASSERT_EQ(read.times().size(), 2u);
    EXPECT_NEAR(read.times()[1], 0.1, 1e-6);
    Scan scan;
    readScan(read.scanFile(0), scan);
    EXPECT_EQ(scan.z_m, threePoints().z_m);
    EXPECT_EQ(scan.intensity, threePoints().intensity);

    Settings settings;
    mergeSettings(read.sensorFile(), settings);
    EXPECT_EQ(settings.sensorModel().elevations_rad, sensor.elevations_rad);
    EXPECT_EQ(settings.sensorModel().max_range_m, sensor.max_range_m);
}

TEST(ScanFolderWriter, OfAWindowWritesTheNewestScan) {
    const test::TemporaryFolder folder;
    LabelledReturns returns = labels();
    returns.label.push_back(Label::Roi);
    returns.component.push_back(9);
    ScanFolderWriter writer(folder / "out", false);
    writer.write(threePoints(), returns, sensorModel("VLP-16"), 0.0, "000123");
    writer.commit();
    EXPECT_EQ(readLabels(folder / "out/labels/000123.label").size(), 3u);
}

TEST(ScanFolderWriter, LeavesNothingBehindWhenItIsGivenUp) {
    const test::TemporaryFolder folder;
    {
        ScanFolderWriter writer(folder / "out", false);
        writer.write(threePoints(), labels(), sensorModel("VLP-16"), 0.0);
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ScanFolderWriter, KeepsAPartUnderANameThatSaysSo) {
    const test::TemporaryFolder folder;
    ScanFolderWriter writer(folder / "out", false);
    writer.write(threePoints(), labels(), sensorModel("VLP-16"), 0.0);
    EXPECT_EQ(writer.keepPartial(), folder / "out.partial");
    EXPECT_EQ(ScanFolder(folder / "out.partial").size(), 1u);
    EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace
}  // namespace hagen
