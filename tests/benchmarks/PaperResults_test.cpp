// The tool behind scripts/reproduce-paper.
#include <gmock/gmock.h>
#include <hagen/recordings/ScanFolder.h>
#include "convert/ScanFolderWriter.h"

#include "paper-results/DataSets.h"
#include "paper-results/HardSection.h"
#include "paper-results/LeftOutSection.h"
#include "paper-results/OperatingSection.h"
#include "paper-results/Rows.h"
#include "paper-results/Sums.h"
#include "support/ProgramTest.h"
#include "support/RawBytes.h"
#include "support/SimpleScene.h"
#include "support/Tables.h"

namespace hagen {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;
const std::string kConfig = HAGEN_SOURCE_DIR "/config";

TEST(Tables, MarkBestValuesBold) {
    EXPECT_EQ(pairCell(0.95801, 0.5, 0.95849, 0.6), "**0.958** / 0.500");
    EXPECT_EQ(pairCell(NAN, 0.5), "- / 0.500");
    EXPECT_EQ(boldAbove(0.9581, 0.9579), "0.958");  // equal when rounded
    EXPECT_EQ(boldAbove(0.959, 0.958), "**0.959**");
    EXPECT_EQ(boldAbove(0.957, 0.958), "0.957");
    EXPECT_EQ(cell(evaluation::Interval{0.9511, 0.9639}), "0.951 to 0.964");
    EXPECT_EQ(cell(evaluation::Interval{}), "-");
}

TEST(Rows, HaveUniqueNamesAndSettings) {
    DataSet set;
    set.preset = "vlp16.yaml";
    set.zone_m = 40;
    const evaluation::MethodSet rows = rowsFor(set, kConfig);
    std::set<std::string> names;
    const auto options = [&](const std::string& name) {
        for (const evaluation::SweepPoint& row : rows.filter) {
            if (row.name == name) return row.settings.options;
        }
        ADD_FAILURE() << "no row " << name;
        return Options{};
    };
    for (const evaluation::SweepPoint& row : rows.filter) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_EQ(row.settings.options.zone_m, 40) << row.name;
    }
    EXPECT_EQ(rows.baselines->options.zone_m, 40);
    for (const Change& change : betaSweep()) {
        EXPECT_EQ(options(nameOf(kPaper, change)).beta_deg, std::stof(change.value));
    }
    EXPECT_EQ(options("default, context_m=zone").context_m, 40);
    EXPECT_EQ(options("without surface, principal_components=W").principal_components,
              options(kDefault).window_size);
    EXPECT_FALSE(options("without surface, context_m=zone").ground_surface);
    const Options none =
        options("default, seeds=every, persistence_m=1000, principal_components=W");
    EXPECT_EQ(none.seeds, Seeds::Every);
    EXPECT_EQ(none.persistence_m, 1000);
    EXPECT_EQ(none.principal_components, none.window_size);
    EXPECT_EQ(none.ground_surface, options(kDefault).ground_surface);
    EXPECT_EQ(options("default, ground_surface=false").ground_surface,
              options(kWithoutSurface + ", seed_gate_deg=90").ground_surface);
}

TEST(Rows, PaperRowUsesPaperStagesOnly) {
    test::TemporaryFolder config;
    for (const char* file : {"vlp16.yaml", "common.yaml", "paper.yaml"}) {
        fs::copy_file(fs::path(kConfig) / file, config / file);
    }
    DataSet set;
    set.preset = "vlp16.yaml";
    EXPECT_NO_THROW(rowsFor(set, config.path()));
    for (const char* stage : {"ground_surface: true", "level_by_attitude: true",
                              "seed_gate_deg: 30", "repair_max_step_m: 1", "context_m: 48"}) {
        const std::string ours = config.write("ours.yaml", stage + std::string("\n"));
        config.write("paper.yaml", "include: [" + kConfig + "/paper.yaml, " + ours + "]\n");
        const std::string message = test::messageOf([&] { rowsFor(set, config.path()); });
        EXPECT_THAT(message, HasSubstr("has a stage beyond the paper")) << stage;
    }
}

// Seeds used for tuning are never scored.
TEST(DataSets, UseGivenSeeds) {
    for (const DataSet& set : dataSets("", "data", {{101, 102}, 3})) {
        ASSERT_FALSE(set.flights.empty()) << set.name;
        for (const convert::SimulatedLog& flight : set.flights) {
            EXPECT_TRUE(flight.seed == 101 || flight.seed == 102);
            EXPECT_EQ(flight.scans, 3);
            EXPECT_EQ(flight.tilt_sd_deg, 4);
        }
    }
}

evaluation::ScanScores scanOf(std::size_t folder, std::int64_t right, std::int64_t wrong) {
    evaluation::ScanScores scan;
    scan.folder = folder;
    scan.all.roi = {right, wrong, 0};
    scan.all.rou = {right, 0, wrong};
    return scan;
}

/// Results of two drives (two scans and one scan) and two degradations.
Measured twoDrives() {
    Measured measured;
    measured.set.name = "real, 16 beams";
    measured.folders = {"00", "02"};
    measured.returns = {100, 100, 100};
    evaluation::MethodScores method;
    method.name = kDefault;
    method.returns = {scanOf(0, 90, 10), scanOf(0, 95, 5), scanOf(1, 99, 1)};
    measured.methods = {method};
    for (const auto& [name, right] : {std::pair{"rain=1", 90}, {"dead_beams=3", 60}}) {
        evaluation::MethodScores degraded;
        degraded.name = kDefault;
        degraded.returns = {scanOf(0, right, 100 - right)};
        measured.hard_sets.push_back({name, {degraded}});
    }
    return measured;
}

TEST(FolderSums, GroupByDrive) {
    const std::vector<evaluation::Scores> sums = folderSums(twoDrives(), kDefault);
    ASSERT_EQ(sums.size(), 2u);
    EXPECT_EQ(sums[0].roi.hits, 185);
    EXPECT_EQ(sums[1].roi.hits, 99);
}

TEST(HardSection, SortsByCost) {
    const std::string text = hardSection({twoDrives()});
    EXPECT_LT(text.find("| as recorded"), text.find("**`dead_beams=3`**"));
    EXPECT_LT(text.rfind("dead_beams=3"), text.rfind("rain=1"));
    // F1 of the clean scans is 2 * 284 / (2 * 284 + 16).
    EXPECT_THAT(text, HasSubstr("- `dead_beams=3`: real, 16 beams (-22.26)"));
    EXPECT_THAT(text, HasSubstr("-2.52"));
}

TEST(RecallAt, InterpolatesBetweenPoints) {
    const std::vector<OperatingPoint> curve{{"0.1", 0.8, 0.96, {}},
                                            {"0.2", 0.9, 0.92, {}},
                                            {"0.3", 0.95, 0.8, {}},
                                            {"0.4", 0.94, 0.7, {}}};
    EXPECT_DOUBLE_EQ(recallAt(0.9, curve), 0.92);
    EXPECT_DOUBLE_EQ(recallAt(0.85, curve), 0.94);
    EXPECT_DOUBLE_EQ(recallAt(0.925, curve), 0.86);
    EXPECT_DOUBLE_EQ(recallAt(0.5, curve), 0.96);  // the nearest point is more precise
    EXPECT_TRUE(std::isnan(recallAt(0.96, curve)));
}

TEST(OperatingSection, ComparesAtEqualPrecision) {
    Measured measured = twoDrives();
    measured.methods.clear();
    const auto add = [&](const std::string& name, std::int64_t hits, std::int64_t false_alarms) {
        evaluation::MethodScores method;
        method.name = name;
        method.returns.resize(1);
        method.returns[0].all.roi = {hits, 100 - hits, false_alarms};
        method.drone.resize(1);
        measured.methods.push_back(method);
    };
    add(kDefault, 80, 20);
    add("default, ground_tolerance_m=0.1", 90, 90);
    add("default, ground_tolerance_m=0.17", 80, 20);
    add("zermas", 75, 25);
    add("zermas, Th_dist_m=0.2", 75, 25);
    add("pcl-euclidean", 60, 5);
    const std::string text = operatingSection({measured});
    // Precision 0.75 is between 0.5 and 0.8; 0.92 is above the curve.
    EXPECT_THAT(text, ContainsRegex("zermas +\\| 0.750/\\*\\*0.817\\*\\* "));
    EXPECT_THAT(text, HasSubstr("except that of `pcl-euclidean` (1 of 1 data sets)."));
    EXPECT_THAT(operatingTables({measured}).at("operating_curve.csv"),
                HasSubstr("zermas,Th_dist_m=0.2,0.750,0.750,-"));
}

selection::Record recordOf(const Measured& measured) {
    selection::Record record;
    record.revision = "v1-selected";
    const std::vector<evaluation::Scores> sums = folderSums(measured, kDefault);
    for (std::size_t f = 0; f < sums.size(); ++f) {
        record.scores.push_back(
            {measured.set.name, measured.folders[f], {sums[f], {}}, {{}}, {{sums[f], {}}}});
    }
    record.searches = {{"the presets", {}}};
    return record;
}

TEST(LeftOutSection, ReportsMissingOrOutdatedRecord) {
    EXPECT_THAT(leftOutSection({twoDrives()}, std::nullopt),
                HasSubstr("`scripts/select-settings` was not run"));
    selection::Record record = recordOf(twoDrives());
    const std::string current = leftOutSection({twoDrives()}, record);
    EXPECT_THAT(current, HasSubstr("| drive 02, held out"));
    EXPECT_THAT(current, Not(HasSubstr("have changed since")));
    ++record.scores[1].present.scores.roi.misses;
    EXPECT_THAT(leftOutSection({twoDrives()}, record), HasSubstr("v1-selected. Run"));
}

class PaperResults : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_PAPER_RESULTS,
                         with(arguments, {"--data", path("data"), "--quick", "--config", kConfig}));
    }
    /// Recordings of a pole on flat ground, with SemanticKITTI's classes for road and pole.
    std::string labelledPoles() const {
        const test::SimpleScene scene = test::sceneOf({}, {{12, 2, 0.15, 8}});
        const SensorModel sensor = sensorModel("VLP-16");
        const auto labelled = test::scanScene(scene, sensor, 870, {0, 0, 2});
        LabelledReturns truth;
        truth.label = labelled.truth;
        truth.component.assign(truth.label.size(), 0);
        std::vector<std::uint32_t> classes;
        for (const Label label : truth.label) classes.push_back(label == Label::Roi ? 80 : 40);
        for (const char* name : {"labelled/beams16/00", "labelled/beams64/00"}) {
            fs::create_directories(folder_ / name / "semantic");
            convert::ScanFolderWriter writer(folder_ / name);
            writer.write("000000", labelled.scan, truth, sensor, 0.0);
            writer.finish();
            folder_.write(std::string(name) + "/semantic/000000.label", test::raw(classes));
        }
        return (folder_ / "labelled").string();
    }
};

using PaperResultsRun = PaperResults;

TEST_F(PaperResultsRun, WritesAllTablesAndFigures) {
    const auto outcome = run({"-o", folder_.path(), "--labelled", labelledPoles(), "--revision",
                              "v1-test", "--overwrite"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string document = test::readFile(folder_ / "results.md");
    EXPECT_EQ(document, outcome.out);
    for (const std::string words : {"## Held-out drives",
                                    "was not run",
                                    "## Comparison with other methods",
                                    "drives or flights",
                                    "## Operating curve",
                                    "## Missed obstacles and false alarms",
                                    "undetected obstacles",
                                    "## Hard sets",
                                    "dead_beams",
                                    "| real, 16 beams ",
                                    "| simulated, 7 m ",
                                    "| HDL-64E ",
                                    "zermas tuned",
                                    "recall within 10 m",
                                    "## The paper's tables",
                                    "| 12.5 ",
                                    "| PC ",
                                    "## Run time",
                                    "returns per scan",
                                    "## Ablation",
                                    "no seed gate",
                                    "Bold scores are higher",
                                    "no SSA",
                                    "## Data",
                                    "101",
                                    "v1-test",
                                    "Embree",
                                    "quick run"}) {
        EXPECT_THAT(document, HasSubstr(words)) << words;
    }
    EXPECT_THAT(document, Not(HasSubstr(folder_.path().string())));  // no paths
    EXPECT_THAT(document, Not(ContainsRegex("[^a-z]nan[^a-z]")));
    EXPECT_TRUE(fs::exists(folder_ / "results/by_scan.svg"));
    EXPECT_TRUE(fs::exists(folder_ / "results/by_returns.svg"));
    EXPECT_TRUE(fs::exists(folder_ / "results/operating_curve.svg"));
    for (const auto& [file, words] :
         std::map<std::string, std::string>{{"drone.csv", "zermas tuned"},
                                            {"operating_curve.csv", "zermas tuned,Th_dist_m=0.4,"},
                                            {"missed_by_range.csv", "5-10 m"},
                                            {"missed_by_class.csv", "pole"},
                                            {"hard.csv", "dead_beams=7"},
                                            {"run_time.csv", "zermas tuned"},
                                            {"ablation_without_surface.csv", "no SSA"}}) {
        EXPECT_THAT(test::readFile(folder_ / "results" / file), HasSubstr(words)) << file;
    }
}

}  // namespace
}  // namespace hagen
