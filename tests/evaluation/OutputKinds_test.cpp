// Rules for replacing existing outputs of each kind.
#include <gmock/gmock.h>
#include <hagen/base/OutputPath.h>
#include <hagen/recordings/ScanFolder.h>
#include <fstream>
#include "convert/pictures/StagePictures.h"
#include "evaluation/labelled_folders/Charts.h"

#include "support/Program.h"

namespace hagen::evaluation {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;
using base::kFile;
using base::OutputPath;
using convert::kStagePictures;
using recordings::kScanFolders;

bool mayReplace(const fs::path& path, const base::OutputKind& kind) {
    return test::messageOf([&] { OutputPath(path, kind, true); }).empty();
}

TEST(OutputKinds, ReplaceWholeFolders) {
    const test::TemporaryFolder folder;
    folder.write("out/velodyne/000000.bin", "old");
    folder.write("out/labels/made_by.txt", "old");
    OutputPath output(folder / "out/", kScanFolders, true);
    fs::create_directory(output.temporary());
    std::ofstream(output.temporary() / "new.txt") << "new";
    output.commit();
    EXPECT_TRUE(fs::exists(folder / "out/new.txt"));
    EXPECT_FALSE(fs::exists(folder / "out/velodyne"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputKinds, ReplaceOwnKindOnly) {
    const test::TemporaryFolder folder;
    folder.write("file", "");
    folder.write("scans/velodyne/000000.bin", "");
    folder.write("scans/simulated_by.txt", "");
    folder.write("mine/velodyne/000000.bin", "");
    folder.write("mine/labels/000000.label", "");
    folder.write("mine/kinds.yaml", "");  // as documented
    folder.write("work/velodyne/000000.bin", "");
    folder.write("work/notes.txt", "");
    EXPECT_FALSE(mayReplace(folder / "scans", kFile));
    EXPECT_FALSE(mayReplace(folder / "file", kScanFolders));
    EXPECT_FALSE(mayReplace("/dev/null", kFile));
    EXPECT_TRUE(mayReplace(folder / "scans", kScanFolders));
    // A folder labelled by hand contains the same file names.
    EXPECT_FALSE(mayReplace(folder / "mine", kScanFolders));
    EXPECT_THAT(test::messageOf([&] { OutputPath(folder / "work", kScanFolders, true); }),
                HasSubstr("'notes.txt'"));
    EXPECT_TRUE(fs::exists(folder / "work/notes.txt"));
}

TEST(OutputKinds, AcceptFoldersPerSensor) {
    const test::TemporaryFolder folder;
    folder.write("scans/front/velodyne/000000.bin", "");
    folder.write("scans/rear/labels/000000.label", "");
    folder.write("scans/rear/labels/made_by.txt", "");
    // One of the two subfolders was labelled by hand.
    EXPECT_FALSE(mayReplace(folder / "scans", kScanFolders));
    folder.write("scans/front/labels/made_by.txt", "");
    folder.write("pictures/front/000000/1_depth.png", "");
    folder.write("pictures/rear/000000/1_depth.png", "");
    EXPECT_TRUE(mayReplace(folder / "scans", kScanFolders));
    EXPECT_TRUE(mayReplace(folder / "pictures", kStagePictures));
    EXPECT_FALSE(mayReplace(folder / "pictures", kScanFolders));
    EXPECT_FALSE(mayReplace(folder / "scans", kStagePictures));
    folder.write("scans/front/notes.txt", "");
    folder.write("pictures/rear/000000/more/1_depth.png", "");
    EXPECT_FALSE(mayReplace(folder / "scans", kScanFolders));
    EXPECT_FALSE(mayReplace(folder / "pictures", kStagePictures));
}

TEST(OutputKinds, IdentifyPicturesByName) {
    const test::TemporaryFolder folder;
    folder.write("charts/by_range.svg", "");
    folder.write("charts/sweep_beta_deg.svg", "");
    EXPECT_TRUE(mayReplace(folder / "charts", kCharts));
    folder.write("charts/logo.svg", "mine");
    EXPECT_FALSE(mayReplace(folder / "charts", kCharts));
}

TEST(OutputKinds, KeepSimilarlyNamedNeighbours) {
    const test::TemporaryFolder folder;
    for (const char* name : {"out.tmp/x", "out.old/x", "out.partial/x"}) folder.write(name, "mine");
    folder.write("out/velodyne/000000.bin", "old");
    folder.write("out/labels/made_by.txt", "old");
    OutputPath output(folder / "out", kScanFolders, true);
    fs::create_directory(output.temporary());
    output.commit();
    for (const char* name : {"out.tmp/x", "out.old/x", "out.partial/x"}) {
        EXPECT_EQ(test::readFile(folder / name), "mine");
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 4);
}

}  // namespace
}  // namespace hagen::evaluation
