// Campaigns whose workers are shell scripts: nothing is flown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/trials/Calibration.h>
#include <hagen/trials/Campaign.h>
#include <hagen/trials/MeasuredTable.h>

#include "support/Program.h"

namespace hagen::trials {
namespace {

namespace fs = std::filesystem;
using test::messageOf;
using test::readFile;
using test::TemporaryFolder;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;
using Row = hagen::trials::Run;  // a test has a Run() of its own

class Campaign : public testing::Test {
 protected:
    Campaign() {
        CampaignPlan plan;
        plan.scenarios = {"gap", "street"};
        plan.last_seed = 9;
        plan.models = {"W-RoI", "oracle"};
        flights_ = flightsOf(plan);
    }

    CampaignFolder folder(const std::string& name) const {
        return CampaignFolder(place_ / name, constantProfile(1), false);
    }

    /// A script in which $journal is the journal's path and "$@" are the keys; `fly KEY` appends
    /// the run's line to the journal.
    CampaignOptions running(const std::string& script, int jobs = 1) {
        const std::string lines = place_.write("lines", allLines()).string();
        CampaignOptions options;
        options.jobs = jobs;
        options.worker = {"/bin/sh",
                          {"sh", "-c",
                           "journal=$6; shift 6; fly() { grep -F \"$1|\" '" + lines +
                               "' | cut -d'|' -f2 >>\"$journal\"; }; " + script,
                           "worker"}};
        return options;
    }

    std::size_t fly(const CampaignOptions& options, const std::string& name) {
        CampaignFolder campaign = folder(name);
        return flyCampaign(flights_, options, campaign);
    }

    TemporaryFolder place_;
    const std::string all_ = "for key; do fly \"$key\"; done";
    /// Waits, for longer than anything takes here, and leaves a file if nobody stopped it.
    const std::string waiting_ = "for i in $(seq 200); do sleep 0.1; done; touch '" +
                                 (place_ / "not stopped").string() + "'";
    std::vector<CourseFlights> flights_;

 private:
    /// "KEY|line of a journal" of each run.
    std::string allLines() const {
        const std::string hash = folder("hash").settingsHash();
        std::string lines;
        for (const CourseFlights& course : flights_) {
            for (const TrialSetup& setup : course.setups) {
                Row run{};
                run.scenario = course.scenario;
                run.seed = course.seed;
                run.setup = setup;
                run.settings_hash = hash;
                lines += keyOf(run) + "|" + rowOf(run) + "\t" + measuredRowOf(run, {}) + ";\n";
            }
        }
        return lines;
    }
};

TEST_F(Campaign, TheSameBytesForAnyNumberOfJobs) {
    EXPECT_EQ(fly(running(all_, 1), "one"), 40u);
    EXPECT_EQ(fly(running(all_, 3), "three"), 40u);
    EXPECT_EQ(fly(running(all_, 100), "many"), 40u);
    EXPECT_EQ(readRuns(place_ / "one/runs.csv").size(), 40u);
    for (const char* name : {"three", "many"}) {
        EXPECT_EQ(readFile(place_ / name / "runs.csv"), readFile(place_ / "one/runs.csv"));
        EXPECT_EQ(readFile(place_ / name / "measured.csv"), readFile(place_ / "one/measured.csv"));
    }
    EXPECT_FALSE(fs::exists(place_ / "one/journal"));
    EXPECT_EQ(fly(running("exit 1"), "one"), 0u);  // nothing is left to fly
}

TEST_F(Campaign, ProgressCountsFinishedRuns) {
    CampaignOptions options = running(all_ + "; sleep 0.2", 2);
    std::size_t last = 0;
    std::vector<std::size_t> seen;
    options.progress = [&](std::size_t done, std::size_t all) {
        EXPECT_EQ(all, 40u);
        EXPECT_GE(done, last);
        last = done;
        seen.push_back(done);
    };
    fly(options, "c");
    // On a busy machine some runs are through before the first report.
    EXPECT_LT(seen.front(), 40u);
    EXPECT_EQ(seen.back(), 40u);
}

TEST_F(Campaign, WhyAWorkerFailedIsToldAndFinishedRunsAreKept) {
    const std::string kept = " finished runs are kept in " + (place_ / "c/journal").string() +
                             "; the same command resumes there";
    const auto failsWith = [&](const std::string& script) {
        return messageOf([&] { fly(running(script), "c"); });
    };
    EXPECT_EQ(failsWith("echo 'too tired' >&2; exit 1"), "too tired; 0" + kept);
    EXPECT_EQ(failsWith("fly \"$1\"; exit 3"),
              "a worker ended with exit status 3 at "
              "gap,0,oracle,astar,4,primitives,none,1,optimistic,dusty,unbiased; 1" +
                  kept);
    EXPECT_THAT(failsWith("fly \"$1\"; echo 'out of air' >&2; kill -9 $$"),
                AllOf(StartsWith("a worker was killed by signal 9 (Killed) at street,0,W-RoI,"),
                      EndsWith(": out of air; 1" + kept)));
    EXPECT_FALSE(fs::exists(place_ / "c/runs.csv"));
    EXPECT_EQ(fly(running(all_), "c"), 38u);
    EXPECT_EQ(readRuns(place_ / "c/runs.csv").size(), 40u);
}

TEST_F(Campaign, OneFailureStopsAllJobs) {
    const CampaignOptions options = running("case $1 in gap,0,*) exit 3;; esac; " + waiting_, 4);
    EXPECT_THAT(messageOf([&] { fly(options, "c"); }), HasSubstr("exit status 3 at gap,0,"));
    EXPECT_FALSE(fs::exists(place_ / "not stopped"));
}

TEST_F(Campaign, ToldToStopItKeepsFinishedRunsAndGoesOnLater) {
    CampaignOptions options = running("fly \"$1\"; " + waiting_, 2);
    std::size_t seen = 0;
    options.progress = [&](std::size_t done, std::size_t) { seen = done; };
    options.keep_going = [&] { return seen < 2; };
    try {
        fly(options, "c");
        ADD_FAILURE() << "did not stop";
    } catch (const CampaignStopped& e) {
        EXPECT_THAT(e.what(), StartsWith("interrupted; 2 of 40 runs are kept in "));
    }
    EXPECT_FALSE(fs::exists(place_ / "not stopped"));
    EXPECT_EQ(fly(running(all_), "c"), 38u);
}

TEST_F(Campaign, AWorkerThatIsToldToStopStopsTheCampaign) {
    for (const char* end : {"exit 0", "kill -TERM $$"}) {
        try {
            fly(running(std::string("fly \"$1\"; ") + end), end);
            ADD_FAILURE() << "did not stop";
        } catch (const CampaignStopped& e) {
            EXPECT_THAT(e.what(), StartsWith("interrupted; 1 of 40 runs are kept in "));
        }
    }
}

TEST_F(Campaign, TheFolderStaysLockedWhileAWorkerLives) {
    fly(running(all_ + "; sleep 3 2>/dev/null >&2 &"), "c");
    EXPECT_THAT(messageOf([&] { folder("c"); }), HasSubstr("another octomap-compare"));
}

TEST_F(Campaign, AProgramThatCannotBeStartedIsNamed) {
    CampaignOptions options;
    options.worker = {"/nowhere/worker", {"worker"}};
    EXPECT_THAT(messageOf([&] { fly(options, "c"); }), HasSubstr("/nowhere/worker"));
}

}  // namespace
}  // namespace hagen::trials
