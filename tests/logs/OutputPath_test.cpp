#include <gtest/gtest.h>
#include <hagen/logs/CloseWritten.h>
#include <hagen/logs/OutputPath.h>

#include <fstream>
#include <stdexcept>

#include "support/Program.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;
constexpr auto kFile = OutputPath::Kind::File, kScanFolder = OutputPath::Kind::ScanFolders,
               kPictures = OutputPath::Kind::Pictures;

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

TEST(OutputPath, AFolderIsReplacedWhole) {
    const test::TemporaryFolder folder;
    folder.write("out/velodyne/000000.bin", "old");
    OutputPath output(folder / "out/", kScanFolder, true);
    fs::create_directory(output.temporary());
    std::ofstream(output.temporary() / "new.txt") << "new";
    output.commit();
    EXPECT_TRUE(fs::exists(folder / "out/new.txt"));
    EXPECT_FALSE(fs::exists(folder / "out/velodyne"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
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
        EXPECT_NE(std::string(e.what()).find((folder / "none").string()), std::string::npos);
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

TEST(OutputPath, OnlyItsOwnKindIsReplaced) {
    const test::TemporaryFolder folder;
    folder.write("file", "");
    folder.write("scans/velodyne/000000.bin", "");
    folder.write("work/velodyne/000000.bin", "");
    folder.write("work/notes.txt", "");
    EXPECT_THROW(OutputPath(folder / "scans", kFile, true), std::runtime_error);
    EXPECT_THROW(OutputPath(folder / "file", kScanFolder, true), std::runtime_error);
    EXPECT_THROW(OutputPath("/dev/null", kFile, true), std::runtime_error);
    EXPECT_NO_THROW(OutputPath(folder / "scans", kScanFolder, true));
    try {
        OutputPath output(folder / "work", kScanFolder, true);
        FAIL();
    } catch (const std::runtime_error& e) {
        EXPECT_NE(std::string(e.what()).find("'notes.txt'"), std::string::npos) << e.what();
    }
    EXPECT_TRUE(fs::exists(folder / "work/notes.txt"));
}

TEST(OutputPath, FoldersOfAPartASensorAreOfTheirKindToo) {
    const test::TemporaryFolder folder;
    folder.write("scans/front/velodyne/000000.bin", "");
    folder.write("scans/rear/labels/000000.label", "");
    folder.write("pictures/front/000000/1_depth.png", "");
    folder.write("pictures/rear/000000/1_depth.png", "");
    EXPECT_NO_THROW(OutputPath(folder / "scans", kScanFolder, true));
    EXPECT_NO_THROW(OutputPath(folder / "pictures", kPictures, true));
    EXPECT_THROW(OutputPath(folder / "pictures", kScanFolder, true), std::runtime_error);
    EXPECT_THROW(OutputPath(folder / "scans", kPictures, true), std::runtime_error);
    folder.write("scans/front/notes.txt", "");
    folder.write("pictures/rear/000000/more/1_depth.png", "");
    EXPECT_THROW(OutputPath(folder / "scans", kScanFolder, true), std::runtime_error);
    EXPECT_THROW(OutputPath(folder / "pictures", kPictures, true), std::runtime_error);
}

TEST(OutputPath, ChartsAndOverlaysAreKnownByTheirNames) {
    using Kind = OutputPath::Kind;
    const test::TemporaryFolder folder;
    folder.write("charts/by_range.svg", "");
    folder.write("charts/sweep_beta_deg.svg", "");
    folder.write("overlays/hagen/00_000000_overlay.png", "");
    EXPECT_NO_THROW(OutputPath(folder / "charts", Kind::Charts, true));
    EXPECT_NO_THROW(OutputPath(folder / "overlays", Kind::Overlays, true));
    EXPECT_THROW(OutputPath(folder / "charts", Kind::Overlays, true), std::runtime_error);
    EXPECT_THROW(OutputPath(folder / "overlays", Kind::Charts, true), std::runtime_error);
    folder.write("charts/logo.svg", "mine");
    folder.write("overlays/hagen/wedding.png", "mine");
    EXPECT_THROW(OutputPath(folder / "charts", Kind::Charts, true), std::runtime_error);
    EXPECT_THROW(OutputPath(folder / "overlays", Kind::Overlays, true), std::runtime_error);
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

TEST(OutputPath, ForeignFilesWithinPartsAreSomebodysWork) {
    const test::TemporaryFolder folder;
    folder.write("scans/velodyne/notes.txt", "mine");
    folder.write("labels/labels/hand_made.json", "mine");
    folder.write("pictures/wedding.png", "mine");
    EXPECT_THROW(OutputPath(folder / "scans", kScanFolder, true), std::runtime_error);
    EXPECT_THROW(OutputPath(folder / "labels", kScanFolder, true), std::runtime_error);
    EXPECT_THROW(OutputPath(folder / "pictures", kPictures, true), std::runtime_error);
}

TEST(OutputPath, NeighboursWithLikeNamesAreLeftAlone) {
    const test::TemporaryFolder folder;
    for (const char* name : {"out.tmp/x", "out.old/x", "out.partial/x"}) folder.write(name, "mine");
    folder.write("out/velodyne/000000.bin", "old");
    OutputPath output(folder / "out", kScanFolder, true);
    fs::create_directory(output.temporary());
    output.commit();
    for (const char* name : {"out.tmp/x", "out.old/x", "out.partial/x"}) {
        EXPECT_EQ(test::readFile(folder / name), "mine");
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 4);
}

}  // namespace
}  // namespace hagen
