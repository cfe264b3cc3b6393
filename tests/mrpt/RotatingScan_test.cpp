// Scans of the installed MRPT, and handwritten bytes of newer versions.
#include <gmock/gmock.h>
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/mrpt/RotatingScan.h>
#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/scan/Angle.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/Program.h"
#include "support/RotatingScans.h"
#include "support/SimpleFirings.h"

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationRotatingScan;
using testing::ElementsAre;
using testing::FloatEq;
using testing::HasSubstr;

CObservationRotatingScan::Ptr scanOf(const std::string& bytes) {
    return std::dynamic_pointer_cast<CObservationRotatingScan>(test::objectOf(bytes));
}

/// The label of each pixel with a return, indexed by column * rows + row.
std::map<std::uint32_t, Label> labelsOf(const mrpt::obs::CObservation& observation,
                                        const Settings& settings,
                                        const std::vector<std::uint32_t>& pixel_of_return) {
    ObservationSegmenter segmenter;
    segmenter.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    segmenter.initialize(settings);
    ObservationSegmenter::Output out;
    EXPECT_TRUE(segmenter.process(observation, out));
    std::map<std::uint32_t, Label> labels;
    EXPECT_EQ(out.scan->size(), pixel_of_return.size());
    for (std::size_t i = 0; i < out.scan->size(); ++i) {
        labels[pixel_of_return[i]] = out.result->returns.label[i];
    }
    EXPECT_EQ(labels.size(), pixel_of_return.size());
    return labels;
}

struct Compared {
    std::size_t returns = 0, different = 0, roi = 0;
};

/// Labels of a VLP-16's packets, and of the same returns as a rotating scan.
Compared compare(const test::RotatingLayout& layout, const Settings& settings) {
    Compared compared;
    for (const double x_m : {0.0, 3.0, 8.0}) {
        const auto packets = test::poleScanFrom(x_m, "lidar");
        Scan scan;
        decodePackets(*packets, scan);
        const auto image = test::rotatingImageOf(*packets, scan, layout);
        std::vector<std::uint32_t> pixels = image.pixel_of_return;
        const auto expected = labelsOf(*packets, Settings(), pixels);
        std::sort(pixels.begin(), pixels.end());  // column by column
        const auto labels = labelsOf(*scanOf(image.bytes), settings, pixels);
        for (const auto& [pixel, label] : expected) {
            compared.different += labels.at(pixel) != label;
            compared.roi += label == Label::Roi;
        }
        compared.returns += expected.size();
    }
    return compared;
}

TEST(RotatingScan, PointsMatchPacketLabels) {
    Settings named;
    named.sensor.model = "VLP-16";
    for (const Settings& settings : {Settings(), named}) {
        for (const bool is_highest_first : {false, true}) {
            const Compared compared = compare({true, is_highest_first}, settings);
            EXPECT_GT(compared.returns, 30000u);
            EXPECT_GT(compared.roi, 300u);
            EXPECT_EQ(compared.different, 0u);
        }
    }
}

TEST(RotatingScan, RangesMatchPacketLabels) {
    const Compared compared = compare({}, {});
    EXPECT_GT(compared.returns, 30000u);
    EXPECT_EQ(compared.different, 0u);
}

/// Three rows of four columns without ranges.
CObservationRotatingScan smallScan() {
    CObservationRotatingScan scan;
    scan.sensorLabel = "lidar";
    scan.rowCount = 3;
    scan.columnCount = 4;
    scan.rangeResolution = 0.5;
    scan.rangeImage.setZero(3, 4);
    scan.minRange = 0.25;
    scan.maxRange = 80;
    return scan;
}

Settings threeBeams() {
    Settings settings;
    settings.sensor.model = "custom";
    settings.sensor.elevations_deg = {-30, 0, 60};
    return settings;
}

ObservedScan readWith(const mrpt::obs::CObservation& observation, const Settings& settings = {}) {
    ObservedScan observed;
    readObservation(observation, settings, observed);
    return observed;
}

std::string errorOf(const mrpt::obs::CObservation& observation, const Settings& settings = {}) {
    return test::messageOf([&] { readWith(observation, settings); });
}

TEST(RotatingScan, ColumnsFollowAzimuthSpan) {
    CObservationRotatingScan scan = smallScan();
    scan.rangeImage(1, 0) = 2;  // 1 m
    scan.rangeImage(0, 1) = 8;
    scan.rangeImage(2, 3) = 12;
    scan.intensityImage.setZero(3, 4);
    scan.intensityImage(0, 1) = 51;
    scan.sweepDuration = 0.1;
    scan.startAzimuth = radians(10);
    scan.azimuthSpan = radians(-90);
    const ObservedScan observed = readWith(scan, threeBeams());
    EXPECT_EQ(observed.sensor.max_range_m, 80.0f);
    EXPECT_EQ(observed.sensor.min_range_m, 0.25f);
    ASSERT_EQ(observed.scan.size(), 3u);
    EXPECT_THAT(observed.scan.range_m, ElementsAre(FloatEq(1), FloatEq(4), FloatEq(6)));
    EXPECT_THAT(observed.scan.row, ElementsAre(1, 0, 2));
    EXPECT_THAT(observed.scan.intensity, ElementsAre(0, 0.2f, 0));
    EXPECT_FLOAT_EQ(observed.scan.time_s[1], 0.1f / 3);
    EXPECT_FLOAT_EQ(observed.scan.time_s[2], 0.1f);
    EXPECT_NEAR(degrees(observed.scan.azimuth_rad[0]), 10, 1e-4);
    EXPECT_NEAR(degrees(observed.scan.azimuth_rad[1]), -20, 1e-4);
    EXPECT_NEAR(degrees(observed.scan.azimuth_rad[2]), -80, 1e-4);
    EXPECT_NEAR(observed.scan.z_m[1], -2, 1e-5);
    EXPECT_NEAR(observed.scan.x_m[1], 4 * std::sqrt(0.75) * std::cos(radians(20)), 1e-5);
    EXPECT_NEAR(observed.scan.y_m[1], -4 * std::sqrt(0.75) * std::sin(radians(20)), 1e-5);
    scan.azimuthSpan = radians(90);
    EXPECT_NEAR(degrees(readWith(scan, threeBeams()).scan.azimuth_rad[2]), 100, 1e-4);
}

TEST(RotatingScan, ReadsAllPixelRanges) {
    CObservationRotatingScan scan = smallScan();
    scan.rangeImage(1, 2) = 4;
    scan.rangeOtherLayers["LAST"].setZero(3, 4);
    scan.rangeOtherLayers["LAST"](1, 2) = 9;
    scan.rangeOtherLayers["LAST"](0, 3) = 5;
    EXPECT_THAT(readWith(scan, threeBeams()).scan.range_m, ElementsAre(2, 4.5f, 2.5f));
    std::vector<float> points(3 * 12, 0.0f);
    points[3 * 6] = 2;
    const auto with_points = scanOf(test::newerBytesOf(scan, points));
    const ObservedScan observed = readWith(*with_points, threeBeams());
    EXPECT_THAT(observed.scan.x_m, ElementsAre(2, 4.5f));
    EXPECT_THAT(observed.remark, HasSubstr("ranges without a point (dropped): 1"));
}

TEST(RotatingScan, UsesModelElevations) {
    CObservationRotatingScan scan = smallScan();
    scan.rowCount = 64;
    scan.rangeImage.setZero(64, 4);
    scan.rangeImage(0, 0) = 10;
    scan.lidarModel = "OS1-64";
    EXPECT_EQ(readWith(scan).scan.row[0], 63);  // an Ouster counts from the highest beam
    EXPECT_GT(readWith(scan).scan.z_m[0], 1.0f);
    scan.lidarModel = "hdl 64";
    EXPECT_EQ(readWith(scan).scan.row[0], 0);
    EXPECT_LT(readWith(scan).scan.z_m[0], -1.0f);
    Settings settings;
    settings.sensor.model = "OS1-64";
    EXPECT_EQ(readWith(scan, settings).sensor.name, "HDL-64E");
    EXPECT_THAT(readWith(scan, settings).remark, HasSubstr("override the settings'"));
    scan.lidarModel = "UNKNOWN_SCANNER";
    EXPECT_EQ(readWith(scan, settings).sensor.name, "OS1-64");
    EXPECT_FALSE(isCloud(scan));
}

TEST(RotatingScan, ReportsMissingElevations) {
    const CObservationRotatingScan scan = smallScan();
    EXPECT_THAT(errorOf(scan), HasSubstr("3 rows have no elevations"));
    EXPECT_THAT(errorOf(scan), HasSubstr("-c FILE.yaml"));
    Settings settings;
    settings.sensor.model = "VLP-16";
    EXPECT_THAT(errorOf(scan, settings), HasSubstr("sensor.model VLP-16 has 16"));
    settings = threeBeams();
    EXPECT_EQ(errorOf(scan, settings), "");
}

TEST(RotatingScan, RejectsInvalidScans) {
    const Settings settings = threeBeams();
    const auto errorWith = [&](const auto& change) {
        CObservationRotatingScan scan = smallScan();
        change(scan);
        return errorOf(scan, settings);
    };
    EXPECT_THAT(errorWith([](auto& scan) { scan.rangeImage.resize(0, 0); }),
                HasSubstr("no range image"));
    EXPECT_THAT(errorWith([](auto& scan) { scan.rangeResolution = 0; }), HasSubstr("resolution"));
    EXPECT_THAT(errorWith([](auto& scan) { scan.rangeResolution = NAN; }), HasSubstr("resolution"));
    EXPECT_THAT(errorWith([](auto& scan) { scan.azimuthSpan = INFINITY; }), HasSubstr("azimuths"));
    EXPECT_THAT(errorWith([](auto& scan) { scan.intensityImage.setZero(3, 5); }),
                HasSubstr("intensity image has 3 x 5"));
    EXPECT_THAT(errorWith([](auto& scan) { scan.rangeOtherLayers["LAST"].setZero(2, 4); }),
                HasSubstr("'LAST' has 2 x 4"));
    EXPECT_THAT(errorWith([](auto& scan) { scan.rangeImage.setZero(4200, 4200); }),
                HasSubstr("17640000 returns"));
}

TEST(RotatingScan, ExcludesPlanarScans) {
    CObservationRotatingScan scan = smallScan();
    EXPECT_TRUE(isLidarScan(scan));
    scan.rowCount = 1;
    scan.rangeImage.setZero(1, 4);
    EXPECT_FALSE(isLidarScan(scan));
}

TEST(RotatingScan, ReadsBothLayouts) {
    CObservationRotatingScan scan = smallScan();
    scan.rangeImage(1, 2) = 4;
    scan.rangeOtherLayers["LAST"].setZero(3, 4);
    scan.rangeOtherLayers["LAST"](2, 3) = 9;
    std::vector<float> points(3 * 12);
    std::iota(points.begin(), points.end(), 1.0f);
    const auto older = scanOf(test::olderBytesOf(scan));
    const auto newer = scanOf(test::newerBytesOf(scan, points));
    EXPECT_EQ(organizedPointsOf(*older), nullptr);
    ASSERT_NE(organizedPointsOf(*newer), nullptr);
    EXPECT_EQ(organizedPointsOf(*newer)->y_m[1], 5.0f);
    EXPECT_TRUE(isCloud(*newer));
    EXPECT_EQ(organizedPointsOf(*scanOf(test::newerBytesOf(scan))), nullptr);
    for (const auto& read : {older, newer}) {
        EXPECT_EQ(read->sensorLabel, "lidar");
        EXPECT_EQ(read->rangeImage(1, 2), 4);
        EXPECT_EQ(read->rangeOtherLayers.at("LAST")(2, 3), 9);
        EXPECT_EQ(test::bytesOf(*read), test::bytesOf(scan));
    }
    // Sizes that look similar in bytes.
    for (const int columns : {256, 257, 1024, 4096}) {
        for (const int rows : {4, 16, 256}) {
            CObservationRotatingScan wide;
            wide.rowCount = static_cast<std::uint16_t>(rows);
            wide.columnCount = static_cast<std::uint16_t>(columns);
            wide.rangeResolution = 1;
            wide.rangeImage.setZero(rows, columns);
            wide.rangeImage(rows - 1, columns - 1) = 7;
            EXPECT_EQ(scanOf(test::olderBytesOf(wide))->rangeImage(rows - 1, columns - 1), 7);
            EXPECT_EQ(scanOf(test::newerBytesOf(wide))->rangeImage(rows - 1, columns - 1), 7);
        }
    }
}

TEST(RotatingScan, RejectsTruncatedAndExternalScans) {
    const CObservationRotatingScan scan = smallScan();
    const std::string bytes = test::newerBytesOf(scan, std::vector<float>(36, 1.0f));
    for (std::size_t size = 1; size < bytes.size(); size += 3) {
        EXPECT_THROW(test::objectOf(bytes.substr(0, size)), std::exception) << size;
    }
    // The images begin after the header; this header claims 65535 x 65535 points.
    std::string huge = bytes;
    huge.replace(huge.size() - 1 - 36 * 4 - 4, 4, "\xff\xff\xff\xff");
    EXPECT_THROW(test::objectOf(huge), std::exception);
    const std::string older = test::olderBytesOf(scan);
    const std::size_t images = older.size() - 1 - (4 + 24 + 4 + 2);
    const std::string outside =
        older.substr(0, images) + '\1' + std::string("\x08\0\0\0", 4) + "scan.bin" + '\x88';
    EXPECT_THAT(test::messageOf<std::exception>([&] { test::objectOf(outside); }),
                HasSubstr("'scan.bin'"));
}

/// The returns that fromVelodyne() keeps.
Scan firstFiringsOf(const Scan& scan) {
    Scan kept;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const double firing = 1e6 * static_cast<double>(scan.time_s[i]) / 55.296;
        if (static_cast<int>(firing + 0.01) % 2 == 1) continue;
        kept.x_m.push_back(scan.x_m[i]);
        kept.y_m.push_back(scan.y_m[i]);
        kept.z_m.push_back(scan.z_m[i]);
        kept.intensity.push_back(scan.intensity[i]);
        kept.row.push_back(scan.row[i]);
        kept.time_s.push_back(scan.time_s[i]);
    }
    return kept;
}

std::vector<std::size_t> byTime(const Scan& scan) {
    std::vector<std::size_t> order(scan.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return scan.time_s[a] < scan.time_s[b]; });
    return order;
}

TEST(RotatingScan, ConvertedScansMatchPackets) {
    auto packets = test::poleScanFrom(3, "lidar");
    packets->scan_packets.resize(70);  // fromVelodyne() rejects a turn that passes 0 degrees
    packets->calibration = mrpt::obs::VelodyneCalibration::LoadDefaultCalibration("VLP16");
    CObservationRotatingScan rotating;
    rotating.fromVelodyne(*packets);
    EXPECT_EQ(rotating.columnCount, 70 * 384);
    Scan all;
    decodePackets(*packets, all);
    const Scan kept = firstFiringsOf(all);
    const ObservedScan observed = readWith(rotating);
    EXPECT_THAT(observed.remark, HasSubstr("half of the returns"));
    EXPECT_EQ(observed.sensor.name, "VLP-16");
    ASSERT_EQ(observed.scan.size(), kept.size());
    const auto order = byTime(observed.scan), expected = byTime(kept);
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::size_t i = order[k], j = expected[k];
        ASSERT_EQ(observed.scan.row[i], kept.row[j]) << k;
        ASSERT_NEAR(observed.scan.time_s[i], kept.time_s[j], 2e-6) << k;
        const float off_m =
            std::hypot(observed.scan.x_m[i] - kept.x_m[j], observed.scan.y_m[i] - kept.y_m[j],
                       observed.scan.z_m[i] - kept.z_m[j]);
        // Packet azimuths are rounded to 0.01 degrees.
        ASSERT_LT(off_m, 2e-4f * observed.scan.range_m[i]) << k;
    }
    // Without the sensor's name, rows of lasers have no elevations.
    rotating.lidarModel = "Unknown";
    EXPECT_THAT(errorOf(rotating), HasSubstr("no elevations"));
    Settings settings;
    settings.sensor.model = "VLP-16";
    EXPECT_EQ(readWith(rotating, settings).scan.x_m, observed.scan.x_m);
}

}  // namespace
}  // namespace hagen::observations
