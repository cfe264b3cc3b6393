// The page written by rawlog-segment --view. tests/browser opens it.
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

TEST_F(SegmentView, ShowsEveryNthScan) {
    expectSuccess({recording(), "--view", path("view.html"), "--view-every", "4"});
    const auto data = dataOf("view.html");
    EXPECT_EQ(data["frames"].size(), 3u);
    EXPECT_EQ(data["frames"][2]["values"]["scan"], "000008");
    EXPECT_EQ(data["charts"][0]["values"].size(), 10u);  // of all scans
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

TEST_F(SegmentView, RejectsOtherExtensions) {
    expectFailure({recording(), "--view", path("view.png")}, 2, ".html");
}

}  // namespace
}  // namespace hagen
