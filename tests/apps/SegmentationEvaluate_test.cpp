// segmentation-evaluate, run as a user would.
#include <hagen/recordings/ScanFolder.h>
#include "convert/ScanFolderWriter.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include "support/ProgramTest.h"
#include "support/RawBytes.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

namespace fs = std::filesystem;
const std::string kConfig = HAGEN_SOURCE_DIR "/config/";
const std::string kPaper = kConfig + "paper.yaml";
const std::string kCamera = kConfig + "camera_forward.yaml";

/// The first row with this name: precision, recall and F1 of RoI, then of ROU.
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

class SegmentationEvaluate : public test::ProgramTest {
 protected:
    test::Outcome run(const Arguments& arguments) const override {
        return test::run(HAGEN_SEGMENTATION_EVALUATE, arguments);
    }
    /// A folder with a scan of a pole on flat ground and its ground-truth labels.
    std::string labelledPole(const std::string& name = "pole") const {
        const test::SimpleScene scene = test::sceneOf({}, {{12, 2, 0.15, 8}});
        const SensorModel sensor = sensorModel("VLP-16");
        const auto labelled = test::scanScene(scene, sensor, 870, {0, 0, 2});
        LabelledReturns truth;
        truth.label = labelled.truth;
        truth.component.assign(truth.label.size(), 0);
        fs::create_directories(folder_ / name);
        convert::ScanFolderWriter writer(folder_ / name);
        writer.write("000000", labelled.scan, truth, sensor, 0.0);
        writer.finish();
        return (folder_ / name).string();
    }
    /// Like labelledPole(), with classes 1 (terrain) and 4 (pole) and the altitude.
    std::string poleWithKinds() const {
        const std::string pole = labelledPole();
        fs::create_directories(folder_ / "pole/semantic");
        const auto truth = recordings::readLabels(folder_ / "pole/labels/000000.label");
        std::vector<std::uint32_t> kinds;
        for (const auto label : truth) kinds.push_back(label == 2 ? 4 : label);
        folder_.write("pole/semantic/000000.label", test::raw(kinds));
        folder_.write("pole/kinds.yaml",
                      "1: {name: terrain, label: 1}\n4: {name: pole, label: 2}\n");
        folder_.write("pole/altitudes.txt", "2.0\n");
        return pole;
    }
    void writeLabelFile(const std::string& file, const std::vector<std::uint16_t>& labels) const {
        fs::create_directories((folder_ / file).parent_path());
        const std::vector<std::uint32_t> entries(labels.begin(), labels.end());
        folder_.write(file, test::raw(entries));
    }
    nlohmann::json json(std::vector<std::string> arguments) const {
        const std::string file = (folder_ / "report.json").string();
        arguments.insert(arguments.end(), {"--json", file, "--overwrite"});
        const auto outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return nlohmann::json::parse(test::readFile(file));
    }
    /// All labelled 16-beam scans as inputs; empty if there are none.
    static std::vector<std::string> sixteenBeamScans() {
        const fs::path data = test::dataFolder("HAGEN_LABELLED_DATA");
        std::vector<std::string> arguments;
        if (data.empty()) return arguments;
        arguments.push_back("-i");
        for (const auto& folder : fs::directory_iterator(data / "beams16")) {
            arguments.push_back(folder.path().string());
        }
        return arguments;
    }
};

TEST_F(SegmentationEvaluate, FindsWholePole) {
    const auto outcome = run({"-i", labelledPole()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(row(outcome.out, "hagen"), (std::vector<double>{1, 1, 1, 1, 1, 1})) << outcome.out;
}

TEST_F(SegmentationEvaluate, SweepOverridesFolderSettings) {
    const std::string pole = labelledPole();  // at 12 m
    std::ofstream(folder_ / "pole/sensor.yaml", std::ios::app) << "zone_m: 3\n";
    const auto f1 = [](const nlohmann::json& report, int row) {
        return report["methods"][row]["returns"]["all"]["roi"]["f1"].get<double>();
    };
    const auto report = json({"-i", pole, "--sweep", "zone_m=5,20"});
    EXPECT_LT(f1(report, 0), 0.5);
    EXPECT_EQ(f1(report, 1), 1);
}

TEST_F(SegmentationEvaluate, ReportsRecordingSettings) {
    const std::string pole = labelledPole();
    std::ofstream(folder_ / "pole/sensor.yaml", std::ios::app) << "zone_m: 3\n";
    const auto report = json({"-i", pole});
    EXPECT_EQ(report["settings"]["zone_m"], 20);
    EXPECT_EQ(report["folders"][0]["settings"]["zone_m"], 3);
    EXPECT_EQ(report["folders"][0]["settings"]["sensor.model"], "custom");
    EXPECT_THAT(run({"-i", pole}).out, HasSubstr("settings of pole: zone_m 3 (of the recording)"));
}

TEST_F(SegmentationEvaluate, ReportsUnusedFiles) {
    const std::string pole = labelledPole();
    fs::remove(folder_ / "pole/times.txt");
    folder_.write("pole/poses.tum", "0 0 0 2 0 0 0 1\n");
    folder_.write("pole/velodyne/000001.BIN", std::string(16, '\0'));
    fs::copy(folder_ / "pole/labels/000000.label", folder_ / "pole/labels/000007.label");
    const auto outcome = run({"-i", pole, "--json", (folder_ / "told.json").string()});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("without the extension .bin, such as 000001.BIN"));
    EXPECT_THAT(outcome.err, HasSubstr("pole/labels: 1, such as 000007.label"));
    EXPECT_THAT(outcome.err, HasSubstr(pole + "/poses.tum is ignored, because there is no "
                                              "times.txt"));
    const auto report = readJson("told.json");
    EXPECT_EQ(report["folders"][0]["remarks"].size(), 3u);
    folder_.write("pole/times.txt", "9\n");
    EXPECT_THAT(run({"-i", pole}).err,
                HasSubstr("poses.tum covers 0 of 1 scan; the others are not levelled"));
}

TEST_F(SegmentationEvaluate, RecoversUnnamedSensor) {
    const std::string pole = labelledPole(), other = labelledPole("other");
    EXPECT_THAT(run({"-i", pole}).out, testing::Not(HasSubstr("recovered")));
    const auto named = json({"-i", pole});
    EXPECT_TRUE(named["folders"][0]["recovered_sensor"].is_null());
    fs::remove(folder_ / "pole/sensor.yaml");
    const auto outcome = run({"-i", pole, other, "--baselines", "--sweep", "beta_deg=5,10"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out,
                HasSubstr("\nsensor of pole: 8 beams recovered (VLP-16, which has 16), "));
    EXPECT_THAT(outcome.out, testing::Not(HasSubstr("sensor of other")));
    EXPECT_EQ(row(outcome.out, "beta_deg=10"), (std::vector<double>{1, 1, 1, 1, 1, 1}));
    EXPECT_THAT(json({"-i", pole})["folders"][0]["recovered_sensor"].get<std::string>(),
                HasSubstr("8 beams recovered"));
    // Degraded copies have the same sensor, mirrored if upside down.
    for (const std::string degradation : {"upside_down", "dead_beams=3"}) {
        const auto degraded = run({"-i", pole, "--degrade", degradation});
        EXPECT_EQ(degraded.exit_code, 0) << degraded.err;
        EXPECT_THAT(degraded.out, HasSubstr("\n" + degradation)) << degraded.out;
    }
    // Settings may name the sensor.
    EXPECT_THAT(run({"-i", pole, "-c", kConfig + "vlp16.yaml"}).out,
                testing::Not(HasSubstr("recovered")));
}

TEST_F(SegmentationEvaluate, SweepHasRowPerValue) {
    const auto outcome = expectSuccess({labelledPole(), "--sweep", "zone_m=5,20", "--sweep",
                                        "beta_deg=10", "--sweep", "ground_tolerance_m=0.1,0.25"});
    EXPECT_THAT(outcome.err, HasSubstr("zone_m=5: WARNING: obstacles beyond zone_m (5 m)"));
    EXPECT_THAT(outcome.err, Not(HasSubstr("zone_m=20: WARNING")));
    EXPECT_EQ(row(outcome.out, "zone_m=5").at(1), 0.0) << outcome.out;  // excludes the pole
    EXPECT_EQ(row(outcome.out, "zone_m=20").at(1), 1.0);
    EXPECT_EQ(row(outcome.out, "beta_deg=10").at(1), 1.0);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("..lerance_m=0.1"), HasSubstr("..erance_m=0.25")));
}

TEST_F(SegmentationEvaluate, ListsBaselines) {
    const auto report = json({"-i", labelledPole(), "--baselines"});
    std::vector<std::string> names;
    for (const auto& method : report["methods"]) {
        names.push_back(method["name"]);
        // On flat ground with one pole, every method works.
        EXPECT_GT(method["returns"]["all"]["rou"]["f1"], 0.9) << method["name"];
        EXPECT_EQ(method["latency_ms"]["runs"], 1);
    }
    ASSERT_GE(names.size(), 5u);
    names.resize(5);
    EXPECT_EQ(names, (std::vector<std::string>{"hagen", "zermas", "zermas tuned", "bogoslavskyi",
                                               "bogoslavskyi tuned"}));
}

// Label files of another program.
TEST_F(SegmentationEvaluate, ScoresLabelsFromOtherPrograms) {
    const std::string pole = labelledPole();
    const auto truth = recordings::readLabels(folder_ / "pole/labels/000000.label");
    writeLabelFile("theirs/000000.label", truth);
    std::vector<std::uint16_t> wrong = truth;
    for (std::uint16_t& label : wrong) label = label == 2 ? 1 : label;
    wrong[0] = 0;
    writeLabelFile("blind/labels/000000.label", wrong);
    const auto report = json({"-i", pole, "--labels", "theirs=" + path("theirs"), "--labels",
                              "blind one=" + path("blind"), "--charts", path("charts")});
    const auto& methods = report["methods"];
    ASSERT_EQ(methods.size(), 3u);
    EXPECT_EQ(methods[1]["name"], "theirs");
    EXPECT_EQ(methods[1]["returns"]["all"]["correct"], 1.0);
    EXPECT_EQ(methods[1]["returns"]["all"]["returns"], methods[0]["returns"]["all"]["returns"]);
    EXPECT_TRUE(methods[1]["latency_ms"].is_null());
    EXPECT_EQ(methods[2]["name"], "blind one");
    EXPECT_EQ(methods[2]["returns"]["all"]["roi"]["recall"], 0.0);
    EXPECT_THAT(test::readFile(folder_ / "charts/by_range.svg"), HasSubstr("blind one"));
    const auto outcome = run({"-i", pole, "--labels", "theirs=" + path("theirs")});
    EXPECT_EQ(row(outcome.out, "theirs"), (std::vector<double>{1, 1, 1, 1, 1, 1})) << outcome.out;
}

/// A closed pipe, an input as output, and an interruption.
TEST_F(SegmentationEvaluate, KeepsFilesOnFailure) {
    const std::string pole = labelledPole();
    const auto piped =
        test::run("/bin/bash", {"-c", "\"" + std::string(HAGEN_SEGMENTATION_EVALUATE) + "\" -i \"" +
                                          pole + "\" --json \"" + path("pole.json") +
                                          "\" | true; exit ${PIPESTATUS[0]}"});
    EXPECT_EQ(piped.exit_code, 1);
    EXPECT_THAT(piped.err, HasSubstr("cannot write to standard output"));
    EXPECT_TRUE(fs::exists(path("pole.json")));
    const std::string settings = folder_.write("c.yaml", "beta_deg: 7\n");
    const std::vector<std::string> flags{"-i", pole, "--overwrite", "--json", settings};
    expectFailure(with(flags, {"-c", settings}), 1, "is or contains the input");
    const std::string interrupted =
        "timeout -s TERM -k 20 0.5 \"" + std::string(HAGEN_SEGMENTATION_EVALUATE) + "\" -i \"" +
        pole + "\" --baselines --hard-sets --bootstrap 1000000 --charts \"" + path("charts") + "\"";
    const auto outcome = test::run("/bin/bash", {"-c", interrupted});
    if (outcome.exit_code == 0) GTEST_SKIP() << "scoring ended within 0.5 s";
    if (outcome.err.empty()) GTEST_SKIP() << "scoring had not begun after 0.5 s";
    EXPECT_THAT(outcome.err, HasSubstr("interrupted; no output was written"));
    expectNoTemporaryFiles();
}

TEST_F(SegmentationEvaluate, FindsLabelsByFolderName) {
    const std::string pole = labelledPole(), other = labelledPole("other");
    const auto truth = recordings::readLabels(folder_ / "pole/labels/000000.label");
    writeLabelFile("theirs/pole/000000.label", truth);
    const std::string theirs = "theirs=" + path("theirs");
    expectFailure({"-i", pole, other, "--labels", theirs}, 1, "theirs/other/000000.label: no such");
    writeLabelFile("theirs/other/labels/000000.label", truth);
    const auto report = json({"-i", pole, other, "--labels", theirs});
    EXPECT_EQ(report["methods"][1]["returns"]["all"]["correct"], 1.0);
    EXPECT_EQ(report["methods"][1]["returns"]["by_folder"].size(), 2u);
    EXPECT_EQ(json({"-i", pole, "--labels", theirs})["methods"].size(), 2u);
}

TEST_F(SegmentationEvaluate, RejectsUnusableLabels) {
    const std::string pole = labelledPole(), theirs = path("theirs");
    fs::create_directories(theirs);
    const Arguments flags{"-i", pole, "--labels"};
    expectFailures(flags, 2,
                   {{{theirs}, "expected NAME=DIR"},
                    {{"=" + theirs}, "expected NAME=DIR"},
                    {{"theirs="}, "expected NAME=DIR"},
                    {{"a=" + path("none")}, "none: no such folder"},
                    {{"a=" + theirs, "--labels", "a=" + theirs}, "already a row 'a'"},
                    {{"hagen=" + theirs}, "already a row 'hagen'"},
                    {{"zermas tuned=" + theirs, "--baselines"}, "already a row 'zermas tuned'"}});
    expectFailure(with(flags, {"a=" + theirs}), 1, "theirs/000000.label: no such file");
    auto labels = recordings::readLabels(folder_ / "pole/labels/000000.label");
    labels[6] = 3;
    writeLabelFile("theirs/000000.label", labels);
    expectFailure(with(flags, {"a=" + theirs}), 1, "000000.label: label 7 is 3; write 0");
    labels.resize(2);
    writeLabelFile("theirs/000000.label", labels);
    expectFailure(with(flags, {"a=" + theirs}), 1, "000000.label: has 2 labels for");
}

// The pole's returns above z = 0.5 m - 2 m are more than 0.5 m above ground.
TEST_F(SegmentationEvaluate, ScoresTallObstacles) {
    const std::string pole = poleWithKinds();
    auto truth = recordings::readLabels(folder_ / "pole/labels/000000.label");
    Scan scan;
    recordings::readScan(folder_ / "pole/velodyne/000000.bin", scan);
    int high = 0, all_roi = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        all_roi += truth[i] == 2;
        high += truth[i] == 2 && scan.z_m[i] > 0.5f - 2.0f;
    }
    ASSERT_GT(high, 10);
    ASSERT_GT(all_roi, high);
    std::vector<std::uint16_t> blind(truth.size(), 1);
    const auto bare = std::find(truth.begin(), truth.end(), 1);  // ground behind the sensor
    blind[static_cast<std::size_t>(bare - truth.begin())] = 2;
    writeLabelFile("blind/000000.label", blind);
    const std::vector<std::string> flags{"-i", pole, "--labels", "blind=" + path("blind")};
    auto drone = json(flags)["methods"][1]["drone"];
    EXPECT_EQ(drone["returns_above_half_metre"]["missed"], high);
    EXPECT_EQ(drone["returns_above_half_metre"]["of"], high);
    EXPECT_EQ(drone["returns_above_half_metre_by_kind"][0]["name"], "pole");
    EXPECT_EQ(drone["returns_above_half_metre_by_range"][0]["name"], "10-15 m");
    EXPECT_EQ(drone["false_roi_on_bare_ground_per_scan"], 1.0);
    EXPECT_TRUE(drone["obstacles"].is_null());  // obstacles are not numbered yet
    std::vector<std::uint32_t> numbered;
    for (const std::uint16_t label : truth) numbered.push_back(label == 2 ? 7 << 16 | 2 : label);
    folder_.write("pole/labels/000000.label", test::raw(numbered));
    EXPECT_EQ(json(flags)["methods"][0]["drone"]["obstacles"]["missed"], 0);
    EXPECT_EQ(json(flags)["methods"][1]["drone"]["obstacles"]["missed"], 1);
    EXPECT_EQ(json(flags)["methods"][1]["drone"]["obstacles"]["of"], 1);
    const auto outcome = run(flags);
    EXPECT_THAT(outcome.out, HasSubstr("What matters to a drone"));
    EXPECT_THAT(outcome.out, HasSubstr("Missed obstacle returns above 0.5 m, by object class"));
}

TEST_F(SegmentationEvaluate, ScoresDegradedScans) {
    const std::string pole = labelledPole();
    writeLabelFile("theirs/000000.label",
                   recordings::readLabels(folder_ / "pole/labels/000000.label"));
    const std::vector<std::string> flags{
        "-i",        pole,           "--labels",  "theirs=" + path("theirs"),
        "--degrade", "dropout=0",    "--degrade", "dropout=50",
        "--degrade", "below_deg=-90"};
    const auto report = json(flags);
    const auto& recorded = report["methods"][0];
    const auto& sets = report["hard_sets"];
    ASSERT_EQ(sets.size(), 3u);
    for (const auto& set : sets) EXPECT_EQ(set["methods"].size(), 1u);  // ignores --labels
    const auto& same = sets[0]["methods"][0];
    EXPECT_EQ(sets[0]["name"], "dropout=0");
    EXPECT_EQ(same["name"], "hagen");
    for (const char* key : {"roi", "rou"}) {
        EXPECT_EQ(same["returns"][key]["hits"], recorded["returns"]["all"][key]["hits"]);
    }
    EXPECT_EQ(same["roi_f1_change_points"], 0.0);
    EXPECT_EQ(same["drone"], recorded["drone"]);
    const int all = recorded["returns"]["all"]["returns"];
    EXPECT_NEAR(int(sets[1]["methods"][0]["returns"]["returns"]), all / 2, all / 20);
    EXPECT_EQ(sets[2]["methods"][0]["returns"]["returns"], 0);
    EXPECT_TRUE(sets[2]["methods"][0]["rou_f1_change_points"].is_null());
    const auto outcome = run(flags);
    EXPECT_THAT(outcome.out, HasSubstr("On degraded scans: hagen"));
    EXPECT_EQ(row(outcome.out, "below_deg=-90").size(), 6u);
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

// On labelled recordings, the published filter must reach these scores.
TEST_F(SegmentationEvaluate, PaperPresetReachesRequiredScores) {
    std::vector<std::string> arguments = sixteenBeamScans();
    if (arguments.empty()) GTEST_SKIP() << "HAGEN_LABELLED_DATA is not a folder of labelled scans";
    arguments.insert(arguments.end(), {"-c", kPaper});
    const auto outcome = run(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_GE(row(outcome.out, "hagen").at(2), 0.86) << outcome.out;
    EXPECT_GE(row(outcome.out, "hagen").at(5), 0.92) << outcome.out;
}

// The shipped map turns the classes of semantic/ into the labels of labels/.
TEST_F(SegmentationEvaluate, ShippedLabelMapMatchesData) {
    std::vector<std::string> arguments = sixteenBeamScans();
    if (arguments.empty()) GTEST_SKIP() << "HAGEN_LABELLED_DATA is not a folder of labelled scans";
    const auto plain = json(arguments);
    arguments.insert(arguments.end(), {"--label-map", kConfig + "semantic_kitti.yaml"});
    const auto mapped = json(arguments);
    EXPECT_EQ(plain["methods"][0]["returns"]["all"], mapped["methods"][0]["returns"]["all"]);
    EXPECT_TRUE(plain["methods"][0]["returns"]["by_kind"].empty());
    EXPECT_GT(mapped["methods"][0]["returns"]["by_kind"].size(), 10u);
    arguments.back() = kConfig + "semantic_kitti_without_vegetation.yaml";
    const auto without = json(arguments);
    std::int64_t vegetation = 0;
    for (const auto& kind : mapped["methods"][0]["returns"]["by_kind"]) {
        if (kind["name"] == "vegetation") vegetation = kind["returns"];
    }
    EXPECT_GT(vegetation, 0);
    EXPECT_EQ(mapped["methods"][0]["returns"]["all"]["returns"].get<std::int64_t>() - vegetation,
              without["methods"][0]["returns"]["all"]["returns"].get<std::int64_t>());
}

TEST_F(SegmentationEvaluate, JsonCountsAddUp) {
    const auto report = json({"-i", poleWithKinds(), labelledPole("other"), "--bootstrap", "50"});
    EXPECT_EQ(report["scans"], 2);
    EXPECT_EQ(report["bootstrap"]["resamples"], 50);
    EXPECT_EQ(report["folders"][1]["name"], "other");
    const auto& returns = report["methods"][0]["returns"];
    EXPECT_EQ(returns["all"]["roi"]["f1"], 1.0);
    EXPECT_EQ(returns["all"]["roi"]["f1_interval"], (std::vector<double>{1, 1}));
    EXPECT_EQ(report["methods"][0]["latency_ms"]["runs"], 2);
    EXPECT_TRUE(report["methods"][0]["pixels"].is_null());
    for (const char* part : {"by_range", "by_folder"}) {
        std::int64_t hits = 0;
        for (const auto& group : returns[part]) hits += group["roi"]["hits"].get<std::int64_t>();
        EXPECT_EQ(returns["all"]["roi"]["hits"], hits) << part;
    }
    // One of two otherwise identical folders has classes and an altitude.
    ASSERT_EQ(returns["by_kind"].size(), 2u);
    EXPECT_EQ(returns["by_kind"][0]["name"], "pole");
    EXPECT_EQ(returns["by_kind"][0]["returns"].get<std::int64_t>() * 2,
              returns["all"]["roi"]["hits"].get<std::int64_t>());
    ASSERT_EQ(returns["by_altitude"].size(), 1u);
    EXPECT_EQ(returns["by_altitude"][0]["name"], "2-3 m");
    EXPECT_EQ(returns["by_altitude"][0]["scans"], 1);
}

TEST_F(SegmentationEvaluate, ScoresCameraPixels) {
    const auto report = json({"-i", labelledPole(), "--camera", kCamera});
    const auto& pixels = report["methods"][0]["pixels"]["all"];
    const auto& returns = report["methods"][0]["returns"]["all"];
    EXPECT_EQ(pixels["roi"]["f1"], 1.0);
    EXPECT_LT(pixels["returns"], returns["returns"]);  // the camera sees a quarter of the circle
    EXPECT_GT(pixels["returns"], 100);
}

/// An evaluation may take hours, so failed pictures must not lose the scores.
TEST_F(SegmentationEvaluate, KeepsScoresWithoutPictures) {
    fs::permissions(folder_.write("python3", "#!/bin/sh\nexit 3\n"), fs::perms::owner_all);
    const auto outcome = test::run(
        "/bin/bash", {"-c", "PATH=\"" + folder_.path().string() + ":$PATH\" exec \"" +
                                std::string(HAGEN_SEGMENTATION_EVALUATE) + "\" -i \"" +
                                labelledPole() + "\" --camera \"" + kCamera + "\" --json \"" +
                                path("a.json") + "\" --charts \"" + path("charts") + "\""});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(path("charts") + ": python3 ended"));
    EXPECT_EQ(row(outcome.out, "hagen"), (std::vector<double>{1, 1, 1, 1, 1, 1})) << outcome.out;
    EXPECT_EQ(readJson("a.json")["methods"].size(), 1u);
    EXPECT_FALSE(fs::exists(path("charts")));
}

TEST_F(SegmentationEvaluate, DrawsCharts) {
    const std::string charts = (folder_ / "charts").string();
    const auto outcome = run({"-i", poleWithKinds(), "--charts", charts, "--sweep",
                              "zone_m=5,15,20", "--sweep", "seeds=lowest"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const char* chart : {"by_range.svg", "by_altitude.svg", "by_kind.svg", "sweep_zone_m.svg",
                              "sweep_seeds.svg"}) {
        EXPECT_TRUE(fs::exists(fs::path(charts) / chart)) << chart;
    }
    EXPECT_THAT(test::readFile(folder_ / "charts/by_range.svg"), HasSubstr("zone_m=15"));
}

TEST_F(SegmentationEvaluate, RejectsInvalidArguments) {
    expectFailure({}, 2, "--input");
    const std::string pole = labelledPole(), unnamed = labelledPole("unnamed");
    fs::remove(folder_ / "unnamed/sensor.yaml");
    const std::string window = folder_.write("window.yaml", "window_size: 20\n");
    const std::string map = folder_.write("map.yaml", "1: {name: soil, label: ground}\n");
    const std::string camera = folder_.write("camera.yaml", "width: 640\nheight: 480\n");
    expectFailure({"-i", unnamed, "-c", window}, 2, "window_size (20)");
    expectFailures({"-i", pole}, 2,
                   {{{"--sweep", "beta_deg"}, "KEY=VALUE"},
                    {{"--sweep", "beta=5"}, "'beta_deg'"},
                    {{"--sweep", "zone_m=5,20,5"}, "zone_m=5 is given twice"},
                    {{"--sweep", "zone_m=5,"}, "zone_m"},
                    {{"--sweep", "window_size=16"}, "window_size (16)"},
                    {{"--sweep", "window_scans=1,3"}, "each scan alone"},
                    {{"--max-range-m", "-3"}, "--max-range-m"},
                    {{"-c", "none.yaml"}, "none.yaml"},
                    {{"-i", pole + "/"}, "is given twice"},
                    {{"--bootstrap", "-1"}, "--bootstrap"},
                    {{"--baselines", "zermas"}, "zermas"},
                    {{"--baselines", "--sweep", "zermas=1"}, "zermas"},
                    {{"--json", ""}, "--json: must not be empty"},
                    {{"--label-map", ""}, "--label-map: must not be empty"},
                    {{"--label-map", "none.yaml"}, "none.yaml: no such file"},
                    {{"--label-map", map}, "map.yaml:1: label 'ground' is not 0"},
                    {{"--camera", camera}, "camera.yaml: has no key 'cx'"},
                    {{"--degrade", "snow=3"}, "'snow=3': unknown; known: dead_beams"},
                    {{"--degrade", "dropout=120"}, "from 0 to 100"},
                    {{"--degrade", "dead_beams=16"}, "pole: 'dead_beams=16': the sensor"},
                    {{"--degrade"}, "--degrade"}});
}

TEST_F(SegmentationEvaluate, KeepsExistingFiles) {
    folder_.write("report.json", "mine");
    folder_.write("charts/holiday.svg", "mine");
    expectFailures({"-i", labelledPole()}, 1,
                   {{{"--json", path("report.json")}, "--overwrite"},
                    {{"--charts", path("charts"), "--overwrite"}, "contains 'holiday.svg'"}});
    EXPECT_EQ(test::readFile(path("report.json")), "mine");
}

TEST_F(SegmentationEvaluate, RejectsPredictionsAsTruth) {
    const std::string pole = labelledPole();
    const std::string found = (folder_ / "found").string();
    ASSERT_EQ(test::run(HAGEN_RAWLOG_SEGMENT, {"-i", pole, "--kitti", found}).exit_code, 0);
    const auto of_predictions = run({"-i", found});
    EXPECT_EQ(of_predictions.exit_code, 1);
    EXPECT_THAT(of_predictions.err, HasSubstr(found + ": its labels are predictions"));
    EXPECT_THAT(of_predictions.err, HasSubstr("--labels NAME=" + found));
    EXPECT_EQ(run({"-i", pole, "--labels", "found=" + found}).exit_code, 0);
    const auto of_itself = run({"-i", pole, "--labels", "itself=" + pole});
    EXPECT_EQ(of_itself.exit_code, 1);
    EXPECT_THAT(of_itself.err, HasSubstr(pole + "/labels: is the ground truth itself"));
}

TEST_F(SegmentationEvaluate, RejectsWrongScansAndLabels) {
    fs::create_directories(folder_ / "empty/velodyne");
    const std::string pole = labelledPole();
    expectFailure({"-i", path("none")}, 2, path("none"));
    expectFailures({}, 1,
                   {{{folder_.path().string()}, "there are scans in " + pole},
                    {{"-i", path("empty")}, "not a scan folder"}});
    folder_.write("pole/labels/000000.label", std::string("\1\0\0\0", 4));
    expectFailure({"-i", pole}, 1, "000000.label");
    const auto returns = fs::file_size(folder_ / "pole/velodyne/000000.bin") / 16;
    folder_.write("pole/labels/000000.label", std::string(4 * returns, '\7'));
    expectFailure({"-i", pole}, 1, "is not 0");
    fs::remove_all(folder_ / "pole/labels");
    expectFailure({"-i", pole}, 1, "000000.label");
}

}  // namespace
}  // namespace hagen
