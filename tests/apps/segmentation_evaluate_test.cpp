// Runs the built program, as a user would.
#include <gtest/gtest.h>
#include <hagen/logs/ScanFolder.h>
#include <hagen/logs/ScanFolderWriter.h>

#include <cmath>
#include <sstream>

#include "support/Program.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;
const std::string kPaper = HAGEN_SOURCE_DIR "/config/paper.yaml";

/// The first row of this name in a report: RoI precision, recall, F1, ROU precision, recall, F1.
std::vector<double> row(const std::string& report, const std::string& name) {
    std::istringstream lines(report);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word != name) continue;
        std::vector<double> figures;
        while (figures.size() < 6 && words >> word) {
            figures.push_back(word == "-" ? NAN : std::stod(word));
        }
        return figures;
    }
    return {};
}

class SegmentationEvaluate : public testing::Test {
 protected:
    static test::Outcome run(const std::vector<std::string>& arguments) {
        return test::run(HAGEN_SEGMENTATION_EVALUATE, arguments);
    }
    /// A folder with a scan of a pole on flat ground and its true labels.
    std::string labelledPole() const {
        test::SimpleScene scene;
        scene.poles.push_back({12, 2, 0.15, 8});
        const SensorModel sensor = sensorModel("VLP-16");
        const auto labelled = test::scanScene(scene, sensor, 870, {0, 0, 2});
        LabelledReturns truth;
        truth.label = labelled.truth;
        truth.component.assign(truth.label.size(), 0);
        std::filesystem::create_directories(folder_ / "pole");
        ScanFolderWriter writer(folder_ / "pole");
        writer.write("000000", labelled.scan, truth, sensor, 0.0);
        writer.finish();
        return (folder_ / "pole").string();
    }
    void expectFailure(const std::vector<std::string>& arguments, int exit_code,
                       const std::string& words) {
        const auto outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    }
    test::TemporaryFolder folder_;
};

TEST_F(SegmentationEvaluate, APoleOnFlatGroundIsFoundWhole) {
    const auto outcome = run({"-i", labelledPole()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(row(outcome.out, "hagen"), (std::vector<double>{1, 1, 1, 1, 1, 1})) << outcome.out;
}

TEST_F(SegmentationEvaluate, ASweepHasARowForEachValue) {
    const auto outcome =
        run({"-i", labelledPole(), "--sweep", "zone_m=5,20", "--sweep", "beta_deg=10"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(row(outcome.out, "zone_m=5").at(1), 0.0) << outcome.out;  // the pole is farther
    EXPECT_EQ(row(outcome.out, "zone_m=20").at(1), 1.0);
    EXPECT_EQ(row(outcome.out, "beta_deg=10").at(1), 1.0);
}

// The published filter on labelled recordings; the figures asked of it.
TEST_F(SegmentationEvaluate, PaperReachesItsScoresOnLabelledSixteenBeamScans) {
    const fs::path data = test::dataFolder("HAGEN_LABELLED_DATA");
    if (data.empty()) GTEST_SKIP() << "HAGEN_LABELLED_DATA names no folder of labelled scans";
    std::vector<std::string> arguments{"-c", kPaper, "-i"};
    for (const auto& folder : fs::directory_iterator(data / "beams16")) {
        arguments.push_back(folder.path().string());
    }
    const auto outcome = run(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_GE(row(outcome.out, "hagen").at(2), 0.86) << outcome.out;
    EXPECT_GE(row(outcome.out, "hagen").at(5), 0.92) << outcome.out;
}

TEST_F(SegmentationEvaluate, RefusesWrongUsage) {
    expectFailure({}, 2, "--input");
    expectFailure({"-i", "x", "--sweep", "beta_deg"}, 2, "KEY=VALUE");
    expectFailure({"-i", labelledPole(), "--sweep", "beta=5"}, 2, "'beta_deg'");
    expectFailure({"-i", labelledPole(), "--max-range-m", "-3"}, 2, "--max-range-m");
    expectFailure({"-i", labelledPole(), "-c", "none.yaml"}, 2, "none.yaml");
    expectFailure({"-i", labelledPole(), "--sweep", "window_size=16"}, 2, "window_size (16)");
    expectFailure({"-i", labelledPole(), "--sweep", "window_scans=1,3"}, 2, "window_scans");
}

TEST_F(SegmentationEvaluate, FailsWithoutScansOrLabels) {
    expectFailure({"-i", folder_.path()}, 1, "velodyne");
    const std::string pole = labelledPole();
    fs::remove_all(folder_ / "pole/labels");
    expectFailure({"-i", pole}, 1, "000000.label");
}

TEST_F(SegmentationEvaluate, FailsOnLabelsOfAnotherScanOrMeaning) {
    const std::string pole = labelledPole();
    folder_.write("pole/labels/000000.label", std::string("\1\0\0\0", 4));
    expectFailure({"-i", pole}, 1, "000000.label");
    const auto returns = fs::file_size(folder_ / "pole/velodyne/000000.bin") / 16;
    folder_.write("pole/labels/000000.label", std::string(4 * returns, '\7'));
    expectFailure({"-i", pole}, 1, "is none of 0");
}

}  // namespace
}  // namespace hagen
