#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/logs/RawlogReader.h>
#include <hagen/recording/TurnRecorder.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "support/Program.h"
#include "support/SimpleFirings.h"

namespace hagen::recording {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

namespace fs = std::filesystem;

std::vector<std::string> labelsIn(const fs::path& file) {
    logs::RawlogReader reader(file);
    std::vector<std::string> labels;
    while (const auto entry = reader.next()) {
        const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry);
        labels.push_back(observation ? observation->sensorLabel : "?");
    }
    return labels;
}

class TurnRecorderTest : public testing::Test {
 protected:
    TurnRecorder::Options optionsOf(const std::string& name) const {
        TurnRecorder::Options options;
        options.file = folder_ / name;
        options.waits = true;
        return options;
    }
    test::TemporaryFolder folder_;
};

TEST_F(TurnRecorderTest, EachTurnIsFollowedByItsClouds) {
    TurnRecorder recorder(optionsOf("a.rawlog"), {});
    for (int k = 0; k < 3; ++k) recorder.add(test::poleScanFrom(k, "velodyne"));
    EXPECT_FALSE(fs::exists(folder_ / "a.rawlog"));
    const auto counts = recorder.finish();
    EXPECT_EQ(counts.turns, 3u);
    EXPECT_EQ(counts.left_out, 0u);
    EXPECT_THAT(counts.files, ElementsAre(folder_ / "a.rawlog"));
    const std::vector<std::string> labels = labelsIn(folder_ / "a.rawlog");
    ASSERT_EQ(labels.size(), 9u);
    for (std::size_t i = 0; i < 9; i += 3) {
        EXPECT_EQ(labels[i], "velodyne");
        EXPECT_EQ(labels[i + 1], "velodyne_roi");
        EXPECT_EQ(labels[i + 2], "velodyne_non_roi");
    }
}

/// As on a full disk.
TEST_F(TurnRecorderTest, TurnsThatCannotBeWrittenAreCounted) {
    rlimit usual{};
    getrlimit(RLIMIT_FSIZE, &usual);
    const auto handler = signal(SIGXFSZ, SIG_IGN);
    const rlimit short_files{250000, usual.rlim_max};
    setrlimit(RLIMIT_FSIZE, &short_files);
    TurnRecorder recorder(optionsOf("a.rawlog"), {});
    for (int k = 0; k < 4; ++k) recorder.add(test::poleScanFrom(k, "velodyne"));
    const auto counts = recorder.finish();
    setrlimit(RLIMIT_FSIZE, &usual);
    signal(SIGXFSZ, handler);
    EXPECT_THAT(counts.failure, HasSubstr((folder_ / "a.rawlog").string() + ": "));
    EXPECT_EQ(counts.failure.find(".tmp-"), std::string::npos) << counts.failure;
    EXPECT_EQ(counts.turns + counts.left_out, 4u);
    ASSERT_GT(counts.turns, 0u) << counts.failure;
    EXPECT_EQ(labelsIn(folder_ / "a.partial.rawlog").size(), 3 * counts.turns);
}

TEST_F(TurnRecorderTest, FilesEndWhenTheyAreLongEnough) {
    auto options = optionsOf("a.rawlog");
    options.rotate_bytes = 150000;  // each turn is a member of about 100 kB
    TurnRecorder recorder(options, {});
    for (int k = 0; k < 6; ++k) recorder.add(test::poleScanFrom(k, "velodyne"));
    const auto counts = recorder.finish();
    ASSERT_GE(counts.files.size(), 2u);
    EXPECT_EQ(counts.files[0], folder_ / "a.0001.rawlog");
    EXPECT_EQ(counts.files[1], folder_ / "a.0002.rawlog");
    std::size_t entries = 0;
    for (const auto& file : counts.files) entries += labelsIn(file).size();
    EXPECT_EQ(entries, 18u);
    EXPECT_FALSE(fs::exists(folder_ / "a.rawlog"));
}

TEST_F(TurnRecorderTest, WithoutTurnsThereIsNoFile) {
    TurnRecorder recorder(optionsOf("a.rawlog"), {});
    EXPECT_TRUE(recorder.finish().files.empty());
    EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(TurnRecorderTest, ExistingFilesAreKept) {
    folder_.write("a.rawlog", "mine");
    EXPECT_THAT(test::messageOf([&] { TurnRecorder(optionsOf("a.rawlog"), {}); }),
                HasSubstr("a.rawlog"));
    EXPECT_EQ(test::readFile(folder_ / "a.rawlog"), "mine");
}

/// A number that is taken would end the recording in flight.
TEST_F(TurnRecorderTest, NumbersThatAreTakenAreToldBeforeItBegins) {
    auto options = optionsOf("a.rawlog");
    options.rotate_bytes = 150000;
    for (const char* other : {"a.rawlog", "a.5.txt", "b.0005.rawlog", "a.x.rawlog", "a.rawlog.5"}) {
        folder_.write(other, "mine");
    }
    TurnRecorder(options, {}).finish();
    folder_.write("a.0005.rawlog", "mine");
    EXPECT_THAT(test::messageOf([&] { TurnRecorder(options, {}); }),
                HasSubstr("a.0005.rawlog: exists"));
    EXPECT_EQ(test::readFile(folder_ / "a.0005.rawlog"), "mine");

    options.overwrite = true;
    TurnRecorder recorder(options, {});
    recorder.add(test::poleScanFrom(0, "velodyne"));
    const auto counts = recorder.finish();
    EXPECT_THAT(counts.files, ElementsAre(folder_ / "a.0001.rawlog"));
    EXPECT_THAT(counts.older_files, ElementsAre(folder_ / "a.0005.rawlog"));
}

TEST_F(TurnRecorderTest, NamesThatNoPartCanHaveAreToldBeforeItBegins) {
    auto options = optionsOf("a.rawlog");
    options.rotate_bytes = 150000;
    options.overwrite = true;
    options.others = {"", folder_ / "a.0007.rawlog", folder_ / "b.0001.rawlog"};
    const auto refusal = [&] { return test::messageOf([&] { TurnRecorder(options, {}); }); };
    EXPECT_THAT(refusal(), HasSubstr("a.0007.rawlog: has the name of a part"));
    options.others.clear();
    fs::create_directory(folder_ / "a.0003.rawlog");
    EXPECT_THAT(refusal(), HasSubstr("a.0003.rawlog: is no file"));
    fs::remove(folder_ / "a.0003.rawlog");
    EXPECT_EQ(refusal(), "");
}

TEST_F(TurnRecorderTest, AfterAKillTheFileIsReadable) {
    const pid_t child = fork();
    if (child == 0) {
        TurnRecorder recorder(optionsOf("a.rawlog"), {});
        for (int k = 0; k < 1000000; ++k) recorder.add(test::poleScanFrom(k % 10, "velodyne"));
        _exit(0);
    }
    const auto written = [&]() -> std::uintmax_t {
        for (const auto& file : fs::directory_iterator(folder_.path())) {
            return fs::file_size(file.path());
        }
        return 0;
    };
    for (int i = 0; i < 2000 && written() < 500000; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const std::vector<fs::path> files = base::partialOutputs(folder_ / "a.rawlog");
    ASSERT_EQ(files.size(), 1u);
    // A member may be half written; all before it are read.
    std::vector<std::string> labels;
    try {
        logs::RawlogReader reader(files[0]);
        while (const auto entry = reader.next()) {
            labels.push_back(
                std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry)->sensorLabel);
        }
    } catch (const std::runtime_error& e) {
        EXPECT_THAT(e.what(), HasSubstr(files[0].string()));
    }
    EXPECT_GE(labels.size(), 3u);
}

}  // namespace
}  // namespace hagen::recording
