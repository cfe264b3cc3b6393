// What outputs of each kind may hold, and so what may be replaced.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/base/OutputPath.h>
#include <hagen/convert/StagePictures.h>
#include <hagen/evaluation/Charts.h>
#include <hagen/evaluation/Overlay.h>
#include <hagen/recordings/ScanFolder.h>
#include <fstream>
#include <stdexcept>

#include "support/Program.h"

namespace hagen::evaluation {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;
using base::kFile;
using base::OutputPath;
using convert::kStagePictures;
using recordings::kScanFolders;

TEST(OutputKinds, AFolderIsReplacedWhole) {
    const test::TemporaryFolder folder;
    folder.write("out/velodyne/000000.bin", "old");
    folder.write("out/labels/made_by.txt", "old");
    base::OutputPath output(folder / "out/", recordings::kScanFolders, true);
    fs::create_directory(output.temporary());
    std::ofstream(output.temporary() / "new.txt") << "new";
    output.commit();
    EXPECT_TRUE(fs::exists(folder / "out/new.txt"));
    EXPECT_FALSE(fs::exists(folder / "out/velodyne"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputKinds, OnlyItsOwnKindIsReplaced) {
    const test::TemporaryFolder folder;
    folder.write("file", "");
    folder.write("scans/velodyne/000000.bin", "");
    folder.write("scans/simulated_by.txt", "");
    folder.write("mine/velodyne/000000.bin", "");
    folder.write("mine/labels/000000.label", "");
    folder.write("mine/kinds.yaml", "");  // as the documents say
    folder.write("work/velodyne/000000.bin", "");
    folder.write("work/notes.txt", "");
    EXPECT_THROW(base::OutputPath(folder / "scans", base::kFile, true), std::runtime_error);
    EXPECT_THROW(base::OutputPath(folder / "file", recordings::kScanFolders, true),
                 std::runtime_error);
    EXPECT_THROW(base::OutputPath("/dev/null", base::kFile, true), std::runtime_error);
    EXPECT_NO_THROW(base::OutputPath(folder / "scans", recordings::kScanFolders, true));
    // Labelled by hand, it has the same names.
    EXPECT_THROW(base::OutputPath(folder / "mine", recordings::kScanFolders, true),
                 std::runtime_error);
    try {
        base::OutputPath output(folder / "work", recordings::kScanFolders, true);
        FAIL();
    } catch (const std::runtime_error& e) {
        EXPECT_THAT(e.what(), HasSubstr("'notes.txt'"));
    }
    EXPECT_TRUE(fs::exists(folder / "work/notes.txt"));
}

TEST(OutputKinds, FoldersOfAPartASensorAreOfTheirKindToo) {
    const test::TemporaryFolder folder;
    folder.write("scans/front/velodyne/000000.bin", "");
    folder.write("scans/rear/labels/000000.label", "");
    folder.write("scans/rear/labels/made_by.txt", "");
    // One of the two was labelled by hand.
    EXPECT_THROW(base::OutputPath(folder / "scans", recordings::kScanFolders, true),
                 std::runtime_error);
    folder.write("scans/front/labels/made_by.txt", "");
    folder.write("pictures/front/000000/1_depth.png", "");
    folder.write("pictures/rear/000000/1_depth.png", "");
    EXPECT_NO_THROW(base::OutputPath(folder / "scans", recordings::kScanFolders, true));
    EXPECT_NO_THROW(base::OutputPath(folder / "pictures", convert::kStagePictures, true));
    EXPECT_THROW(base::OutputPath(folder / "pictures", recordings::kScanFolders, true),
                 std::runtime_error);
    EXPECT_THROW(base::OutputPath(folder / "scans", convert::kStagePictures, true),
                 std::runtime_error);
    folder.write("scans/front/notes.txt", "");
    folder.write("pictures/rear/000000/more/1_depth.png", "");
    EXPECT_THROW(base::OutputPath(folder / "scans", recordings::kScanFolders, true),
                 std::runtime_error);
    EXPECT_THROW(base::OutputPath(folder / "pictures", convert::kStagePictures, true),
                 std::runtime_error);
}

TEST(OutputKinds, ChartsAndOverlaysAreKnownByTheirNames) {
    const test::TemporaryFolder folder;
    folder.write("charts/by_range.svg", "");
    folder.write("charts/sweep_beta_deg.svg", "");
    folder.write("overlays/hagen/00_000000_overlay.png", "");
    EXPECT_NO_THROW(base::OutputPath(folder / "charts", kCharts, true));
    EXPECT_NO_THROW(base::OutputPath(folder / "overlays", kOverlays, true));
    EXPECT_THROW(base::OutputPath(folder / "charts", kOverlays, true), std::runtime_error);
    EXPECT_THROW(base::OutputPath(folder / "overlays", kCharts, true), std::runtime_error);
    folder.write("charts/logo.svg", "mine");
    folder.write("overlays/hagen/wedding.png", "mine");
    EXPECT_THROW(base::OutputPath(folder / "charts", kCharts, true), std::runtime_error);
    EXPECT_THROW(base::OutputPath(folder / "overlays", kOverlays, true), std::runtime_error);
}

TEST(OutputKinds, ForeignFilesWithinPartsAreSomebodysWork) {
    const test::TemporaryFolder folder;
    folder.write("scans/velodyne/notes.txt", "mine");
    folder.write("labels/labels/hand_made.json", "mine");
    folder.write("pictures/wedding.png", "mine");
    EXPECT_THROW(base::OutputPath(folder / "scans", recordings::kScanFolders, true),
                 std::runtime_error);
    EXPECT_THROW(base::OutputPath(folder / "labels", recordings::kScanFolders, true),
                 std::runtime_error);
    EXPECT_THROW(base::OutputPath(folder / "pictures", convert::kStagePictures, true),
                 std::runtime_error);
}

TEST(OutputKinds, NeighboursWithLikeNamesAreLeftAlone) {
    const test::TemporaryFolder folder;
    for (const char* name : {"out.tmp/x", "out.old/x", "out.partial/x"}) folder.write(name, "mine");
    folder.write("out/velodyne/000000.bin", "old");
    folder.write("out/labels/made_by.txt", "old");
    base::OutputPath output(folder / "out", recordings::kScanFolders, true);
    fs::create_directory(output.temporary());
    output.commit();
    for (const char* name : {"out.tmp/x", "out.old/x", "out.partial/x"}) {
        EXPECT_EQ(test::readFile(folder / name), "mine");
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 4);
}

}  // namespace
}  // namespace hagen::evaluation
