#include <gmock/gmock.h>
#include <hagen/base/OutputPath.h>
#include <unistd.h>
#include "base/WriteFile.h"

#include "support/Program.h"

namespace hagen::base {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace fs = std::filesystem;

const OutputKind kAnyFolder{"a folder", [](const fs::path&) { return true; }};

class OutputPathTest : public testing::Test {
 protected:
    std::string errorOf(const fs::path& path, const OutputKind& kind = kFile,
                        bool overwrite = true) const {
        return test::messageOf([&] { OutputPath(path, kind, overwrite); });
    }

    test::TemporaryFolder folder_;
    const fs::path file_ = folder_ / "a.rawlog";
};

TEST_F(OutputPathTest, AppearsWhenComplete) {
    OutputPath output(file_, kFile, false);
    std::ofstream(output.temporary()) << "new";
    EXPECT_FALSE(fs::exists(file_));
    output.commit();
    EXPECT_EQ(test::readFile(file_), "new");
}

TEST_F(OutputPathTest, ReplacesOnlyIfAllowed) {
    folder_.write("a.rawlog", "old");
    EXPECT_THAT(errorOf(file_, kFile, false), HasSubstr("a.rawlog exists; use --overwrite"));
    OutputPath output(file_, kFile, true);
    std::ofstream(output.temporary()) << "new";
    EXPECT_EQ(test::readFile(file_), "old");
    output.commit();
    EXPECT_EQ(test::readFile(file_), "new");
}

TEST_F(OutputPathTest, RemovesTemporaryFileUnlessCommitted) {
    folder_.write("a.rawlog", "old");
    {
        OutputPath output(file_, kFile, true);
        std::ofstream(output.temporary()) << "half";
    }
    EXPECT_EQ(test::readFile(file_), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(OutputPathTest, NumbersPartialNames) {
    for (const char* name : {"a.partial.rawlog", "a.partial-2.rawlog"}) {
        OutputPath output(file_, kFile, true);
        std::ofstream(output.temporary()) << name;
        EXPECT_EQ(output.keepPartial(), folder_ / name);
    }
    EXPECT_EQ(test::readFile(folder_ / "a.partial.rawlog"), "a.partial.rawlog");
}

TEST_F(OutputPathTest, CreatesParentFolders) {
    const fs::path file = folder_ / "new/more/a";
    { const OutputPath given_up(file, kFile, false); }
    EXPECT_FALSE(fs::exists(folder_ / "new"));
    {
        OutputPath output(file, kFile, false);
        std::ofstream(output.temporary()) << "new";
        output.commit();
    }
    EXPECT_EQ(test::readFile(file), "new");
}

TEST_F(OutputPathTest, FindsPartialOutputsFromEarlierRuns) {
    const fs::path directory = folder_ / "out.v2";
    for (const fs::path& none : {file_, fs::path(), folder_ / "none/a.rawlog"}) {
        EXPECT_THAT(partialOutputs(none), IsEmpty());
    }
    for (const char* other : {"a.partial.mcap", "ab.partial.rawlog", "a.partial", "out.partial",
                              "a.partial.rawlog", "a.partial-2.rawlog", "out.v2.partial"}) {
        folder_.write(other, "");
    }
    EXPECT_THAT(partialOutputs(file_),
                ElementsAre(folder_ / "a.partial-2.rawlog", folder_ / "a.partial.rawlog"));
    fs::create_directory(directory);
    EXPECT_THAT(partialOutputs(directory), ElementsAre(folder_ / "out.v2.partial"));
    EXPECT_EQ(partialOutputs(directory.string() + "/"), partialOutputs(directory));
}

TEST_F(OutputPathTest, RefusesToReplaceOtherTypes) {
    folder_.write("file", "old");
    fs::create_directory(folder_ / "folder");
    fs::create_symlink("file", folder_ / "link");
    fs::create_symlink("nowhere", folder_ / "dangling");
    EXPECT_THAT(errorOf(folder_ / "link"), HasSubstr("link: is a symbolic link, so it is not"));
    EXPECT_THAT(errorOf(folder_ / "dangling"), HasSubstr("is a symbolic link"));
    EXPECT_THAT(errorOf(folder_ / "folder"), HasSubstr("not a file"));
    EXPECT_THAT(errorOf(folder_ / "file", kAnyFolder), HasSubstr("not a folder"));
    EXPECT_THAT(errorOf("/proc", kAnyFolder), HasSubstr("/proc: is a mount point"));
    EXPECT_THAT(errorOf(folder_ / "new/"), HasSubstr("/new/: ends with '/'"));
    EXPECT_THAT(errorOf(folder_ / "file/a"), HasSubstr("file: cannot be created"));
}

TEST_F(OutputPathTest, KeepsFileThatAppearsMeanwhile) {
    OutputPath output(file_, kFile, false);
    std::ofstream(output.temporary()) << "new";
    folder_.write("a.rawlog", "theirs");
    EXPECT_THAT(test::messageOf([&] { output.commit(); }), HasSubstr("a.partial.rawlog"));
    EXPECT_EQ(test::readFile(file_), "theirs");
    EXPECT_EQ(test::readFile(folder_ / "a.partial.rawlog"), "new");
}

TEST_F(OutputPathTest, KeepsFolderThatAppearsMeanwhile) {
    OutputPath output(folder_ / "scans", kAnyFolder, false);
    fs::create_directory(output.temporary());
    fs::create_directory(folder_ / "scans");
    folder_.write("scans/precious", "theirs");
    EXPECT_THAT(test::messageOf([&] { output.commit(); }), HasSubstr("scans.partial"));
    EXPECT_EQ(test::readFile(folder_ / "scans/precious"), "theirs");
    EXPECT_EQ(output.keepPartial(), folder_ / "scans.partial");  // kept already
}

TEST_F(OutputPathTest, MessagesNameOutputsNotTemporaryFiles) {
    const OutputPath a(folder_ / "a", kFile, false), b(folder_ / "b", kFile, false);
    EXPECT_EQ(
        withOutputNames(a.temporary().string() + "/1.bin, " + b.temporary().string() + ": no"),
        (folder_ / "a/1.bin").string() + ", " + (folder_ / "b").string() + ": no");
}

TEST_F(OutputPathTest, RefusesOutputsInInputs) {
    fs::create_directories(folder_ / "in/velodyne");
    folder_.write("in/velodyne/000000.bin", "scan");
    const auto refusal = [&](const std::string& output) {
        return test::messageOf([&] { checkApart({folder_ / output}, {folder_ / "in"}); });
    };
    EXPECT_THAT(refusal("in/velodyne/000000.bin"), HasSubstr("may be part of it"));
    EXPECT_THAT(refusal("in/velodyne"), HasSubstr("may be part of it"));
    EXPECT_THAT(refusal("in"), HasSubstr("is or contains the input"));
    EXPECT_EQ(refusal("in/scores.json"), "");
    EXPECT_EQ(refusal("inside"), "");
}

TEST_F(OutputPathTest, WriteErrorsIncludeReason) {
    const auto errorAt = [&](const fs::path& place) {
        return test::messageOf([&] { writeText("text", place, "named.csv"); });
    };
    EXPECT_EQ(errorAt(folder_.path()), "named.csv: cannot be written: Is a directory");
    EXPECT_EQ(errorAt("/dev/full"), "named.csv: cannot be written: No space left on device");
    std::ofstream out("/dev/full");  // the disk is full before the stream is closed
    out << std::string(100000, 'x') << std::flush;
    errno = EACCES;  // overwritten by a later call
    EXPECT_EQ(test::messageOf([&] { closeWritten(out, "named.csv"); }),
              "named.csv: cannot be written: No space left on device");
    EXPECT_EQ(errorAt(folder_ / "a.csv"), "");
    EXPECT_EQ(test::readFile(folder_ / "a.csv"), "text");
}

}  // namespace
}  // namespace hagen::base
