#include "avoidance/flights/Campaign.h"
#include <gmock/gmock.h>
#include "avoidance/flights/Calibration.h"

#include <fstream>

#include "support/Program.h"

namespace hagen::avoidance {
namespace {

namespace fs = std::filesystem;
using test::messageOf;
using test::readFile;
using test::TemporaryFolder;
using testing::HasSubstr;

/// Six short flights on three courses.
class Campaign : public testing::Test {
 protected:
    Campaign() {
        plan_.scenarios = {"forest-0.02"};
        plan_.last_seed = 2;
        plan_.speeds_m_s = {20};
        plan_.models = {"W-RoI", "oracle"};
        plan_.guidances = {"straight"};
    }

    std::vector<hagen::avoidance::Run> fly(const std::string& name, double latency_ms = 1) {
        return flyCampaign(flightsOf(plan_), constantProfile(latency_ms), place_ / name, options_);
    }

    std::string table(const std::string& name) const {
        return readFile(place_ / name / "runs.csv");
    }

    /// Ends a campaign after a number of flights.
    void flyUntil(std::size_t count, const std::string& name) {
        std::size_t seen = 0;
        options_.progress = [&](std::size_t done, std::size_t) { seen = done; };
        options_.keep_going = [&] { return seen < count; };
        EXPECT_THROW(fly(name), CampaignStopped);
        options_ = {};
    }

    TemporaryFolder place_;
    CampaignPlan plan_;
    CampaignOptions options_;
};

TEST_F(Campaign, TableDoesNotDependOnJobs) {
    EXPECT_EQ(fly("one").size(), 6u);
    options_.jobs = 3;
    fly("three");
    EXPECT_EQ(table("three"), table("one"));
    EXPECT_EQ(readRuns(place_ / "one/runs.csv").size(), 6u);
    EXPECT_EQ(textOf(readLatencyProfile(place_ / "one/profile.json")), textOf(constantProfile(1)));
}

TEST_F(Campaign, ResumesAfterInterruption) {
    fly("whole");
    flyUntil(2, "stopped");
    const std::string kept = table("stopped");
    EXPECT_EQ(std::count(kept.begin(), kept.end(), '\n'), 3);
    std::vector<std::size_t> done;
    options_.progress = [&](std::size_t now, std::size_t all) {
        EXPECT_EQ(all, 4u);
        done.push_back(now);
    };
    fly("stopped");
    EXPECT_THAT(done, testing::ElementsAre(0, 1, 2, 3, 4));
    EXPECT_EQ(table("stopped"), table("whole"));
}

TEST_F(Campaign, RepeatsFlightWithIncompleteRow) {
    fly("whole");
    flyUntil(2, "killed");
    std::ofstream(place_ / "killed/runs.csv", std::ios::app) << "forest-0.02,1,W-RoI,str";
    fly("killed");
    EXPECT_EQ(table("killed"), table("whole"));
}

TEST_F(Campaign, AddsFlightsFromOtherPlan) {
    const CampaignPlan all = plan_;
    fly("whole");
    for (const char* model : {"oracle", "W-RoI"}) {
        plan_.models = {model};
        fly("parts");
    }
    EXPECT_EQ(table("parts"), table("whole"));
    plan_ = all;
    EXPECT_EQ(fly("parts").size(), 6u);
}

TEST_F(Campaign, KeepsScansAndSectors) {
    plan_.last_seed = 0;
    plan_.models = {"W-RoI"};
    fly("c");
    plan_.updates = {Updates::Sectors};
    fly("c");
    EXPECT_THAT(table("c"), HasSubstr(",scans\n"));
    EXPECT_THAT(table("c"), HasSubstr(",sectors\n"));
}

TEST_F(Campaign, RefusesOtherSettings) {
    plan_.last_seed = 0;
    fly("c");
    const std::string before = table("c");
    EXPECT_THAT(messageOf([&] { fly("c", 2); }), HasSubstr("campaign.json: was flown with other "
                                                           "settings"));
    EXPECT_EQ(table("c"), before);
    fly("d", 2);
    fs::copy_file(place_ / "d/runs.csv", place_ / "c/runs.csv",
                  fs::copy_options::overwrite_existing);
    EXPECT_THAT(messageOf([&] { fly("c"); }), HasSubstr("runs.csv: was flown with other settings"));
    options_.overwrites = true;
    fly("c");
    EXPECT_EQ(table("c"), before);
}

TEST_F(Campaign, RefusesFolderWithOtherFiles) {
    place_.write("mine/file.txt", "text");
    options_.overwrites = true;
    EXPECT_THAT(messageOf([&] { fly("mine"); }), HasSubstr("has no campaign.json"));
    EXPECT_EQ(readFile(place_ / "mine/file.txt"), "text");
}

TEST_F(Campaign, WritesTableWithoutFlights) {
    EXPECT_TRUE(
        flyCampaign(flightsOf(plan_, {4, 4}), constantProfile(1), place_ / "c", {}).empty());
    EXPECT_EQ(table("c"), runHeader() + "\n");
}

TEST_F(Campaign, ReportsFlightError) {
    std::vector<CourseFlights> flights = flightsOf(plan_);
    flights[1].scenario = "moon";
    options_.jobs = 2;
    EXPECT_THROW(flyCampaign(flights, constantProfile(1), place_ / "c", options_),
                 std::invalid_argument);
}

}  // namespace
}  // namespace hagen::avoidance
