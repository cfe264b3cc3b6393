#include <gmock/gmock.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/recordings/ScanSource.h>
#include <hagen/sensors/CaptureFile.h>
#include "convert/RawlogWriter.h"
#include "recordings/PoseFile.h"
#include "sensors/ouster/OusterSensor.h"

#include <algorithm>
#include <fstream>

#include "support/CaptureWriter.h"
#include "support/OusterPackets.h"
#include "support/Program.h"
#include "support/SimpleFirings.h"

namespace hagen::recordings {
namespace {

using mrpt::poses::CPose3D;
using testing::ElementsAre;
using testing::HasSubstr;

namespace fs = std::filesystem;
constexpr double kStart_s = 1700000000;

/// A capture of three turns, 0.1 s apart, that show a pole from different positions.
class CaptureSourceTest : public testing::Test {
 protected:
    CaptureSourceTest() {
        const test::SimpleScene scene = test::sceneOf({}, {{12, 2, 0.15, 8}});
        const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
        test::CaptureWriter writer;
        for (int i = 0; i < 3; ++i) {
            observations::Firings firings = test::fireAt(scene, model, {1.0 * i, 0, 2});
            firings.first_time_us = static_cast<std::uint32_t>(100000 * i);
            scans_.push_back(encodeScan(model, firings));
            // The last packet is incomplete, because the next turn follows immediately.
            scans_.back()->scan_packets.pop_back();
            writer.packets(*scans_.back(), kStart_s + 0.1 * i, 1.327e-3);
        }
        capture_ = writer.write(folder_ / "flight.pcap");
    }
    std::unique_ptr<ScanSource> open(const SourceOptions& options = {}) const {
        return openRecording(capture_, options);
    }

    test::TemporaryFolder folder_;
    std::vector<mrpt::obs::CObservationVelodyneScan::Ptr> scans_;
    fs::path capture_;
};

TEST_F(CaptureSourceTest, TurnsAreEntries) {
    const auto source = open();
    for (std::size_t i = 0; i < 3; ++i) {
        const auto entry = source->nextEntry();
        ASSERT_TRUE(entry);
        EXPECT_EQ(entry->number, i);
        ASSERT_EQ(entry->scans.size(), 1u);
        EXPECT_EQ(entry->object, entry->scans[0].observation);
        EXPECT_NEAR(entry->fraction_read, (static_cast<double>(i) + 1) / 3, 0.09);
        observations::ObservedScan expected, found;
        observations::readObservation(*scans_[i], {}, expected);
        observations::readObservation(*entry->scans[0].observation, {}, found);
        EXPECT_EQ(found.scan.x_m, expected.scan.x_m);
        EXPECT_EQ(found.scan.row, expected.scan.row);
        EXPECT_EQ(found.scan.time_s, expected.scan.time_s);
        EXPECT_EQ(found.sensor.name, "VLP-16");
    }
    EXPECT_FALSE(source->nextEntry());
    EXPECT_EQ(source->scansKnown(), 3u);
    EXPECT_THAT(source->remarks(),
                ElementsAre(HasSubstr(" in 3 turns"), HasSubstr("ignored: none")));
}

TEST_F(CaptureSourceTest, SelectsEntriesAndLabels) {
    SourceOptions options;
    options.first_scan = options.last_scan = 1;
    auto source = open(options);
    const auto scan = source->nextScan();
    ASSERT_TRUE(scan);
    EXPECT_EQ(titleOf(*scan), "scan 1 (velodyne)");
    EXPECT_FALSE(source->nextScan());
    EXPECT_EQ(source->entriesSkipped(), 1u);
    EXPECT_THAT(source->remarks()[0], HasSubstr("up to the last entry converted"));
    options = {};
    options.sensor_labels = {"front"};
    source = open(options);
    EXPECT_FALSE(source->nextScan());
    EXPECT_THAT(source->otherLabels(), ElementsAre("velodyne"));
}

TEST_F(CaptureSourceTest, ReadsTimesAndPoses) {
    const auto times = open()->scanTimes().at("velodyne");
    ASSERT_EQ(times.size(), 3u);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(mrpt::Clock::toDouble(times[static_cast<std::size_t>(i)]), kStart_s + 0.1 * i,
                    1e-3);
    }
    writeKittiPoses(folder_ / "poses.txt", {CPose3D(0, 0, 0, 0, 0, 0), CPose3D(1, 0, 0, 0, 0, 0),
                                            CPose3D(2, 0, 0, 0, 0, 0)});
    writeTumPoses(folder_ / "poses.tum", {{kStart_s, CPose3D(0, 0, 0, 0, 0, 0)},
                                          {kStart_s + 0.1, CPose3D(1, 0, 0, 0, 0, 0)}});
    for (const char* file : {"poses.txt", "poses.tum"}) {
        const auto source = open();
        source->usePoses(folder_ / file);
        ASSERT_TRUE(source->nextScan());
        const auto second = source->nextScan();
        ASSERT_TRUE(second && second->pose.sensor_pose) << file;
        EXPECT_NEAR(second->pose.sensor_pose->x(), 1.0, 0.02);
    }
    const auto without = open();
    without->usePoses({});
    EXPECT_EQ(without->poses().source, "");
    writeKittiPoses(folder_ / "two.txt", {CPose3D(), CPose3D()});
    EXPECT_THAT(test::messageOf([&] { open()->usePoses(folder_ / "two.txt"); }),
                HasSubstr("has 2 poses for 3 scans"));
}

/// A capture of three Ouster frames, and its metadata.
class OusterSourceTest : public testing::Test {
 protected:
    OusterSourceTest() {
        options_.sensor_json = folder_.write("sensor.json", test::ousterJson());
        const auto sensor = sensors::readOusterSensor(options_.sensor_json);
        test::CaptureWriter writer;
        for (std::uint16_t id = 1; id <= 3; ++id) {
            for (const auto& packet : test::packetsOf(sensor, test::randomFrame(sensor, id))) {
                writer.datagram({packet, kStart_s + 0.1 * (id - 1)});
            }
        }
        capture_ = writer.write(folder_ / "ouster.pcap");
    }
    test::TemporaryFolder folder_;
    SourceOptions options_;
    fs::path capture_;
};

TEST_F(OusterSourceTest, WritesCloudsWithSensor) {
    using observations::CloudClass;
    for (const auto cloud_class : {std::optional<CloudClass>(), std::optional(CloudClass::Simple),
                                   std::optional(CloudClass::WithIntensity)}) {
        options_.folder_objects = cloud_class;
        const auto source = openRecording(capture_, options_);
        source->useSettings({});
        for (std::size_t i = 0; i < 3; ++i) {
            const auto entry = source->nextEntry();
            ASSERT_TRUE(entry);
            ASSERT_EQ(entry->scans.size(), 1u);
            EXPECT_EQ(entry->scans[0].beams, nullptr);  // there are no beams to recover
            observations::ObservedScan observed;
            observations::readObservation(*entry->scans[0].observation, {}, observed);
            EXPECT_EQ(observed.sensor.name, "OS-0-32-U1");
            EXPECT_FALSE(observed.is_sensor_assumed);
            EXPECT_FALSE(observed.scan.time_s.empty());
            ASSERT_EQ(entry->object != nullptr, cloud_class.has_value());
            if (!cloud_class) continue;
            const auto object =
                std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(entry->object);
            ASSERT_TRUE(object);
            EXPECT_EQ(object->sensorLabel, "ouster");
            convert::RawlogWriter writer(folder_ / "a.rawlog", true);
            writer.write(*object);
            writer.commit();
            Scan again;
            const auto read = RawlogReader(folder_ / "a.rawlog").next();
            observations::readCloudPoints(dynamic_cast<mrpt::obs::CObservation&>(*read), again);
            EXPECT_EQ(again.x_m, observed.scan.x_m);
            const bool has_intensity = cloud_class == CloudClass::WithIntensity;
            EXPECT_EQ(again.intensity, has_intensity ? observed.scan.intensity
                                                     : std::vector<float>(again.size(), 0.0f));
        }
        EXPECT_FALSE(source->nextEntry());
    }
}

TEST_F(OusterSourceTest, SettingsLimitRangesNotModel) {
    const auto scan = openRecording(capture_, options_)->nextScan();
    Settings settings;
    settings.sensor.model = "OS0-128";
    settings.sensor.max_range_m = 50.0f;
    observations::ObservedScan observed;
    observations::readObservation(*scan->observation, settings, observed);
    EXPECT_EQ(observed.sensor.rows(), 4);
    EXPECT_EQ(observed.sensor.max_range_m, 50.0f);
    EXPECT_THAT(observed.remark, HasSubstr("the recorded sensor is OS-0-32-U1"));
}

TEST_F(OusterSourceTest, ReadsTimesAndPoses) {
    EXPECT_EQ(openRecording(capture_, options_)->scanTimes().at("ouster").size(), 3u);
    writeKittiPoses(folder_ / "poses.txt", {CPose3D(), CPose3D(1, 0, 0, 0, 0, 0), CPose3D()});
    const auto source = openRecording(capture_, options_);
    source->usePoses(folder_ / "poses.txt");
    source->nextScan();
    EXPECT_NEAR(source->nextScan()->pose.sensor_pose->x(), 1.0, 1e-6);
}

TEST_F(OusterSourceTest, RejectsMetadataWithoutCapture) {
    convert::RawlogWriter writer(folder_ / "a.rawlog", true);
    writer.write(mrpt::obs::CObservationPointCloud());
    writer.commit();
    EXPECT_THAT(test::messageOf([&] { openRecording(folder_ / "a.rawlog", options_); }),
                HasSubstr("a.rawlog: is neither a capture (.pcap, .pcapng) nor a ROS recording, so "
                          "the metadata "));
    EXPECT_THAT(test::messageOf([&] { openRecording(folder_.path(), options_); }),
                HasSubstr("is a folder with 2 recordings"));
    options_.sensor_json = capture_;
    EXPECT_THAT(test::messageOf([&] { openRecording(folder_ / "a.rawlog", options_); }),
                HasSubstr("are the two files swapped?"));
    options_.sensor_json = folder_ / "none.json";
    EXPECT_THAT(test::messageOf([&] { openRecording(capture_, options_); }),
                HasSubstr("none.json: cannot be read"));
}

TEST_F(CaptureSourceTest, ReportsTruncationAfterScans) {
    fs::resize_file(capture_, fs::file_size(capture_) - 1000);
    const auto source = open();
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(source->nextScan());
    EXPECT_THROW(source->nextScan(), sensors::BrokenCapture);
    EXPECT_EQ(open()->scanTimes().at("velodyne").size(), 3u);
}

TEST_F(CaptureSourceTest, ReportsLookAheadErrors) {
    const std::string bytes = test::readFile(capture_);
    for (const std::size_t last : {0u, 2u, 100u}) {
        SourceOptions options;
        options.last_scan = last;
        const auto source = open(options);  // opens the file replaced below
        fs::remove(capture_);
        std::ofstream(capture_, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
        EXPECT_EQ(source->scanTimes().at("velodyne").size(), 2u);
        for (std::size_t i = 0; i <= std::min<std::size_t>(last, 2); ++i) {
            EXPECT_TRUE(source->nextScan());
        }
        const std::string message = test::messageOf([&] { source->nextScan(); });
        const bool is_needed = last > 0;
        EXPECT_THAT(message, HasSubstr(is_needed ? "(found while reading ahead)" : ""));
        EXPECT_EQ(message.empty(), !is_needed) << message;
        fs::remove(capture_);
        std::ofstream(capture_, std::ios::binary) << bytes;
    }
}

TEST_F(CaptureSourceTest, StopsOnRequest) {
    int asked = 0;
    SourceOptions options;
    options.keep_going = [&] { return ++asked <= 1; };
    const auto source = open(options);
    EXPECT_TRUE(source->nextEntry());
    EXPECT_THROW(source->nextEntry(), Interrupted);
    EXPECT_THROW(source->scanTimes(), Interrupted);
}

TEST_F(CaptureSourceTest, DetectsCaptureByContent) {
    fs::rename(capture_, folder_ / "flight.rawlog");
    EXPECT_TRUE(openRecording(folder_ / "flight.rawlog")->nextScan());
    convert::RawlogWriter writer(folder_ / "a.rawlog", true);
    writer.write(*scans_[0]);
    writer.commit();
    fs::rename(folder_ / "a.rawlog", folder_ / "a.pcap");
    EXPECT_TRUE(openRecording(folder_ / "a.pcap")->nextScan());
}

}  // namespace
}  // namespace hagen::recordings
