#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/base/OutputPath.h>
#include <hagen/base/WriteFile.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <stdexcept>

#include "support/Program.h"

namespace hagen::base {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

TEST(OutputPath, AFileAppearsWhenItIsWhole) {
    const test::TemporaryFolder folder;
    OutputPath output(folder / "a.rawlog", kFile, false);
    std::ofstream(output.temporary()) << "new";
    EXPECT_FALSE(fs::exists(folder / "a.rawlog"));
    output.commit();
    EXPECT_EQ(test::readFile(folder / "a.rawlog"), "new");
}

TEST(CloseWritten, TellsWhyAFileCannotBeWritten) {
    const test::TemporaryFolder folder;
    const auto refusal = [&](const fs::path& place) {
        return test::messageOf([&] { writeText("text", place, "named.csv"); });
    };
    EXPECT_EQ(refusal(folder.path()), "named.csv: cannot be written: Is a directory");
    EXPECT_EQ(refusal(folder / "no/a.csv"),
              "named.csv: cannot be written: No such file or directory");
    if (fs::exists("/dev/full")) {
        EXPECT_EQ(refusal("/dev/full"), "named.csv: cannot be written: No space left on device");
        std::ofstream out("/dev/full");  // full before it is closed
        out << std::string(100000, 'x') << std::flush;
        errno = EACCES;  // of something else since
        EXPECT_EQ(test::messageOf([&] { closeWritten(out, "named.csv"); }),
                  "named.csv: cannot be written: No space left on device");
    }
    EXPECT_EQ(refusal(folder / "a.csv"), "");
    EXPECT_EQ(test::readFile(folder / "a.csv"), "text");
}

TEST(OutputPath, WhatExistsIsReplacedOnlyWhereWanted) {
    const test::TemporaryFolder folder;
    folder.write("a.rawlog", "old");
    EXPECT_THROW(OutputPath(folder / "a.rawlog", kFile, false), std::runtime_error);
    OutputPath output(folder / "a.rawlog", kFile, true);
    std::ofstream(output.temporary()) << "new";
    EXPECT_EQ(test::readFile(folder / "a.rawlog"), "old");
    output.commit();
    EXPECT_EQ(test::readFile(folder / "a.rawlog"), "new");
}

TEST(OutputPath, GivenUpLeavesWhatWasThere) {
    const test::TemporaryFolder folder;
    folder.write("a.rawlog", "old");
    {
        OutputPath output(folder / "a.rawlog", kFile, true);
        std::ofstream(output.temporary()) << "half";
    }
    EXPECT_EQ(test::readFile(folder / "a.rawlog"), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputPath, APartSaysSoInItsName) {
    const test::TemporaryFolder folder;
    OutputPath output(folder / "a.rawlog", kFile, false);
    std::ofstream(output.temporary()) << "half";
    EXPECT_EQ(output.keepPartial(), folder / "a.partial.rawlog");
    EXPECT_EQ(test::readFile(folder / "a.partial.rawlog"), "half");
}

TEST(OutputPath, AFolderThatIsNotThereIsNamed) {
    const test::TemporaryFolder folder;
    try {
        OutputPath output(folder / "none/a.rawlog", kFile, false);
        FAIL();
    } catch (const std::runtime_error& e) {
        EXPECT_THAT(e.what(), HasSubstr((folder / "none").string()));
    }
}

TEST(OutputPath, APartNeverReplacesAnother) {
    const test::TemporaryFolder folder;
    folder.write("a.partial.rawlog", "of another run");
    OutputPath output(folder / "a.rawlog", kFile, true);
    std::ofstream(output.temporary()) << "half";
    EXPECT_EQ(output.keepPartial(), folder / "a.partial-2.rawlog");
    EXPECT_EQ(test::readFile(folder / "a.partial.rawlog"), "of another run");
}

TEST(OutputPath, PartsOfEarlierRunsAreFoundByTheirNames) {
    const test::TemporaryFolder folder;
    const fs::path file = folder / "a.rawlog", directory = folder / "out.v2";
    EXPECT_TRUE(partialOutputs(file).empty());
    EXPECT_TRUE(partialOutputs("").empty());
    EXPECT_TRUE(partialOutputs(folder / "none/a.rawlog").empty());
    for (int run = 0; run < 2; ++run) {
        OutputPath output(file, kFile, true);
        std::ofstream(output.temporary()) << "half";
        output.keepPartial();
        OutputPath parts(directory, kFile, true);
        fs::create_directory(parts.temporary());
        parts.keepPartial();
    }
    for (const char* other : {"a.partial.mcap", "a.partial-x.rawlog", "a.partial-.rawlog",
                              "ab.partial.rawlog", "a.partial", "out.partial"}) {
        folder.write(other, "of somebody");
    }
    EXPECT_THAT(partialOutputs(file),
                testing::ElementsAre(folder / "a.partial-2.rawlog", folder / "a.partial.rawlog"));
    fs::create_directory(directory);
    EXPECT_THAT(partialOutputs(directory),
                testing::ElementsAre(folder / "out.v2.partial", folder / "out.v2.partial-2"));
    EXPECT_EQ(partialOutputs(directory.string() + "/"), partialOutputs(directory));
}

/// Such as /dev/stdout.
TEST(OutputPath, ALinkIsNotReplaced) {
    const test::TemporaryFolder folder;
    folder.write("file", "old");
    fs::create_symlink("file", folder / "link");
    fs::create_symlink("nowhere", folder / "dangling");
    for (const char* name : {"link", "dangling"}) {
        EXPECT_THAT(test::messageOf([&] { OutputPath(folder / name, kFile, true); }),
                    HasSubstr("a link, so it is not replaced"));
        EXPECT_TRUE(fs::is_symlink(folder / name));
    }
}

TEST(OutputPath, AFolderThatAppearsMeanwhileIsNotReplaced) {
    const test::TemporaryFolder folder;
    OutputPath output(folder / "scans", {"a folder", [](const fs::path&) { return true; }}, false);
    fs::create_directory(output.temporary());
    std::ofstream(output.temporary() / "new");
    fs::create_directory(folder / "scans");
    folder.write("scans/precious", "theirs");
    EXPECT_THAT(test::messageOf([&] { output.commit(); }), HasSubstr("scans.partial"));
    EXPECT_EQ(test::readFile(folder / "scans/precious"), "theirs");
    EXPECT_TRUE(fs::exists(folder / "scans.partial/new"));
    EXPECT_EQ(output.keepPartial(), folder / "scans.partial");  // already
}

TEST(OutputPath, AFolderThatCannotBeRenamedIsRefusedAtOnce) {
    const OutputKind any{"a folder", [](const fs::path&) { return true; }};
    const test::TemporaryFolder folder;
    fs::create_directories(folder / "scans/velodyne");
    const fs::path before = fs::current_path();
    fs::current_path(folder / "scans/velodyne");
    for (const fs::path& here : {fs::path(".."), folder / "scans", fs::path("../../scans/")}) {
        EXPECT_THAT(test::messageOf([&] { OutputPath(here, any, true); }),
                    HasSubstr("the program runs in this folder"));
    }
    EXPECT_EQ(test::messageOf([&] { OutputPath("../../other", any, true); }), "");
    fs::current_path(before);
    EXPECT_THAT(test::messageOf([&] { OutputPath("/proc", any, true); }),
                HasSubstr("/proc: is a mount point"));
}

TEST(OutputPath, AFileDoesNotEndInASlash) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(test::messageOf([&] { OutputPath(folder.path().string() + "/a/", kFile, true); }),
                HasSubstr("/a/: ends like the name of a folder"));
}

TEST(OutputPath, WhatIsInAnInputIsNotReplaced) {
    const test::TemporaryFolder folder;
    fs::create_directories(folder / "in/velodyne");
    folder.write("in/velodyne/000000.bin", "scan");
    const auto refusal = [&](const std::string& output) {
        return test::messageOf([&] { checkApart({folder / output}, {folder / "in"}); });
    };
    EXPECT_THAT(refusal("in/velodyne/000000.bin"), HasSubstr("may be a part of it"));
    EXPECT_THAT(refusal("in/velodyne"), HasSubstr("may be a part of it"));
    EXPECT_THAT(refusal("in"), HasSubstr("is or contains the input"));
    EXPECT_EQ(refusal("in/scores.json"), "");
    EXPECT_EQ(refusal("inside"), "");
}

TEST(RenamingNote, IsDoneWithoutWhereItsNameIsTooLong) {
    const test::TemporaryFolder folder;
    const fs::path longest = folder / std::string(250, 'x');
    EXPECT_NO_THROW(RenamingNote({longest, folder / "b"}));
}

/// The first process has a number that another one had before.
TEST(OutputPath, ATemporaryFileOfBeforeItsProcessBeganIsLeftBehind) {
    const test::TemporaryFolder folder;
    const fs::path file = folder / "a.rawlog", left = folder / "a.rawlog.tmp-1-0123456789abcdef";
    folder.write(left.filename().string(), "half");
    EXPECT_TRUE(partialOutputs(file).empty());  // it runs
    fs::last_write_time(left, fs::file_time_type::clock::now() - std::chrono::hours(24 * 365 * 20));
    EXPECT_THAT(partialOutputs(file), testing::ElementsAre(left));
    EXPECT_THAT(leftBehind({file, folder / "b"}), HasSubstr(left.string()));
    EXPECT_EQ(leftBehind({folder / "b"}), "");
}

/// What this run writes was left by nobody.
TEST(OutputPath, OwnTemporaryFilesAreNotLeftBehind) {
    const test::TemporaryFolder folder;
    const fs::path file = folder / "a.rawlog";
    const fs::path left = folder / ("a.rawlog.tmp-" + std::to_string(getpid()) + "-0123456789");
    folder.write(left.filename().string(), "of a process that had this number");
    {
        OutputPath output(file, kFile, false);
        std::ofstream(output.temporary()) << "half";
        EXPECT_THAT(partialOutputs(file), testing::ElementsAre(left));
    }
    EXPECT_THAT(partialOutputs(file), testing::ElementsAre(left));
}

TEST(OutputPath, MessagesNameOutputsInPlaceOfTemporaryFiles) {
    const test::TemporaryFolder folder;
    std::string temporary;
    {
        const OutputPath output(folder / "a", kFile, false), other(folder / "b", kFile, false);
        temporary = output.temporary().string();
        EXPECT_EQ(withOutputNames(temporary + "/1.bin, " + temporary + " and " +
                                  other.temporary().string() + ": no space"),
                  (folder / "a").string() + "/1.bin, " + (folder / "a").string() + " and " +
                      (folder / "b").string() + ": no space");
    }
    EXPECT_EQ(withOutputNames(temporary), temporary);
}

TEST(OutputPath, WhatAppearsMeanwhileIsNotReplaced) {
    const test::TemporaryFolder folder;
    OutputPath output(folder / "a.rawlog", kFile, false);
    std::ofstream(output.temporary()) << "new";
    folder.write("a.rawlog", "somebody's");
    EXPECT_THROW(output.commit(), std::runtime_error);
    EXPECT_EQ(test::readFile(folder / "a.rawlog"), "somebody's");
    EXPECT_EQ(test::readFile(folder / "a.partial.rawlog"), "new");
}

}  // namespace
}  // namespace hagen::base
