// Open-loop evaluation, run as a user would.
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/ProgramTest.h"

namespace hagen {
namespace {

using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;
const std::string kOrchard = HAGEN_SOURCE_DIR "/rawlogs/orchard.rawlog";
const std::vector<std::string> kModels{"--models", "W-RoI,O-Full-0.4"};

class OpenLoopCommand : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_OCTOMAP_COMPARE, with({"openloop"}, arguments));
    }
    /// A log of a few scans in a simple scene, and its poses.
    void simulate(int scans, const std::vector<std::string>& more = {}) const {
        const auto outcome = test::run(
            HAGEN_RAWLOG_SIMULATE, with({"--scenario", "gap", "--scans", std::to_string(scans),
                                         "--altitude", "2", "--seed", "3", "-o", path("gap.rawlog"),
                                         "--poses", path("gap.tum"), "--kitti", path("gap")},
                                        more));
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    std::vector<std::string> gap(const std::string& out) const {
        return with({"-i", path("gap.rawlog"), "--poses", path("gap.tum"), "-o", path(out)},
                    kModels);
    }
};

TEST_F(OpenLoopCommand, OracleIsExactAndModelsGetSameScans) {
    simulate(4);
    const auto outcome =
        run({"-i", path("gap.rawlog"), "--poses", path("gap.tum"), "--truth-scenario", "gap",
             "--truth-seed", "3", "--models", "oracle,W-RoI,W-Full", "-o", path("out")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("truth: the scene gap with seed 3"));
    const auto summary = nlohmann::json::parse(test::readFile(path("out/summary.json")));
    EXPECT_EQ(summary["scans"], 4);
    EXPECT_EQ(summary["scans_moved_whole"], 0);
    const auto& models = summary["models"];
    ASSERT_EQ(models.size(), 3u);
    EXPECT_EQ(models[0]["directions"]["all"]["precision"], 1.0);
    EXPECT_EQ(models[0]["directions"]["all"]["recall"], 1.0);
    EXPECT_EQ(models[0]["directions"]["all"]["scored"], 4 * 300);
    EXPECT_GT(models[1]["directions"]["level"]["recall"], 0.9);
    EXPECT_GT(models[2]["obstacles"], models[1]["obstacles"]);
    EXPECT_EQ(summary["free_agreement"]["jaccard"][0][0], 1.0);
#ifndef __SANITIZE_ADDRESS__  // ASan does not report heap sizes
    EXPECT_GT(summary["measured"]["models"][2]["peak_heap_bytes"], 100000);
#endif

    std::istringstream rows(test::readFile(path("out/scans.csv")));
    std::map<std::string, int> rows_of_returns;
    std::string row;
    std::getline(rows, row);
    EXPECT_EQ(row.rfind("scan,entry,time_s,model,returns,roi,", 0), 0u) << row;
    for (int n = 0; std::getline(rows, row); ++n) {
        std::vector<std::string> fields;
        std::istringstream line(row);
        for (std::string field; std::getline(line, field, ',');) fields.push_back(field);
        ASSERT_EQ(fields.size(), 18u) << row;
        EXPECT_EQ(fields[0], std::to_string(n / 3));
        ++rows_of_returns[fields[0] + " " + fields[4] + " " + fields[5]];
    }
    EXPECT_EQ(rows_of_returns.size(), 4u);
    for (const auto& [returns, times] : rows_of_returns) EXPECT_EQ(times, 3) << returns;
}

TEST_F(OpenLoopCommand, LogAndScanFolderYieldSameResults) {
    simulate(4);
    ASSERT_EQ(run(gap("a")).exit_code, 0);
    ASSERT_EQ(run(with(gap("b"), {"-q"})).out, "");
    for (const char* file : {"openloop.csv", "scans.csv", "agreement.csv"}) {
        EXPECT_EQ(test::readFile(folder_ / "a" / file), test::readFile(folder_ / "b" / file));
        EXPECT_GT(test::readFile(folder_ / "a" / file).size(), 40u);
    }
    const auto folder = run(with({"-i", path("gap"), "-o", path("c")}, kModels));
    ASSERT_EQ(folder.exit_code, 0) << folder.err;
    EXPECT_THAT(folder.err, HasSubstr("4 scans placed with a single pose"));
}

TEST_F(OpenLoopCommand, UsesPosesFromLog) {
    const auto outcome = run({"-i", kOrchard, "--models", "W-RoI", "-o", path("out")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("30 scans of"));
    EXPECT_THAT(outcome.out, HasSubstr("truth: raw points of later scans"));
}

TEST_F(OpenLoopCommand, CountsScansWithoutPose) {
    simulate(6);
    std::istringstream poses(test::readFile(path("gap.tum")));
    std::string some;
    int n = 0;
    for (std::string line; std::getline(poses, line) && n < 7; ++n) some += line + "\n";
    folder_.write("some.tum", some);
    const std::vector<std::string> log{"-i", path("gap.rawlog"), "--models", "W-RoI"};
    const auto outcome = run(with(log, {"--poses", path("some.tum"), "-o", path("out")}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("scans skipped: no pose within 0.2 s"));

    const std::size_t comment = some.find('\n'), first_pose = some.find('\n', comment + 1);
    folder_.write("other.tum", some.substr(0, some.find('\n', first_pose + 1) + 1));
    expectFailure(with(log, {"--poses", path("other.tum"), "-o", path("no")}), 1,
                  "covers only 1 of 6 scans in ");
    EXPECT_FALSE(fs::exists(path("no")));
    folder_.write("none.tum", "5 0 0 2 0 0 0 1\n");
    expectFailure(with(log, {"--poses", path("none.tum"), "-o", path("no")}), 1,
                  "covers none of the scans in ");
    EXPECT_FALSE(fs::exists(path("no")));
    folder_.write("empty.tum", "# nothing\n");
    expectFailure(with(log, {"--poses", path("empty.tum"), "-o", path("no")}), 1,
                  "contains no poses");
}

TEST_F(OpenLoopCommand, RejectsInvalidArguments) {
    const std::vector<std::string> orchard{"-i", kOrchard, "-o", path("no")};
    expectFailure(with(orchard, {"--models", "O-Full-0"}), 2, "O-Full-0");
    expectFailure(
        with(orchard, {"--models", "W-Roy"}), 2,
        "unknown world model 'W-Roy'; known: W-RoI (RoI window), W-RoI+motion (RoI window with "
        "motion), W-Full (full window), ");
    expectFailure(with(orchard, {"--models", "oracle"}), 2, "--truth-scenario");
    expectFailure(with(orchard, {"--truth-scenario", "jungle"}), 2, "known:");
    expectFailure(with(orchard, {"--sensor-label", "roof"}), 1,
                  "has no LiDAR scans labelled 'roof'; found: 'lidar'");
    expectFailure(with(orchard, {"--truth-seed", "3"}), 2, "--truth-scenario");
    expectFailure({"-i", path("missing.rawlog"), "-o", path("no")}, 2, "missing.rawlog");
    expectFailure({"-i", kOrchard}, 2, "--output");
    folder_.write("wrong.yaml", "zone: 3\n");
    expectFailure(with(orchard, {"-c", path("wrong.yaml")}), 2, "wrong.yaml");
    EXPECT_FALSE(fs::exists(path("no")));
}

TEST_F(OpenLoopCommand, KeepsExistingFiles) {
    fs::create_directory(path("out"));
    folder_.write("out/scans.csv", "mine");
    expectFailure({"-i", kOrchard, "--models", "W-RoI", "-o", path("out")}, 1,
                  "scans.csv exists; use --overwrite");
    EXPECT_EQ(test::readFile(path("out/scans.csv")), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(path("out")), fs::directory_iterator()), 1);
    folder_.write("file", "mine");
    expectFailure({"-i", kOrchard, "--models", "W-RoI", "-o", path("file")}, 1, "file");
}

TEST_F(OpenLoopCommand, KeepsScansFromTruncatedRawlog) {
    simulate(12);
    fs::resize_file(path("gap.rawlog"), fs::file_size(path("gap.rawlog")) * 2 / 3);
    const auto outcome = run(gap("out"));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("gap.rawlog: entry"));
    EXPECT_THAT(outcome.err, HasSubstr("preceding scans are in"));
    EXPECT_THAT(outcome.out, HasSubstr("RoI window"));
    EXPECT_TRUE(fs::exists(path("out/openloop.partial.csv")));
    EXPECT_FALSE(fs::exists(path("out/openloop.csv")));
    EXPECT_EQ(run(gap("out")).exit_code, 1);
    EXPECT_TRUE(fs::exists(path("out/openloop.partial-2.csv")));

    simulate(4, {"--overwrite"});
    const auto whole = run(gap("out"));
    ASSERT_EQ(whole.exit_code, 0);
    for (const auto& file : fs::directory_iterator(path("out"))) {
        EXPECT_THAT(file.path().filename().string(), Not(HasSubstr("partial"))) << file;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(path("out")), fs::directory_iterator()), 6);
}

TEST_F(OpenLoopCommand, FailedOutputKeepsOthers) {
    const auto writing = [&](const std::string& limit_kib) {
        const std::string command = "ulimit -f " + limit_kib + "; exec " HAGEN_OCTOMAP_COMPARE +
                                    " openloop -i " + kOrchard + " --models W-RoI,W-Full -o " +
                                    path("full" + limit_kib);
        return test::run("/bin/bash", {"-c", command});
    };
    const auto some = writing("1");
    EXPECT_EQ(some.exit_code, 1);
    EXPECT_THAT(some.out, HasSubstr("full window"));  // the table
    for (const char* large : {"scans.csv", "scans_measured.csv", "summary.json"}) {
        EXPECT_THAT(some.err,
                    HasSubstr(path("full1/") + large + ": cannot be written: File too large"));
        EXPECT_FALSE(fs::exists(path("full1/") + large));
    }
    for (const char* small : {"openloop.csv", "agreement.csv", "openloop_measured.csv"}) {
        EXPECT_THAT(some.err, Not(HasSubstr(small)));
        EXPECT_TRUE(fs::exists(path("full1/") + small));
    }

    EXPECT_EQ(writing("0").exit_code, 1);
    EXPECT_FALSE(fs::exists(path("full0")));
}

}  // namespace
}  // namespace hagen
