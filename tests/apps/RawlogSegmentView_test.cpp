// The page written by rawlog-segment --view. tests/browser opens it.
#include <hagen/recordings/RawlogReader.h>
#include <hagen/scan/Angle.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <algorithm>
#include <cmath>
#include "support/CaptureWriter.h"
#include "support/CloudFiles.h"
#include "support/ReadView.h"
#include "support/SegmentTest.h"

namespace hagen {
namespace {

using testing::HasSubstr;

class SegmentView : public test::SegmentTest {
 protected:
    nlohmann::json dataOf(const std::string& page) const {
        return test::viewData(test::readFile(folder_ / page));
    }
};

TEST_F(SegmentView, ShowsScansPosesAndStatistics) {
    expectSuccess({recording(), "--view", path("view.html")});
    const auto data = dataOf("view.html");
    ASSERT_EQ(data["frames"].size(), 10u);
    const auto& frame = data["frames"][9];
    EXPECT_TRUE(frame["is_placed"]);
    EXPECT_EQ(frame["pose"].size(), 12u);
    EXPECT_GT(frame["boxes"].size(), 1u);
    EXPECT_EQ(data["charts"][0]["values"].size(), 10u);
    EXPECT_EQ(data["charts"][0]["label"], "nearest obstacle [m]");
    const double nearest_m = frame["boxes"][0][2];
    EXPECT_NEAR(data["charts"][0]["values"][9], nearest_m, 0.002);
}

/// Heights of the ROU returns up to 10 m, above the plane of the page's ground.
std::vector<double> groundHeights(const nlohmann::json& frame) {
    auto arrays = test::viewArrays(frame);
    const std::vector<double> m = frame["ground"]["from_scan"];
    const int rows = frame["image"][0], columns = frame["image"][1];
    std::vector<double> heights_m;
    std::size_t with_pixel = 0;
    for (std::size_t i = 0; i < arrays["range"].size(); ++i) {
        if (arrays["pixel"][i] < 0) continue;
        const double offset = static_cast<double>(arrays["offset"][with_pixel++] - 128) / 8;
        const double column = static_cast<double>(arrays["pixel"][i] / rows) + 0.5 - offset;
        const double azimuth_rad = kPi * (1 - 2 * column / columns);
        const double elevation_rad = 0.0005 * static_cast<double>(arrays["elevation"][i]);
        const double range_m = 0.04 * static_cast<double>(arrays["range"][i]);
        if (arrays["label"][i] != 1 || range_m > 10) continue;
        heights_m.push_back(m[8] * range_m * std::cos(elevation_rad) * std::cos(azimuth_rad) +
                            m[9] * range_m * std::cos(elevation_rad) * std::sin(azimuth_rad) +
                            m[10] * range_m * std::sin(elevation_rad) + m[11]);
    }
    std::sort(heights_m.begin(), heights_m.end());
    return heights_m;
}

TEST_F(SegmentView, GroundFitsReturnsInEveryPosture) {
    for (const char* const roll_deg : {"0", "90", "180"}) {
        const auto made = test::run(
            HAGEN_RAWLOG_SIMULATE,
            {"--scenario", "field", "--scans", "1", "--altitude", "3", "--seed", "1", "--clear-air",
             "--mount-roll-deg", roll_deg, "-o", path("flight.rawlog"), "--overwrite"});
        ASSERT_EQ(made.exit_code, 0) << made.err;
        expectSuccess({path("flight.rawlog"), "--view", path("view.html"), "--overwrite"});
        const auto heights_m = groundHeights(dataOf("view.html")["frames"][0]);
        ASSERT_GT(heights_m.size(), 100u) << roll_deg;
        EXPECT_NEAR(heights_m[heights_m.size() / 2], 0, 0.3) << roll_deg;
    }
}

TEST_F(SegmentView, ThinsMoreThan500Scans) {
    std::filesystem::create_directory(folder_ / "clouds");
    test::Packed cloud;
    for (int i = 0; i < 100; ++i)
        cloud.add(5.0f).add(0.1f * static_cast<float>(i)).add(-1.0f).add(0.5f);
    for (int i = 0; i < 501; ++i) {
        char name[32];
        std::snprintf(name, sizeof name, "clouds/%06d.bin", i);
        folder_.write(name, cloud.text);
    }
    const auto outcome =
        expectSuccess({path("clouds"), "--view", path("view.html"), "-c", config("vlp16")});
    EXPECT_THAT(outcome.out, HasSubstr("251 scans, 1 of 2"));
    const auto data = dataOf("view.html");
    ASSERT_EQ(data["frames"].size(), 251u);
    EXPECT_EQ(data["frames"][250]["values"]["scan"], "000500");
    EXPECT_NEAR(data["frame_times_s"][250], 50, 1e-9);  // without times, 10 Hz
}

TEST_F(SegmentView, ShowsEachLidarWhenThinned) {
    recordings::RawlogReader reader(recording());
    test::CaptureWriter capture;
    double time_s = 1700000000;
    while (const auto entry = reader.next()) {
        const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservationVelodyneScan>(entry);
        if (!scan) continue;
        for (const auto& packet : scan->scan_packets) {
            capture.datagram({test::bytesOf(packet), time_s += 1.3e-3, 0x0a000001});
            capture.datagram({test::bytesOf(packet), time_s, 0x0a000002});
        }
    }
    expectSuccess(
        {capture.write(path("two.pcap")), "--view", path("view.html"), "--view-every", "2"});
    const auto data = dataOf("view.html");
    std::vector<std::string> labels;
    for (const auto& frame : data["frames"]) labels.push_back(frame["values"]["sensor"]);
    EXPECT_GT(std::count(labels.begin(), labels.end(), "velodyne"), 3);
    EXPECT_EQ(std::count(labels.begin(), labels.end(), "velodyne"),
              std::count(labels.begin(), labels.end(), "velodyne_2"));
    const std::vector<double> all_s = data["charts"][0]["times_s"];
    EXPECT_TRUE(std::is_sorted(all_s.begin(), all_s.end()));
    EXPECT_NEAR(all_s.back(), time_s - 1700000000 - 0.1, 0.1);
}

TEST_F(SegmentView, RejectsOtherExtensions) {
    expectFailure({recording(), "--view", path("view.png")}, 2, ".html");
}

}  // namespace
}  // namespace hagen
