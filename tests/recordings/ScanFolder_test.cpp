#include <gmock/gmock.h>
#include <hagen/recordings/ScanFolder.h>

#include "support/CloudFiles.h"
#include "support/Program.h"
#include "support/Random.h"
#include "support/RawBytes.h"

namespace hagen::recordings {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

class ScanFolderTest : public testing::Test {
 protected:
    test::TemporaryFolder folder_;
};

TEST_F(ScanFolderTest, ListsScansByName) {
    for (const char* name : {"000010.bin", "000002.bin", "notes.txt"}) {
        folder_.write(std::string("velodyne/") + name, "");
    }
    const ScanFolder scans(folder_.path());
    ASSERT_EQ(scans.size(), 2u);
    EXPECT_EQ(scans.name(0), "000002");
    EXPECT_EQ(scans.scanFile(1), folder_ / "velodyne/000010.bin");
    EXPECT_EQ(scans.labelFile(1), folder_ / "labels/000010.label");
    EXPECT_TRUE(scans.times().empty());
    EXPECT_TRUE(scans.altitudes().empty());
}

TEST_F(ScanFolderTest, OrdersNamesByNumber) {
    const auto orderOf = [&](const std::vector<std::string>& names) {
        const test::TemporaryFolder place;
        for (const std::string& name : names) place.write("velodyne/" + name + ".bin", "");
        const ScanFolder folder(place.path());
        std::vector<std::string> ordered;
        for (std::size_t i = 0; i < folder.size(); ++i) ordered.push_back(folder.name(i));
        return ordered;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(orderOf({"10", "9", "0"}), (Names{"0", "9", "10"}));
    EXPECT_EQ(orderOf({"1000.5", "999.4", "1000.25"}), (Names{"999.4", "1000.25", "1000.5"}));
    EXPECT_EQ(orderOf({"scan_10", "scan_9"}), (Names{"scan_9", "scan_10"}));
    EXPECT_EQ(orderOf({"b_1", "a_2", "a_10"}), (Names{"a_10", "a_2", "b_1"}));
    EXPECT_EQ(orderOf({"000002", "left", "000010"}), (Names{"000002", "000010", "left"}));
}

TEST_F(ScanFolderTest, RejectsFolderWithoutScans) {
    EXPECT_THAT(test::messageOf([&] { ScanFolder scans(folder_.path()); }), HasSubstr("velodyne"));
    fs::create_directory(folder_ / "velodyne");
    EXPECT_THAT(test::messageOf([&] { ScanFolder scans(folder_.path()); }), HasSubstr("no .bin"));
}

TEST_F(ScanFolderTest, ReadsWrittenScans) {
    test::Random random(70);
    Scan scan, again;
    for (int i = 0; i < 500; ++i) {
        scan.x_m.push_back(i == 7 ? kNoValue : random.real(-50, 50));
        scan.y_m.push_back(random.real(-50, 50));
        scan.z_m.push_back(random.real(-50, 50));
        scan.intensity.push_back(random.real(0, 1));
    }
    writeScan(folder_ / "a.bin", scan);
    EXPECT_EQ(fs::file_size(folder_ / "a.bin"), 500u * 16);
    readScan(folder_ / "a.bin", again);
    writeScan(folder_ / "b.bin", again);
    EXPECT_EQ(test::readFile(folder_ / "a.bin"), test::readFile(folder_ / "b.bin"));
    EXPECT_EQ(again.y_m, scan.y_m);
}

TEST_F(ScanFolderTest, ReadsNuScenesWithoutRings) {
    const auto points = test::filePoints(40);
    Scan scan;
    readScan(folder_.write("a.pcd.bin", test::binWithRings(points)), scan);
    ASSERT_EQ(scan.size(), 40u);
    for (std::size_t i = 0; i < 40; ++i) {
        EXPECT_EQ(scan.x_m[i], points[i].x_m);
        EXPECT_EQ(scan.z_m[i], points[i].z_m);
        EXPECT_FLOAT_EQ(scan.intensity[i], 17.0f / 255);
    }
    const auto cut = folder_.write("cut.pcd.bin", test::binWithRings(points) + "1234");
    EXPECT_THAT(test::messageOf([&] { readScan(cut, scan); }),
                HasSubstr("cut.pcd.bin: 804 bytes are not a multiple of 20-byte points"));
}

/// If only every fifth number is checked, returns among zeros may look like points of five numbers.
TEST_F(ScanFolderTest, ReadsZerosAsFourNumbers) {
    Scan scan;
    for (std::vector<float>* values : {&scan.x_m, &scan.y_m, &scan.z_m, &scan.intensity}) {
        values->resize(4000);
    }
    for (std::size_t i = 100; i < 4000; i += i < 200 ? 5 : 1) {
        scan.x_m[i] = 5.25f;
        scan.y_m[i] = 0.5f;
        scan.intensity[i] = 7;
    }
    Scan again;
    EXPECT_EQ(readScan(
                  [&] {
                      writeScan(folder_ / "a.bin", scan);
                      return folder_ / "a.bin";
                  }(),
                  again),
              4u);
    EXPECT_EQ(again.x_m, scan.x_m);
}

/// The first 4096 bytes contain one beam, or fewer than 16 returns.
TEST_F(ScanFolderTest, DetectsFifthNumberByWholeFile) {
    const auto numbersOf = [&](auto isReturn, auto fifth) {
        test::Random random(7);
        std::vector<float> numbers;
        for (int i = 0; i < 4000; ++i) {
            const float is = isReturn(i) ? 1.0f : 0.0f;
            for (int k = 0; k < 3; ++k) numbers.push_back(is * random.real(1, 50));
            numbers.insert(numbers.end(), {is * 7, is * fifth(i)});
        }
        Scan scan;
        return readScan(folder_.write("a.bin", test::raw(numbers)), scan);
    };
    const auto all = [](int) { return true; };
    const auto few = [](int i) { return i % 60 == 20; };
    const auto beamByBeam = [](int i) { return static_cast<float>(i / 1000); };
    const auto zero = [](int) { return 0.0f; };
    EXPECT_EQ(numbersOf(all, beamByBeam), 5u);
    EXPECT_EQ(numbersOf(all, zero), 5u);
    EXPECT_EQ(numbersOf(few, beamByBeam), 5u);
    EXPECT_EQ(numbersOf(few, zero), 5u);
    EXPECT_EQ(numbersOf(all, [](int i) { return i < 3000 ? 3.0f : 0.5f; }), 4u);
}

TEST_F(ScanFolderTest, ReadsStatedFields) {
    Scan scan;
    const auto file = folder_.write("a.bin", test::raw(std::vector<float>{7, 3, 2, 51, 1, 9}));
    EXPECT_EQ(readScan(file, scan, {"-", "z", "y", "intensity", "x", "time"}), 6u);
    EXPECT_THAT(scan.x_m, testing::ElementsAre(1));
    EXPECT_THAT(scan.z_m, testing::ElementsAre(3));
    EXPECT_THAT(scan.intensity, testing::ElementsAre(0.2f));
    readScan(folder_.write("b.bin", test::raw(std::vector<float>{1, 2, 3})), scan, {"x", "y", "z"});
    EXPECT_THAT(scan.intensity, testing::ElementsAre(0));
}

TEST_F(ScanFolderTest, OrdersGrowingCounters) {
    for (const char* name : {"999700000000", "999900000000", "1000100000000", "1000300000000"}) {
        fs::create_directories(folder_ / "s/velodyne");
        folder_.write(std::string("s/velodyne/") + name + ".bin", std::string(16, '\0'));
    }
    const ScanFolder folder(folder_ / "s");
    EXPECT_EQ(folder.name(0), "999700000000");
    EXPECT_EQ(folder.name(1), "999900000000");
    EXPECT_EQ(folder.name(2), "1000100000000");
    EXPECT_EQ(folder.name(3), "1000300000000");
}

TEST_F(ScanFolderTest, RejectsOtherFiles) {
    Scan scan;
    const auto picture = folder_.write("a.bin", "\xff\xd8\xff\xe0" + std::string(28, '\xee'));
    EXPECT_THAT(test::messageOf([&] { readScan(picture, scan); }),
                HasSubstr("a.bin: is not a point cloud: it seems to be a JPEG picture"));
    // Valid points that exceed the range of a LiDAR.
    Scan far;
    for (auto* numbers : {&far.x_m, &far.y_m, &far.z_m, &far.intensity}) *numbers = {1e5f, 2e5f};
    writeScan(folder_ / "far.bin", far);
    readScan(folder_ / "far.bin", scan);
    EXPECT_EQ(scan.x_m, far.x_m);
}

TEST_F(ScanFolderTest, WritesLabelAndComponent) {
    writeLabels(folder_ / "a.label", {Label::Unclassified, Label::Rou, Label::Roi, Label::Roi},
                {0, 0, 3, 1234567});
    const std::string bytes = test::readFile(folder_ / "a.label");
    EXPECT_EQ(bytes, std::string("\0\0\0\0\1\0\0\0\2\0\3\0\2\0\xff\xff", 16));
    EXPECT_EQ(readLabels(folder_ / "a.label"), (std::vector<std::uint16_t>{0, 1, 2, 2}));
}

TEST_F(ScanFolderTest, RejectsMissingAndTruncatedFiles) {
    Scan scan;
    EXPECT_THAT(test::messageOf([&] { readScan(folder_ / "none.bin", scan); }),
                HasSubstr("none.bin"));
    folder_.write("cut.bin", std::string(17, '\x81'));
    const std::string message = test::messageOf([&] { readScan(folder_ / "cut.bin", scan); });
    EXPECT_THAT(message, HasSubstr("cut.bin"));
    EXPECT_THAT(message, HasSubstr("17 bytes"));
    folder_.write("cut.label", "abc");
    EXPECT_THAT(test::messageOf([&] { readLabels(folder_ / "cut.label"); }),
                HasSubstr("cut.label"));
}

TEST_F(ScanFolderTest, ReportsWriteError) {
    EXPECT_THAT(test::messageOf([&] { writeScan(folder_ / "no/such/a.bin", Scan()); }),
                HasSubstr("a.bin"));
}

TEST_F(ScanFolderTest, ReadsTimePerScan) {
    folder_.write("velodyne/000000.bin", "");
    folder_.write("velodyne/000001.bin", "");
    folder_.write("times.txt", "0.0\n0.1\n\n");
    const ScanFolder scans(folder_.path());
    EXPECT_EQ(scans.times(), (std::vector<double>{0.0, 0.1}));
    folder_.write("altitudes.txt", "1.5\n12\n");
    EXPECT_EQ(scans.altitudes(), (std::vector<double>{1.5, 12}));
}

TEST_F(ScanFolderTest, RejectsInvalidTimes) {
    folder_.write("velodyne/000000.bin", "");
    folder_.write("times.txt", "0.0\n0.1\n");
    const ScanFolder scans(folder_.path());
    EXPECT_THAT(test::messageOf([&] { scans.times(); }), HasSubstr("2 lines for 1 scan"));
    folder_.write("times.txt", "soon\n");
    EXPECT_THAT(test::messageOf([&] { scans.times(); }), HasSubstr("times.txt:1"));
    folder_.write("altitudes.txt", "1 2\n");
    EXPECT_THAT(test::messageOf([&] { scans.altitudes(); }), HasSubstr("altitudes.txt:1"));
}

}  // namespace
}  // namespace hagen::recordings
