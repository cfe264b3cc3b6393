#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/trials/Calibration.h>
#include <hagen/trials/CampaignFile.h>
#include <hagen/trials/CampaignFolder.h>
#include <hagen/trials/Journal.h>
#include <hagen/trials/LatencyProfile.h>
#include <hagen/trials/Measured.h>
#include <hagen/trials/MergeCampaigns.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <map>

#include "support/Program.h"

namespace hagen::trials {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;
using test::messageOf;
using test::readFile;
using test::TemporaryFolder;
using Row = hagen::trials::Run;  // a test has a Run() of its own

Row runOfSeed(std::uint64_t seed, const CampaignFolder& folder, double path_m = 40) {
    Row run{};
    run.scenario = "gap";
    run.seed = seed;
    run.result = {Outcome::Success, 0.7, path_m, 12, NAN, 20, 120, 4, 1, 3.5, 7.25, 9};
    run.oracle_path_m = 40;
    run.settings_hash = folder.settingsHash();
    run.version = "0.1.0";
    return run;
}

void journal(CampaignFolder& folder, const std::vector<std::uint64_t>& seeds) {
    Journal journal(folder.newJournal());
    TrialMeasurement measurement;
    measurement.stage_ms["W-RoI/update"] = {1, 2, 3};
    for (const std::uint64_t seed : seeds) journal.append(runOfSeed(seed, folder), measurement);
}

TEST(Journal, AFullDiskIsNamed) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    const TemporaryFolder place;
    CampaignFolder folder(place / "c", constantProfile(1), false);
    Journal journal("/dev/full");
    try {
        journal.append(runOfSeed(1, folder), {});
        ADD_FAILURE() << "took a row that went nowhere";
    } catch (const std::runtime_error& e) {
        EXPECT_THAT(e.what(), HasSubstr("/dev/full"));
    }
}

TEST(CampaignFolder, WhatIsInJournalsIsThereAgain) {
    const TemporaryFolder place;
    {
        CampaignFolder folder(place / "c", constantProfile(1), false);
        journal(folder, {3, 1});
        journal(folder, {2});
    }
    CampaignFolder folder(place / "c", constantProfile(1), false);
    EXPECT_EQ(folder.size(), 3u);
    EXPECT_TRUE(folder.has(runOfSeed(2, folder)));
    EXPECT_FALSE(folder.has(runOfSeed(4, folder)));
    folder.finish();
    EXPECT_FALSE(fs::exists(place / "c/journal"));
    const auto runs = readRuns(place / "c/runs.csv");
    ASSERT_EQ(runs.size(), 3u);
    EXPECT_EQ(runs[0].seed, 1u);
    EXPECT_THAT(readFile(place / "c/measured.csv"),
                HasSubstr("gap,1,W-RoI,astar,4,primitives,none,1,optimistic,dusty,unbiased,,,2.000,"
                          "2.900,,,,,0\n"));
}

TEST(CampaignFolder, AJournalThatIsNoFileIsNamedAndNotWaitedFor) {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "journal");
    ASSERT_EQ(mkfifo((folder / "journal/7.csv").c_str(), 0600), 0);
    EXPECT_THAT(test::messageOf([&] { readJournal(folder / "journal/7.csv"); }),
                testing::HasSubstr("7.csv: is a pipe or a device"));
}

TEST(CampaignFolder, AFinishedOneIsAddedTo) {
    const TemporaryFolder place;
    for (const std::uint64_t seed : {7u, 5u}) {
        CampaignFolder folder(place / "c", constantProfile(1), false);
        journal(folder, {seed});
        folder.readJournals();
        folder.finish();
    }
    EXPECT_EQ(readRuns(place / "c/runs.csv").size(), 2u);
    const std::string measured = readFile(place / "c/measured.csv");
    EXPECT_EQ(std::count(measured.begin(), measured.end(), '\n'), 3);
}

TEST(CampaignFolder, RunsWithSectorsComeToOneOfWholeScans) {
    const TemporaryFolder place;
    CampaignPlan plan;
    {
        CampaignFolder folder(place / "c", constantProfile(1), false);
        folder.note(plan);
        journal(folder, {1});
        folder.readJournals();
        folder.finish();
    }
    const std::string before = readFile(place / "c/runs.csv");
    const std::string measured = readFile(place / "c/measured.csv");
    EXPECT_EQ(readFile(place / "c/campaign.json").find("updates"), std::string::npos);
    {
        CampaignFolder folder(place / "c", constantProfile(1), false);
        plan.updates = {Updates::Sectors};
        folder.note(plan);
        Row run = runOfSeed(1, folder);
        EXPECT_TRUE(folder.has(run));
        run.setup.updates = Updates::Sectors;
        EXPECT_FALSE(folder.has(run));
        TrialMeasurement measurement;
        measurement.stage_ms["W-RoI/update"] = {5};
        Journal(folder.newJournal()).append(run, measurement);
        folder.readJournals();
        folder.finish();
    }
    const std::string scans = before.substr(before.find('\n') + 1);
    const std::string row = scans.substr(0, scans.size() - 1);
    EXPECT_EQ(readFile(place / "c/runs.csv"),
              fullRunHeader() + "\n" + row + ",scans\n" + row + ",sectors\n");
    const std::string all_measured = readFile(place / "c/measured.csv");
    EXPECT_EQ(all_measured.substr(0, all_measured.find(',')), "scenario");
    EXPECT_THAT(all_measured, HasSubstr(",peak_model_bytes,updates\n"));
    EXPECT_THAT(all_measured, HasSubstr(",,,2.000,2.900,,,,,0,scans\n"));
    EXPECT_THAT(all_measured, HasSubstr(",,,5.000,5.000,,,,,0,sectors\n"));
    // Read and written again, it is the same, and each run has its costs.
    const std::string all = readFile(place / "c/runs.csv");
    CampaignFolder(place / "c", constantProfile(1), false).finish();
    EXPECT_EQ(readFile(place / "c/runs.csv"), all);
    EXPECT_EQ(readFile(place / "c/measured.csv"), all_measured);
    EXPECT_EQ(readPlans(place / "c").size(), 2u);
    // The report's costs are told apart, too.
    const auto costs = readMeasured(place / "c/measured.csv");
    ASSERT_EQ(costs.size(), 2u);
    EXPECT_EQ(costs.begin()->first.first.updates, Updates::Scans);
    EXPECT_EQ(costs.begin()->first.second.model, "W-RoI");
    EXPECT_EQ(costs.begin()->second.p50_ms.at("update").size(), 1u);
    EXPECT_EQ(measured.find("updates"), std::string::npos);
}

TEST(CampaignFolder, ATornLastLineIsFlownAgainAndAnyOtherIsNamed) {
    const TemporaryFolder place;
    {
        CampaignFolder folder(place / "c", constantProfile(1), false);
        journal(folder, {1, 2, 3});
    }
    const std::string whole = readFile(place / "c/journal/1.csv");
    const std::size_t third = whole.rfind("gap,3,");
    for (std::size_t end = third; end < whole.size() - 1; end += 7) {  // torn anywhere
        std::ofstream(place / "c/journal/1.csv", std::ios::binary) << whole.substr(0, end);
        CampaignFolder folder(place / "c", constantProfile(1), false);
        EXPECT_EQ(folder.size(), 2u) << end;
        EXPECT_NE(folder.newJournal(), place / "c/journal/1.csv");
    }
    std::ofstream(place / "c/journal/1.csv", std::ios::binary) << "gap,9\n" << whole;
    const std::string message =
        messageOf([&] { CampaignFolder(place / "c", constantProfile(1), false); });
    EXPECT_EQ(message.find((place / "c/journal/1.csv").string() + ":1: "), 0u) << message;
}

TEST(CampaignFolder, WhatWasMeasuredIsCheckedBeforeItGoesIntoTheTable) {
    const TemporaryFolder place;
    std::string whole;
    {
        CampaignFolder folder(place / "c", constantProfile(1), false);
        journal(folder, {1});
        whole = readFile(place / "c/journal/1.csv");
    }
    const std::size_t tab = whole.find('\t'), last = whole.rfind(',');
    const auto spoilt = [&](std::size_t at, std::size_t count, const std::string& with) {
        std::string line = whole;
        return line.replace(at, count, with);
    };
    for (const std::string& line :
         {spoilt(last + 1, 0, "0.8x4"), spoilt(last, whole.size() - last, ";\n"),
          spoilt(last + 1, 0, std::string(1, '\0')), spoilt(tab + 1, 3, "saw")}) {
        std::ofstream(place / "c/journal/1.csv", std::ios::binary) << line;
        EXPECT_THAT(messageOf([&] { CampaignFolder(place / "c", constantProfile(1), false); }),
                    HasSubstr((place / "c/journal/1.csv").string() + ":1: "));
    }
    std::ofstream(place / "c/journal/1.csv", std::ios::binary) << whole;
    CampaignFolder(place / "c", constantProfile(1), false).finish();
    std::string table = readFile(place / "c/measured.csv");
    std::ofstream(place / "c/measured.csv", std::ios::binary)
        << table.insert(table.size() - 1, "x");
    EXPECT_THAT(messageOf([&] { CampaignFolder(place / "c", constantProfile(1), false); }),
                HasSubstr((place / "c/measured.csv").string() + ":2: "));
}

TEST(CampaignFolder, OneThatWasStoppedWhileItWasMadeIsMadeWhole) {
    const TemporaryFolder place;
    { CampaignFolder folder(place / "c", constantProfile(1), false); }
    fs::remove(place / "c/profile.json");
    { CampaignFolder folder(place / "c", constantProfile(1), false); }
    EXPECT_EQ(readLatencyProfile(place / "c/profile.json").machine, constantProfile(1).machine);
    // Killed before its first file had a name.
    const std::string killed = "campaign.json.tmp-999999999-0123456789abcdef";
    place.write("d/" + killed, "{");
    { CampaignFolder folder(place / "d", constantProfile(1), false); }
    EXPECT_FALSE(fs::exists(place / "d" / killed));
    EXPECT_TRUE(fs::exists(place / "d/campaign.json"));
    // Failed before that: what it wrote is kept.
    place.write("e/campaign.partial.json", "{");
    { CampaignFolder folder(place / "e", constantProfile(1), false); }
    EXPECT_TRUE(fs::exists(place / "e/campaign.json"));
    EXPECT_EQ(readFile(place / "e/campaign.partial.json"), "{");
}

/// Killed while the files of another profile replaced it: campaign.json is the first to be there.
TEST(CampaignFolder, OneThatWasKilledWhileItWasOverwrittenIsMadeWhole) {
    const TemporaryFolder place;
    std::string campaign;
    {
        CampaignFolder folder(place / "new", constantProfile(2), false);
        campaign = readFile(place / "new/campaign.json");
    }
    const auto filled = [&](const std::string& name) {
        CampaignFolder folder(place / name, constantProfile(1), false);
        journal(folder, {1});
        folder.readJournals();
        folder.finish();
    };
    filled("c");
    // No name is free for profile.json: the step after the first new name fails.
    fs::remove(place / "c/profile.json");
    fs::create_directory(place / "c/profile.json");
    EXPECT_NE(
        messageOf([&] { CampaignFolder(place / "c", constantProfile(2), true).newJournal(); }), "");
    // Before it, everything but campaign.json is gone.
    filled("d");
    for (const char* old : {"profile.json", "runs.csv", "measured.csv"})
        fs::remove(place / "d" / old);
    place.write("d/campaign.json", campaign);
    CampaignFolder folder(place / "d", constantProfile(2), false);
    EXPECT_EQ(folder.size(), 0u);
    EXPECT_EQ(readFile(place / "d/profile.json"), textOf(constantProfile(2)));
}

TEST(CampaignFolder, OneThatCannotBeRemovedRemainsACampaign) {
    const TemporaryFolder place;
    { CampaignFolder folder(place / "c", constantProfile(1), false); }
    fs::create_directories(place / "c/runs.csv/full");
    EXPECT_THAT(
        messageOf([&] { CampaignFolder(place / "c", constantProfile(2), true).newJournal(); }),
        HasSubstr("runs.csv"));
    fs::remove_all(place / "c/runs.csv");
    EXPECT_EQ(messageOf([&] { CampaignFolder(place / "c", constantProfile(1), false); }), "");
}

TEST(CampaignFolder, WhatIsOverwrittenStaysUntilWhatReplacesItIsWritten) {
    const TemporaryFolder place;
    const auto textsOf = [&](const std::string& name) {
        std::map<std::string, std::string> texts;
        for (const auto& entry : fs::recursive_directory_iterator(place / name)) {
            const bool is_file = entry.is_regular_file();
            texts[entry.path().filename()] = is_file ? readFile(entry.path()) : "";
        }
        return texts;
    };
    {
        CampaignFolder folder(place / "c", constantProfile(1), false);
        journal(folder, {1, 2});
        folder.readJournals();
        folder.finish();
        journal(folder, {3});
    }
    const auto before = textsOf("c");
    EXPECT_EQ(before.size(), 6u);  // with the journal and its folder
    const CampaignPlan plan;
    const auto failing = [&](const auto& action) {
        rlimit before_limit{};
        getrlimit(RLIMIT_FSIZE, &before_limit);
        const rlimit none{0, before_limit.rlim_max};
        const auto before_signal = std::signal(SIGXFSZ, SIG_IGN);
        setrlimit(RLIMIT_FSIZE, &none);
        const std::string told = messageOf(action);
        setrlimit(RLIMIT_FSIZE, &before_limit);
        std::signal(SIGXFSZ, before_signal);
        EXPECT_THAT(told, HasSubstr("cannot be written"));
        EXPECT_EQ(textsOf("c"), before);
    };
    failing([&] { CampaignFolder(place / "c", constantProfile(2), true).note(plan); });
    failing([&] { CampaignFolder(place / "c", constantProfile(2), true).newJournal(); });
    failing([&] { CampaignFolder(place / "c", constantProfile(2), true).finish(); });

    CampaignFolder folder(place / "c", constantProfile(2), true);
    EXPECT_EQ(textsOf("c"), before);
    folder.note(plan);
    const auto after = textsOf("c");
    EXPECT_EQ(after.size(), 2u);
    EXPECT_EQ(after.at("profile.json"), textOf(constantProfile(2)));
}

TEST(CampaignFolder, OtherSettingsAreRefusedUnlessItBeginsAnew) {
    const TemporaryFolder place;
    {
        CampaignFolder folder(place / "c", constantProfile(1), false);
        journal(folder, {1});
    }
    EXPECT_THAT(messageOf([&] { CampaignFolder(place / "c", constantProfile(2), false); }),
                HasSubstr("other settings"));
    EXPECT_EQ(CampaignFolder(place / "c", constantProfile(1), false).size(), 1u);
    EXPECT_EQ(CampaignFolder(place / "c", constantProfile(2), true).size(), 0u);
    EXPECT_EQ(CampaignFolder(place / "c", constantProfile(1), false).size(), 1u);  // as it was
}

TEST(CampaignFolder, AFolderOfOthersIsLeftAlone) {
    const TemporaryFolder place;
    place.write("c/mine.txt", "text");
    for (const bool overwrite : {false, true}) {
        EXPECT_NE(messageOf([&] { CampaignFolder(place / "c", constantProfile(1), overwrite); }),
                  "");
    }
    EXPECT_EQ(readFile(place / "c/mine.txt"), "text");
    place.write("file", "text");
    EXPECT_NE(messageOf([&] { CampaignFolder(place / "file", constantProfile(1), true); }), "");
}

TEST(CampaignFolder, TwoProgramsDoNotWriteToOne) {
    const TemporaryFolder place;
    const CampaignFolder folder(place / "c", constantProfile(1), false);
    EXPECT_THAT(messageOf([&] { CampaignFolder(place / "c", constantProfile(1), false); }),
                HasSubstr("another"));
}

TEST(MergeCampaigns, SaysThatAnotherVersionFlewAPart) {
    const TemporaryFolder place;
    { const CampaignFolder folder(place / "a", constantProfile(1), false); }
    place.write("a/profile.json", textOf(constantProfile(2)));
    EXPECT_THAT(messageOf([&] { mergeCampaigns({place / "a"}, place / "m", true); }),
                AllOf(HasSubstr("another version"), Not(HasSubstr("--overwrite"))));
}

TEST(MergeCampaigns, JoinsWhatAgreesAndRefusesWhatContradicts) {
    const TemporaryFolder place;
    const auto fly = [&](const std::string& name, std::vector<std::uint64_t> seeds, double ms) {
        CampaignFolder folder(place / name, constantProfile(ms), false);
        journal(folder, seeds);
        folder.readJournals();
        folder.finish();
    };
    fly("a", {1, 3}, 1);
    fly("b", {2, 3}, 1);
    fly("ab", {3, 2, 1}, 1);
    fly("other", {4}, 2);
    EXPECT_EQ(mergeCampaigns({place / "a", place / "b"}, place / "m", false), 3u);
    EXPECT_EQ(readFile(place / "m/runs.csv"), readFile(place / "ab/runs.csv"));
    EXPECT_EQ(readFile(place / "m/measured.csv"), readFile(place / "ab/measured.csv"));
    EXPECT_THAT(messageOf([&] {
                    mergeCampaigns({place / "a", place / "other"}, place / "n", false);
                }),
                HasSubstr("other settings"));
    EXPECT_THAT(messageOf([&] {
                    mergeCampaigns({place / "a", place / "none"}, place / "o", false);
                }),
                HasSubstr("none"));
    std::string runs = readFile(place / "b/runs.csv");
    runs.replace(runs.rfind(",40.000,12"), 7, ",41.000");
    std::ofstream(place / "b/runs.csv", std::ios::binary) << runs;
    EXPECT_THAT(messageOf([&] {
                    mergeCampaigns({place / "a", place / "b"}, place / "p", false);
                }),
                HasSubstr("contradicts"));
    // The output is as it was.
    EXPECT_FALSE(fs::exists(place / "p"));
    const std::string before = readFile(place / "m/runs.csv");
    const std::string plans = readFile(place / "m/campaign.json");
    for (const bool overwrites : {false, true}) {
        EXPECT_NE(messageOf([&] {
                      mergeCampaigns({place / "a", place / "b"}, place / "m", overwrites);
                  }),
                  "");
        EXPECT_EQ(readFile(place / "m/runs.csv"), before);
        EXPECT_EQ(readFile(place / "m/campaign.json"), plans);
    }
    EXPECT_EQ(mergeCampaigns({place / "a", place / "a/"}, place / "q", false), 2u);
    // Another one is overwritten whole.
    EXPECT_EQ(mergeCampaigns({place / "other"}, place / "m", true), 1u);
    for (const char* file : {"campaign.json", "profile.json", "runs.csv", "measured.csv"}) {
        EXPECT_EQ(readFile(place / "m" / file), readFile(place / "other" / file));
    }
}

}  // namespace
}  // namespace hagen::trials
