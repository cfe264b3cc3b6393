#include <gtest/gtest.h>
#include <hagen/observations/OutputPath.h>

#include <fstream>
#include <stdexcept>

#include "support/Program.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;

TEST(OutputPath, AFileAppearsWhenItIsWhole) {
    const test::TemporaryFolder folder;
    OutputPath output(folder / "a.rawlog", false);
    std::ofstream(output.temporary()) << "new";
    EXPECT_FALSE(fs::exists(folder / "a.rawlog"));
    output.commit();
    EXPECT_EQ(test::readFile(folder / "a.rawlog"), "new");
}

TEST(OutputPath, WhatExistsIsReplacedOnlyWhereWanted) {
    const test::TemporaryFolder folder;
    folder.write("a.rawlog", "old");
    EXPECT_THROW(OutputPath(folder / "a.rawlog", false), std::runtime_error);
    OutputPath output(folder / "a.rawlog", true);
    std::ofstream(output.temporary()) << "new";
    EXPECT_EQ(test::readFile(folder / "a.rawlog"), "old");
    output.commit();
    EXPECT_EQ(test::readFile(folder / "a.rawlog"), "new");
}

TEST(OutputPath, AFolderIsReplacedWhole) {
    const test::TemporaryFolder folder;
    folder.write("out/old.txt", "old");
    OutputPath output(folder / "out/", true);
    fs::create_directory(output.temporary());
    std::ofstream(output.temporary() / "new.txt") << "new";
    output.commit();
    EXPECT_TRUE(fs::exists(folder / "out/new.txt"));
    EXPECT_FALSE(fs::exists(folder / "out/old.txt"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputPath, GivenUpLeavesWhatWasThere) {
    const test::TemporaryFolder folder;
    folder.write("a.rawlog", "old");
    {
        OutputPath output(folder / "a.rawlog", true);
        std::ofstream(output.temporary()) << "half";
    }
    EXPECT_EQ(test::readFile(folder / "a.rawlog"), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputPath, APartSaysSoInItsName) {
    const test::TemporaryFolder folder;
    OutputPath output(folder / "a.rawlog", false);
    std::ofstream(output.temporary()) << "half";
    EXPECT_EQ(output.keepPartial(), folder / "a.partial.rawlog");
    EXPECT_EQ(test::readFile(folder / "a.partial.rawlog"), "half");
}

TEST(OutputPath, AFolderThatIsNotThereIsNamed) {
    const test::TemporaryFolder folder;
    try {
        OutputPath output(folder / "none/a.rawlog", false);
        FAIL();
    } catch (const std::runtime_error& e) {
        EXPECT_NE(std::string(e.what()).find((folder / "none").string()), std::string::npos);
    }
}

TEST(OutputPath, ClearsAwayWhatAnInterruptedRunLeft) {
    const test::TemporaryFolder folder;
    folder.write("out.tmp/velodyne/000000.bin", "stale");
    OutputPath output(folder / "out", false);
    EXPECT_FALSE(fs::exists(output.temporary()));
}

}  // namespace
}  // namespace hagen
