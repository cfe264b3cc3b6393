// What is told of runs: sums with known answers; and the built program's report and replay.
#include <gtest/gtest.h>
#include <hagen/simulation/Random.h>
#include <sys/stat.h>

#include <mrpt/opengl/COctoMapVoxels.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfTriangles.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "octomap-compare/ChooseRun.h"
#include "octomap-compare/Ending.h"
#include "octomap-compare/Overhead.h"
#include "octomap-compare/Replay.h"
#include "octomap-compare/Report.h"
#include "octomap-compare/ReportWords.h"
#include "octomap-compare/SharedCourses.h"
#include "octomap-compare/Summary.h"
#include "octomap-compare/Table.h"
#include "octomap-compare/Web.h"
#include "support/Program.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;
using Row = hagen::Run;  // a test has a Run() of its own

Row runOf(const std::string& scenario, std::uint64_t seed, const std::string& model,
          const std::string& guidance, hagen::Outcome outcome, double speed_m_s = 4) {
    Row run{};
    run.scenario = scenario;
    run.seed = seed;
    run.setup.model = model;
    run.setup.guidance = guidance;
    run.setup.speed_m_s = speed_m_s;
    run.result = {outcome, 0.1 * static_cast<double>(seed % 10),
                  44,      12,
                  NAN,     20,
                  100,     5,
                  2,       4,
                  6,       static_cast<double>(seed)};
    run.oracle_path_m = 40;
    run.settings_hash = "a";
    run.version = "1";
    return run;
}

constexpr auto kWon = hagen::Outcome::Success, kHit = hagen::Outcome::Collision,
               kLate = hagen::Outcome::Timeout;
const Condition kReference{4, "primitives", PoseError::None, 1, false};

/// Seeds 0..9: W-RoI wins all but 0 (hit); O-Full-0.4 all but 0, 1, 2 (late); W-RoI straight none.
std::vector<Row> threeContenders() {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        runs.push_back(runOf("gap", seed, "W-RoI", "astar", seed == 0 ? kHit : kWon));
        runs.push_back(runOf("gap", seed, "O-Full-0.4", "astar", seed < 3 ? kLate : kWon));
        runs.push_back(runOf("gap", seed, "W-RoI", "straight", kLate));
    }
    return runs;
}

TEST(Summary, CountsCellsAndSpreads) {
    const Summary summary = summarize(threeContenders());
    ASSERT_EQ(summary.contenders.size(), 3u);
    EXPECT_EQ(nameOf(summary.contenders[0]), "W-RoI, A*");
    const Cell* cell = find(summary, "gap", kReference, {"W-RoI", "astar"});
    ASSERT_NE(cell, nullptr);
    EXPECT_EQ(cell->runs, 10);
    EXPECT_EQ(cell->successes, 9);
    EXPECT_EQ(cell->collisions, 1);
    EXPECT_EQ(cell->timeouts, 0);
    EXPECT_NEAR(cell->min_clearance_m.median, 0.45, 1e-12);  // 0, 0.1, ..., 0.9
    EXPECT_NEAR(cell->path_ratio.median, 44 / 38.5, 1e-12);  // 1.5 m before the goal it ends
    EXPECT_EQ(cell->path_ratio.count, 9);                    // of successful ones alone
    EXPECT_EQ(cell->first_reaction_m.count, 0);
    EXPECT_NEAR(cell->dropped_percent, 5, 1e-12);
    EXPECT_NEAR(cell->stops_per_km, 2 / 0.044, 1e-9);
    EXPECT_EQ(cell->latency_max_ms, 9);
    EXPECT_EQ(find(summary, "gap", kReference, {"W-Full", "astar"}), nullptr);
}

TEST(Summary, PairsRunsThroughTheSameCourse) {
    std::vector<Row> runs = threeContenders();
    runs.push_back(runOf("gap", 99, "W-RoI", "astar", kWon));  // nobody else flew it
    const Summary summary = summarize(runs);
    // A*: against the map and against itself straight; straight: against the map under A*.
    ASSERT_EQ(summary.pairings.size(), 3u);
    const Pairing* pairing = nullptr;
    for (const Pairing& one : summary.pairings) {
        if (one.first.guidance == "astar" && one.second.model == "O-Full-0.4") pairing = &one;
    }
    ASSERT_NE(pairing, nullptr);
    EXPECT_EQ(pairing->both, 7);
    EXPECT_EQ(pairing->only_first, 2);
    EXPECT_EQ(pairing->only_second, 0);
    EXPECT_EQ(pairing->neither, 1);
    EXPECT_EQ(pairing->only_first_collided, 1);
    EXPECT_NEAR(pairing->difference, 0.2, 1e-12);
    EXPECT_NEAR(pairing->p, 0.5, 1e-12);
    EXPECT_GE(pairing->p_holm, pairing->p);
    EXPECT_EQ(pairing->verdict, Verdict::Open);
}

TEST(Summary, JudgesByTheMargin) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        runs.push_back(runOf("gap", seed, "W-RoI", "astar", seed < 2 ? kHit : kWon));
        runs.push_back(runOf("gap", seed, "W-Full", "astar", seed == 2 ? kHit : kWon));
        runs.push_back(runOf("gap", seed, "G-Full", "astar", seed < 100 ? kLate : kWon));
        runs.push_back(runOf("gap", seed, "W-RoI", "straight", seed < 100 ? kLate : kWon));
    }
    for (const Pairing& pairing : summarize(runs).overall) {
        const bool is_worse =
            pairing.first.guidance == "straight" && pairing.second.model != "G-Full";
        EXPECT_EQ(pairing.verdict, is_worse ? Verdict::Inferior : Verdict::NotInferior)
            << nameOf(pairing.first) << " " << nameOf(pairing.second);
    }
}

TEST(Summary, TheHighestSpeedIsTheLastBeforeTheFirstFailure) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        for (const double speed_m_s : {4.0, 6.0, 8.0, 10.0}) {
            const bool fails = speed_m_s == 8 && seed < 6;  // 94 %
            runs.push_back(
                runOf("forest-0.10", seed, "W-RoI", "astar", fails ? kHit : kWon, speed_m_s));
        }
    }
    const Summary summary = summarize(runs);
    ASSERT_EQ(summary.speed_limits.size(), 1u);
    EXPECT_EQ(summary.speed_limits[0].highest_m_s, 6);
    EXPECT_EQ(summary.speed_limits[0].sure_m_s, 6);  // 100 of 100: 96.3 % and more
}

TEST(Verdict, TellsWiresApartFromTheRest) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        runs.push_back(runOf("gap", seed, "W-RoI", "astar", kWon));
        runs.push_back(runOf("gap", seed, "W-Full", "astar", seed == 0 ? kHit : kWon));
        runs.push_back(runOf("wires", seed, "W-RoI", "astar", seed < 100 ? kHit : kWon));
        runs.push_back(runOf("wires", seed, "W-Full", "astar", kWon));
    }
    const Summary summary = summarize(runs);
    ASSERT_EQ(summary.without_wires.size(), 1u);
    EXPECT_EQ(summary.without_wires[0].pairs(), 400);
    EXPECT_EQ(summary.without_wires[0].verdict, Verdict::NotInferior);
    const std::vector<std::string> words = verdictOf(summary);
    EXPECT_EQ(words[0],
              "W-RoI with A* at 4 m/s arrives less often than W-Full (among wires), by more than "
              "3 points. It loses less than 3 points, if any, to W-Full (where no wires are).");
    EXPECT_EQ(
        words[1].find("Where no wires are, W-RoI with A* against W-Full: success 100.0 % against "
                      "99.8 % of the same 400 courses, +0.2 points (95 % interval "),
        0u)
        << words[1];
    EXPECT_EQ(
        words[2].find("Among wires, W-RoI with A* against W-Full: success 75.0 % against 100.0 %"),
        0u)
        << words[2];
    // Where nobody flew wires, all is where no wires are.
    EXPECT_TRUE(summarize(threeContenders()).without_wires.empty());
}

TEST(Verdict, SpeaksOfOneAsOne) {
    const std::vector<std::string> words = verdictOf(summarize(
        {runOf("gap", 0, "W-RoI", "astar", kHit), runOf("gap", 0, "G-Full", "astar", kWon)}));
    ASSERT_EQ(words.size(), 5u);
    EXPECT_EQ(words[0], "W-RoI with A* at 4 m/s: nothing is decided yet. Open: G-Full.");
    EXPECT_EQ(words[1].find(
                  "Open: W-RoI with A* against G-Full: success 0.0 % against 100.0 % of the same "
                  "1 course, -100.0 points ("),
              0u)
        << words[1];
    EXPECT_EQ(words[2], "What is open needs more courses to be decided.");
    EXPECT_EQ(words[3].find("W-RoI with A*: 1 collision in 1 run ("), 0u) << words[3];
    EXPECT_NE(words[4].find("0 collisions in 1 run of a scenario still allows"), std::string::npos);
}

TEST(Verdict, CallsNothingWorseThatMayBeChance) {
    // The interval excludes 3 points, but among so many comparisons the test does not.
    Pairing pairing{"", kReference, {"W-RoI", "astar"}, {"G-Full", "astar"}};
    pairing.both = 90;
    pairing.only_second = 10;
    pairing.difference = -0.1;
    pairing.interval = {-0.17, -0.04};
    pairing.verdict = Verdict::Inferior;
    pairing.p_holm = 0.06;
    EXPECT_EQ(differenceText(pairing).find("Open: "), 0u);
    EXPECT_NE(differenceText(pairing).find("may be chance"), std::string::npos);
    pairing.p_holm = 0.04;
    EXPECT_EQ(differenceText(pairing).find(
                  "W-RoI with A* against G-Full: success 90.0 % against 100.0 %"),
              0u);
}

TEST(SharedCourses, AreThoseOnWhichAllArrived) {
    std::vector<Row> runs = threeContenders();
    runs.push_back(runOf("gap", 99, "W-RoI", "astar", kWon));  // nobody else flew it
    for (Row& run : runs) {
        if (run.setup.model == "W-RoI" && run.seed < 5) run.result.time_s = 100;
        if (run.seed != 7) run.result.first_reaction_m = static_cast<double>(run.seed);
    }
    const Summary summary = summarize(runs);
    const std::vector<SharedCourses> shared = sharedCourses(runs, summary, kReference);
    ASSERT_EQ(shared.size(), 2u);
    EXPECT_EQ(shared[0].guidance, "astar");
    EXPECT_EQ(shared[0].flown, 10);
    EXPECT_EQ(shared[0].arrived, 7);  // 3 to 9: the map was late on 0, 1 and 2
    EXPECT_EQ(shared[0].reacted, 6);
    ASSERT_EQ(shared[0].cells.size(), 2u);
    EXPECT_EQ(shared[0].cells[0].contender.model, "W-RoI");
    for (const Cell& cell : shared[0].cells) {
        EXPECT_EQ(cell.time_s.count, 7);
        EXPECT_NEAR(cell.time_s.median, 12, 1e-12);  // of all its own it would be 56
        EXPECT_EQ(cell.first_reaction_m.count, 6);
    }
    EXPECT_EQ(shared[0].min_clearances_m[1].size(), 10u);
    EXPECT_EQ(sharedWords(shared[0]),
              "With A*: 10 courses were flown by both contenders; on 7 of these all arrived, on 6 "
              "all reacted to something.");
    EXPECT_EQ(shared[1].arrived, 0);
    EXPECT_TRUE(shared[1].cells.empty());
    EXPECT_EQ(sharedWords(shared[1]),
              "Flown straight: 10 courses were flown by W-RoI, straight; it arrived on none.");
}

/// Maps are slow to fly: their few courses must not be all that is told of the others.
TEST(SharedCourses, WhoFlewFewerComesInWithATableOfItsOwn) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        runs.push_back(runOf("gap", seed, "W-RoI", "astar", kWon));
        if (seed < 19) runs.push_back(runOf("gap", seed, "G-Full", "astar", kWon));
        if (seed < 4) runs.push_back(runOf("gap", seed, "O-Full-0.4", "astar", kWon));
    }
    const std::vector<SharedCourses> shared = sharedCourses(runs, summarize(runs), kReference);
    ASSERT_EQ(shared.size(), 2u);
    EXPECT_EQ(shared[0].contenders.size(), 2u);
    EXPECT_EQ(shared[0].arrived, 19);
    EXPECT_EQ(shared[1].contenders.size(), 3u);
    EXPECT_EQ(shared[1].arrived, 4);
}

TEST(Verdict, SaysWhereWhatWasNotFlownEverywhere) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        for (const char* scenario : {"gap", "u-trap"}) {
            runs.push_back(runOf(scenario, seed, "W-RoI", "astar", kWon));
            runs.push_back(runOf(scenario, seed, "G-Full", "astar", kWon));
        }
        runs.push_back(runOf("gap", seed, "O-Full-0.4", "astar", kWon));
    }
    const std::string headline = verdictOf(summarize(runs)).front();
    EXPECT_NE(headline.find("O-Full-0.4 (in gap)"), std::string::npos) << headline;
    EXPECT_EQ(headline.find("G-Full ("), std::string::npos) << headline;
}

TEST(Overhead, ShowsTheWholeFlightAndMarksItsEnds) {
    OverheadView view{runOf("gap", 0, "W-RoI", "astar", kHit), true, {5, 0}, {45, 0}, {}, {}, {}};
    view.track_m = {{5, 0}, {20, 30}};
    const std::string hit = svgOf(view);
    // 5 m around 5 to 45 and 0 to 30, and half as wide again as high: 60 x 40.
    EXPECT_NE(hit.find("viewBox=\"-5.0 -35.0 60.0 40.0\""), std::string::npos) << hit;
    EXPECT_NE(hit.find("class=\"hit\""), std::string::npos);
    EXPECT_EQ(hit.find("class=\"end\""), std::string::npos);
    view.run.result.outcome = kLate;
    EXPECT_NE(svgOf(view).find("class=\"end\""), std::string::npos);
    view.track_m.clear();  // a straight way is shown with what is beside it
    EXPECT_NE(svgOf(view).find("viewBox=\"0.0 -16.7 50.0 33.3\""), std::string::npos);
    for (const char* mark : {"start", "goal", "end", "hit", "stop", "track", "obstacles"}) {
        EXPECT_NE(overheadLegend().find("class=\"" + std::string(mark) + "\""), std::string::npos)
            << mark;
    }
}

TEST(Pages, ShowTheWorstRunsThatCanBeFlownBesideThoseThatCannot) {
    Report report;
    report.flown.runs = threeContenders();
    report.summary = summarize(report.flown.runs);
    report.worst_missing = {"the first cannot", "the second cannot"};
    EXPECT_EQ(reportPage(report).find(overheadLegend()), std::string::npos);
    report.worst.push_back({report.flown.runs[0], true, {5, 0}, {45, 0}, {}, {}, {}});
    const std::string page = reportPage(report);
    EXPECT_NE(page.find(overheadLegend()), std::string::npos);
    EXPECT_NE(page.find("Flown again from their seeds"), std::string::npos);
    EXPECT_NE(page.find("<p>the first cannot</p>\n<p>the second cannot</p>"), std::string::npos);
}

TEST(Summary, OfNothingIsEmpty) {
    EXPECT_TRUE(summarize({}).cells.empty());
    EXPECT_NE(reportPage(Report{}).find("Nothing was flown"), std::string::npos);
}

TEST(WorstRuns, AreCollisionsThenTimeoutsThenByClearanceOneOfAKind) {
    std::vector<Row> runs = threeContenders();
    runs.push_back(runOf("gap", 0, "oracle", "astar", kHit));
    runs.push_back(runOf("street", 1, "W-RoI", "astar", kHit));
    const std::vector<Row> worst = worstRuns(runs, 3);
    ASSERT_EQ(worst.size(), 3u);
    EXPECT_EQ(worst[0].scenario + worst[0].setup.model, "gapW-RoI");
    EXPECT_EQ(worst[1].scenario, "street");
    EXPECT_EQ(worst[2].setup.model, "O-Full-0.4");
    EXPECT_TRUE(worstRuns({}, 6).empty());
}

TEST(Pages, FillTheirPlacesAndEscapeWhatTheyAreTold) {
    EXPECT_EQ(filled("a{{x}}b{{y}}", {{"x", "{{y}}"}, {"y", "2"}}), "a{{y}}b2");
    EXPECT_THROW(filled("{{z}}", {}), std::logic_error);
    EXPECT_EQ(scriptText("\"</script>\""), "\"<\\/script>\"");
    EXPECT_EQ(htmlText("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
    EXPECT_EQ(fixed(-0.001, 2), "0.00");
    EXPECT_EQ(fixed(NAN, 2), "-");
    EXPECT_EQ(percentOf(0, 200), "0.0 (0.0 to 1.9)");
    EXPECT_EQ(markdownOf({{"a", "b"}, {{"1", "2"}}}), "| a | b |\n|---|--:|\n| 1 | 2 |\n");
}

Recording smallRecording() {
    Recording recording;
    recording.run = runOf("gap", 1, "O-Full-0.4", "astar", kWon);
    recording.is_same = true;
    recording.ending = "arrived at 9.00 s";
    recording.start_m = {5, 0, 2};
    recording.goal_m = {45, 0, 2};
    RecordedStep step{};
    step.roi_m = {{6, 0, 2}};
    step.rou_m = {{7, 0, 0}, {8, 0, 0}};
    step.motions = {{{{5, 0, 2}, {6, 0, 2}}, false}};
    recording.steps = {step, step};
    recording.track = {{{6, 2, 5}, 3, 0.5}};
    recording.model = {{{6, 0, 2}, 0, 2}, {{9, 0, 2}, 0, 1}};
    recording.model_edge_m = 0.4f;
    return recording;
}

TEST(Replay, APageHoldsCentimetresFromTheStart) {
    const std::string page = replayPage(smallRecording());
    // 1, 2 and 3 m: 100, 200, 300 in 16 bits, 64 00 C8 00 2C 01, by base64 of RFC 4648.
    EXPECT_NE(page.find("\"track\":\"ZADIACwB\""), std::string::npos);
    EXPECT_NE(page.find("\"clearances\":\"MgA=\""), std::string::npos);  // 50: 32 00
    EXPECT_NE(page.find("\"ending\":\"arrived at 9.00 s\""), std::string::npos);
    EXPECT_NE(page.find("\"way_sizes\":[-2]"), std::string::npos);  // not free
    EXPECT_NE(page.find("<title>gap, seed 1, O-Full-0.4, A*, 4.0 m/s: success</title>"),
              std::string::npos);
    EXPECT_NE(replayPage(Recording{}).find("\"steps\":[]"), std::string::npos);
}

TEST(Replay, ASceneHoldsWhatTheModelHeldAtTheEnd) {
    const test::TemporaryFolder folder;
    writeReplayScene(smallRecording(), folder / "a.3Dscene", "a");
    mrpt::opengl::COpenGLScene scene;
    ASSERT_TRUE(scene.loadFromFile((folder / "a.3Dscene").string()));
    const auto voxels = std::dynamic_pointer_cast<mrpt::opengl::COctoMapVoxels>(
        scene.getByName("obstacles of the model"));
    ASSERT_NE(voxels, nullptr);
    EXPECT_EQ(voxels->getVoxelCount(0), 1u);
    const auto roi = std::dynamic_pointer_cast<mrpt::opengl::CPointCloud>(
        scene.getByName("last scan: regions of interest"));
    ASSERT_NE(roi, nullptr);
    EXPECT_EQ(roi->size(), 1u);
    ASSERT_NE(scene.getByName("vehicle"), nullptr);
    EXPECT_EQ(scene.getByName("vehicle")->getPoseX(), 6);
    writeReplayScene(Recording{}, folder / "empty.3Dscene", "empty");
    // Blamed is the file that was asked for, not its temporary name.
    EXPECT_EQ(
        test::messageOf([&] { writeReplayScene({}, folder / "no/a.partial", "no/a.3Dscene"); }),
        "no/a.3Dscene: cannot be written: No such file or directory");
}

/// A triangle that stands at x = 7 m and one that moves from there to 8 m in a step.
TrueScene smallScene() {
    TrueScene scene;
    Shape triangle;
    triangle.addTriangle({0, 0, 0}, {0.005f, 0, 0}, {0, 0, 0.01f});
    scene.shapes = {triangle};
    const Eigen::Affine3f here(Eigen::Translation3f(7, 0, 2)), there(Eigen::Translation3f(8, 0, 2));
    scene.objects = {{Kind::Tree, 1, 0, here}};
    scene.movers = {{0, {here, there}}};
    scene.ground = {{0, 0}, 2, 1, 1, {1.5}};
    return scene;
}

TEST(Replay, APageHoldsShapesOnceAndWhereTheyStandAndMove) {
    Recording recording = smallRecording();
    recording.scene = smallScene();
    const std::string page = replayPage(recording);
    // Half centimetres: nine numbers, of which the fourth is 1 and the ninth 2.
    EXPECT_NE(page.find("\"shapes\":[\"AAAAAAAAAQAAAAAAAAAAAAIA\"]"), std::string::npos);
    EXPECT_NE(
        page.find("{\"shape\":0,\"kind\":\"tree\",\"poses\":[[1.0,0.0,0.0,2.0,0.0,1.0,0.0,0.0,"
                  "0.0,0.0,1.0,0.0]]}"),
        std::string::npos);
    EXPECT_NE(page.find("\"movers\":[{\"shape\":0,\"poses\":\"yAAAAAAAAAAsAQAAAAAAAA==\"}]"),
              std::string::npos);  // 200 0 0 0, 300 0 0 0
    EXPECT_NE(page.find("\"along_x\":1,\"along_y\":1,\"heights\":\"zv8=\""),
              std::string::npos);  // -50: CE FF
}

TEST(Replay, ASceneHoldsWhatTrulyStands) {
    const test::TemporaryFolder folder;
    Recording recording = smallRecording();
    recording.scene = smallScene();
    writeReplayScene(recording, folder / "a.3Dscene", "a");
    mrpt::opengl::COpenGLScene scene;
    ASSERT_TRUE(scene.loadFromFile((folder / "a.3Dscene").string()));
    const auto truth =
        std::dynamic_pointer_cast<mrpt::opengl::CSetOfTriangles>(scene.getByName("true scene"));
    ASSERT_NE(truth, nullptr);
    EXPECT_EQ(truth->getTrianglesCount(), 2u);
}

TEST(TrueScene, HasAllButTheGroundAndMoversWhereTheyAreAtEachTime) {
    const Course course = makeCourse("movers", 3);
    const SceneContent& content = course.scene.content();
    const TrueScene seen = trueSceneOf(course.scene, course.bounds_m, 3);
    EXPECT_EQ(seen.objects.size() + 1, content.objects.size());
    for (const SceneObject& object : seen.objects) {
        EXPECT_NE(object.kind, Kind::Terrain);
        EXPECT_FALSE(seen.shapes[object.shape].triangles.empty());
    }
    ASSERT_EQ(seen.movers.size(), content.movers.size());
    for (std::size_t i = 0; i < seen.movers.size(); ++i) {
        EXPECT_FALSE(seen.shapes[seen.movers[i].shape].triangles.empty());  // rods, too
        for (const double time_s : {0.0, 1.3, 2.99, 3.0}) {
            const Eigen::Affine3f truly = poseOf(content.movers[i], content.terrain, time_s);
            const Eigen::Affine3f drawn = poseAt(seen.movers[i], time_s);
            EXPECT_LT((truly.translation() - drawn.translation()).norm(), 0.03f) << time_s;
            EXPECT_TRUE(truly.linear().isApprox(drawn.linear(), 0.01f)) << time_s;
        }
    }
    const TrueScene::Ground& ground = seen.ground;
    ASSERT_EQ(ground.heights_m.size(), std::size_t(ground.along_x * ground.along_y));
    EXPECT_EQ(ground.heights_m[std::size_t(3 * ground.along_x + 5)],
              content.terrain.height_m(ground.least_m.x() + 10, ground.least_m.y() + 6));
}

TEST(Ending, NamesWhatWasHitHowNearAndWhen) {
    const Course course = makeCourse("movers", 3);
    TrialResult result{};
    result.time_s = 2.5;
    result.outcome = Outcome::Collision;
    const Eigen::Vector3d start_m = course.start_m;
    const double ground_m = course.scene.terrain().height_m(start_m.x(), start_m.y());
    const std::string ground =
        endingOf(course, result, 4, {start_m.x(), start_m.y(), ground_m + 0.2});
    EXPECT_EQ(ground.rfind("hit the ground at 2.50 s: 0.", 0), 0u) << ground;
    EXPECT_NE(ground.find(" m from it to the vehicle's middle"), std::string::npos);

    const SceneMover& person = course.scene.content().movers.front();
    const Eigen::Affine3f pose = poseOf(person, course.scene.terrain(), result.time_s);
    const Eigen::Vector3f above_head = pose * Eigen::Vector3f(0, 0, 2);
    const std::string moving = endingOf(course, result, 4, above_head.cast<double>());
    EXPECT_EQ(moving.rfind("hit something that moves at 2.50 s: 0.2", 0), 0u) << moving;

    result.outcome = Outcome::Success;
    EXPECT_EQ(endingOf(course, result, 4, course.goal_m), "arrived at 2.50 s");
    result.outcome = Outcome::Timeout;
    EXPECT_EQ(endingOf(course, result, 4, start_m), "gave up for lack of progress at 2.50 s");
    EXPECT_EQ(endingOf(course, result, 4, {1000, 0, 2}), "left the course at 2.50 s");
    // Three times 40 m at 4 m/s and 20 s are 50 s; at 2 m/s they are 80 s.
    result.time_s = 50.5;
    EXPECT_EQ(endingOf(course, result, 4, start_m), "ran out of time at 50.50 s");
    EXPECT_EQ(endingOf(course, result, 2, start_m), "gave up for lack of progress at 50.50 s");
    EXPECT_EQ(endingOf(course, result, 4, {1000, 0, 2}), "left the course at 50.50 s");
}

TEST(ChooseRun, FilesOfDifferentRunsHaveDifferentNames) {
    Row run = runOf("forest-0.10", 7, "O-RoI+rays-0.4", "astar", kWon);
    EXPECT_EQ(fileNameOf(run), "forest-0.10-7-O-RoI+rays-0.4-astar-4mps");
    run.setup.speed_m_s = 2.5;
    run.setup.planner = "3dvfh";
    run.setup.pose_error = PoseError::Noise;
    run.setup.latency_scale = 4;
    run.setup.brakes_in_known_space = true;
    EXPECT_EQ(fileNameOf(run),
              "forest-0.10-7-O-RoI+rays-0.4-astar-2.5mps-3dvfh-noise-latency4-brake-known");
}

TEST(ChooseRun, ListsWhatThereIsInstead) {
    const std::vector<Row> runs = threeContenders();
    RunWanted wanted;
    wanted.seed = 77;
    const auto refusal = [&wanted](const std::vector<Row>& among) -> std::string {
        try {
            return chooseRun(among, wanted).scenario;
        } catch (const std::invalid_argument& e) {
            return e.what();
        }
    };
    EXPECT_EQ(refusal(runs),
              "has no run of seed 77; there are:\n  gap: seeds 0-9, 4 m/s, O-Full-0.4,W-RoI, "
              "astar,straight");
    wanted.seed = 3;
    wanted.model = "G-Full";
    EXPECT_EQ(refusal(runs),
              "has no run of seed 3 with these flags; of that seed are:\n  gap: seed 3, 4 m/s, "
              "O-Full-0.4,W-RoI, astar,straight");
    EXPECT_EQ(refusal({}), "has no run of seed 3, nor any other");
}

TEST(ChooseRun, ListsTheFlagsThatTellRunsApart) {
    const Row plain = runOf("gap", 1, "W-RoI", "astar", kWon);
    std::vector<Row> runs(6, plain);
    runs[1].setup.speed_m_s = 0.1 + 0.2;  // needs all of its digits
    runs[2].setup.latency_scale = 4;
    runs[3].setup.planner = "3dvfh";
    runs[4].setup.pose_error = PoseError::Noise;
    runs[5].setup.brakes_in_known_space = true;
    const std::string named = "--scenario gap --model W-RoI --guidance astar --speed ";
    EXPECT_EQ(choiceOf(plain, {plain}), named + "4   # success");
    EXPECT_EQ(choiceOf(runs[2], {runs[2]}), named + "4 --latency-scale 4   # success");
    EXPECT_EQ(choiceOf(plain, {plain, runs[2]}), named + "4 --latency-scale 1   # success");
    EXPECT_EQ(choiceOf(runs[1], runs),
              named +
                  "0.30000000000000004 --planner primitives --pose-error none --latency-scale 1 "
                  "--unknown optimistic   # success");
    EXPECT_EQ(choiceOf(runs[5], {plain, runs[5]}), named + "4 --unknown brake-known   # success");
}

TEST(ChooseRun, TellsWaysOfUnknownSpaceApart) {
    std::vector<Row> runs{runOf("gap", 1, "W-RoI", "astar", kWon),
                          runOf("gap", 1, "W-RoI", "astar", kHit)};
    runs[1].setup.brakes_in_known_space = true;
    RunWanted wanted;
    wanted.seed = 1;
    wanted.unknown = "brake-known";
    EXPECT_TRUE(chooseRun(runs, wanted).setup.brakes_in_known_space);
    wanted.unknown = "optimistic";
    EXPECT_FALSE(chooseRun(runs, wanted).setup.brakes_in_known_space);
}

class ReportCommand : public testing::Test {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) {
        return test::run(HAGEN_OCTOMAP_COMPARE, arguments);
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string folder() const { return folder_.path().string(); }
    void writeRuns(const std::vector<Row>& runs) {
        std::string text = runHeader() + "\n";
        for (const Row& one : runs) text += rowOf(one) + "\n";
        folder_.write("runs.csv", text);
    }
    void expectFailure(const std::vector<std::string>& arguments, int exit_code,
                       const std::string& message) {
        const test::Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
        EXPECT_NE((outcome.err + outcome.out).find(message), std::string::npos)
            << outcome.err << outcome.out;
        EXPECT_FALSE(fs::exists(path("report.html")));
        for (const auto& file : fs::directory_iterator(folder_.path())) {
            EXPECT_NE(file.path().filename().string().substr(0, 7), "replay-") << file.path();
        }
    }
    test::TemporaryFolder folder_;
};

TEST_F(ReportCommand, TellsOfRunsAsPageJsonCsvAndMarkdown) {
    writeRuns(threeContenders());
    const test::Outcome outcome = run({"report", folder(), "--markdown", path("a.md")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(
                  "0 collisions in 10 runs of a scenario still allow a true share of 27.8 %"),
              std::string::npos);
    std::ifstream in(path("summary.json"));
    const auto json = nlohmann::json::parse(in);
    EXPECT_EQ(json["runs"], 30);
    EXPECT_EQ(json["pairings"].size(), 3u);
    EXPECT_NE(test::readFile(path("summary.csv"))
                  .find("gap,4.0000,primitives,none,1.0000,"
                        "optimistic,W-RoI,astar,10,9,0.9000,0.5958,"),
              std::string::npos);
    const std::string page = test::readFile(path("report.html"));
    EXPECT_NE(page.find("90.0 <small>(59.6 to 98.2)</small>"), std::string::npos);
    EXPECT_NE(page.find("no profile.json"), std::string::npos);  // worst runs
    EXPECT_NE(test::readFile(path("a.md")).find("| gap | 90.0 (59.6 to 98.2; 10) |"),
              std::string::npos);
}

TEST_F(ReportCommand, TellsWhatRunsCostAsMeasured) {
    writeRuns(threeContenders());
    folder_.write("measured.csv",
                  "model,filter_p50_ms,filter_p95_ms,update_p50_ms,peak_model_bytes\n"
                  "W-RoI,0.8,9,1.25,2000000\nW-RoI,0.6,9,1.75,4000000\nG-Full,,,14,1\n");
    ASSERT_EQ(run({"report", folder(), "--markdown", path("a.md")}).exit_code, 0);
    const std::string text = test::readFile(path("a.md"));
    EXPECT_NE(text.find("| W-RoI | 2 | 3.00 | 4.00 | 0.70 | 1.50 |"), std::string::npos);
    EXPECT_NE(text.find("| G-Full | 1 | 0.00 | 0.00 | - | 14.00 |"), std::string::npos);
}

TEST_F(ReportCommand, TellsHowMuchOfACampaignIsFlown) {
    // Planned: 2 models, 10 seeds. One is in the table, others in a journal whose end is torn.
    fs::create_directory(path("journal"));
    std::string journal;
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
        journal += rowOf(runOf("gap", seed, "W-RoI", "astar", kWon)) + "\tgap;\n";
    }
    folder_.write("journal/1.csv", journal + "gap,4,W-");
    folder_.write("campaign.json", R"({"flown": [{"scenarios": ["gap"], "seeds": [0, 9],
        "speeds_m_s": [4.0], "models": ["W-RoI", "G-Full"], "guidances": ["astar"],
        "planners": ["primitives"], "pose_errors": ["none"], "latency_scales": [1.0],
        "unknown": "optimistic"}]})");
    const test::Outcome before = run({"report", folder()});  // no runs.csv yet
    ASSERT_EQ(before.exit_code, 0) << before.err;
    EXPECT_NE(before.out.find("Unfinished: 3 of 20 runs planned so far are flown."),
              std::string::npos);
    writeRuns({runOf("gap", 0, "W-RoI", "astar", kWon)});
    const test::Outcome outcome =
        run({"report", folder(), "--overwrite", "--markdown", path("a.md")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("Unfinished: 4 of 20 runs planned so far are flown."),
              std::string::npos);
    for (const char* name : {"report.html", "a.md"}) {
        EXPECT_NE(test::readFile(path(name)).find("4 of 20 runs planned so far"),
                  std::string::npos);
    }
    const std::string text = test::readFile(path("a.md"));
    EXPECT_NE(text.find("| 4 m/s | W-RoI, A* | 4 | 10 |"), std::string::npos) << text;
    EXPECT_NE(text.find("| 4 m/s | G-Full, A* | 0 | 10 |"), std::string::npos);
    std::ifstream in(path("summary.json"));
    EXPECT_EQ(nlohmann::json::parse(in)["missing_runs"], 16);

    std::vector<Row> all;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        all.push_back(runOf("gap", seed, "W-RoI", "astar", kWon));
        all.push_back(runOf("gap", seed, "G-Full", "astar", kWon));
    }
    writeRuns(all);
    EXPECT_EQ(run({"report", folder(), "--overwrite"}).out.find("Unfinished"), std::string::npos);
    folder_.write("campaign.json", "{}");
    EXPECT_NE(run({"report", folder(), "--overwrite"}).err.find("campaign.json: "),
              std::string::npos);
}

TEST(FlownRuns, AreReadAnewWhereTheCampaignEndsMeanwhile) {
    const test::TemporaryFolder folder;
    const Row run = runOf("gap", 1, "W-RoI", "astar", kWon);
    fs::create_directory(folder / "journal");
    // A pipe holds the reader up between its list of journals and the second of them.
    ASSERT_EQ(mkfifo((folder / "journal/0.csv").c_str(), 0600), 0);
    folder.write("journal/1.csv", rowOf(run) + "\tgap;\n");
    std::thread campaign([&] {
        const std::ofstream pipe(folder / "journal/0.csv");  // waits for the reader
        folder.write("runs.csv", runHeader() + "\n" + rowOf(run) + "\n");
        fs::remove_all(folder / "journal");
    });
    FlownRuns flown;
    EXPECT_NO_THROW(flown = readFlownRuns(folder.path()));
    campaign.join();
    EXPECT_EQ(flown.runs.size(), 1u);
}

TEST(FlownRuns, OfAJournalThatCannotBeReadAreAnError) {
    const test::TemporaryFolder folder;
    fs::create_directory(folder / "journal");
    fs::create_symlink("nowhere", folder / "journal/0.csv");
    EXPECT_NE(test::messageOf([&] { readFlownRuns(folder.path()); }).find("0.csv: cannot be read"),
              std::string::npos);
}

TEST_F(ReportCommand, LeavesAnEarlierReportAloneUnlessTold) {
    writeRuns(threeContenders());
    folder_.write("summary.csv", "mine");
    expectFailure({"report", folder()}, 1, "summary.csv exists; give --overwrite");
    EXPECT_EQ(test::readFile(path("summary.csv")), "mine");
    EXPECT_EQ(run({"report", folder(), "--overwrite"}).exit_code, 0);
}

TEST_F(ReportCommand, NamesWhatIsMissing) {
    expectFailure({"report", path("nowhere")}, 1, "nowhere: no such folder");
    for (const char* command : {"report", "replay"}) {
        expectFailure(
            {command, folder(), command == std::string("replay") ? "--seed=1" : "--worst=6"}, 1,
            folder() + ": holds no campaign; give a folder of octomap-compare");
    }
    writeRuns({});
    expectFailure({"report", folder()}, 1, folder() + ": no run is finished yet; fly some");
    folder_.write("runs.csv", "");
    expectFailure({"report", folder()}, 1, "runs.csv:1: is empty");
    expectFailure({"report"}, 2, "DIR is required");
    // A campaign that has only begun, and one with a plan that this version does not know.
    fs::remove(path("runs.csv"));
    folder_.write("campaign.json", R"({"flown": []})");
    expectFailure({"report", folder()}, 1, folder() + ": no run is finished yet");
    expectFailure({"replay", folder(), "--seed", "1"}, 2,
                  folder() + ": has no run of seed 1, nor any other");
    folder_.write("campaign.json", R"({"flown": [{"scenarios": ["moon"], "seeds": [0, 9],
        "speeds_m_s": [4.0], "models": ["W-RoI"], "guidances": ["astar"],
        "planners": ["primitives"], "pose_errors": ["none"], "latency_scales": [1.0],
        "unknown": "optimistic"}]})");
    expectFailure({"report", folder()}, 1, "was it written by another version");
}

TEST_F(ReportCommand, NamesTheLineThatIsBroken) {
    folder_.write("runs.csv", runHeader() + "\n" + rowOf(threeContenders()[0]) + "\ngap,1\n");
    expectFailure({"report", folder()}, 1, "runs.csv:3: 2 fields, not 24");
    writeRuns(threeContenders());
    folder_.write("memory.csv", "model,path_m,bytes\nW-RoI,far,1\n");
    expectFailure({"report", folder()}, 1, "memory.csv:2: not model,path_m,bytes");
    folder_.write("memory.csv", "model,path_m,bytes\n");
    folder_.write("measured.csv", "model,peak_model_bytes\nW-RoI,2e6\nW-RoI,much\n");
    expectFailure({"report", folder()}, 1, "measured.csv:3: \"much\" is no number");
    folder_.write("measured.csv", "model,peak_model_bytes\n");
    folder_.write("profile.json", "{");
    expectFailure({"report", folder()}, 1, "profile.json");
}

TEST_F(ReportCommand, SaysWhereItCannotWrite) {
    writeRuns(threeContenders());
    fs::create_directory(path("report.html"));
    const test::Outcome outcome = run({"report", folder(), "--overwrite"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("report.html"), std::string::npos) << outcome.err;
    fs::remove(path("report.html"));
    expectFailure({"report", folder(), "--markdown", path("no/a.md")}, 1, path("no"));
    if (fs::exists("/proc/version")) {
        fs::remove(path("runs.csv"));
        expectFailure({"report", "/proc"}, 1, "/proc: holds no campaign");
    }
}

TEST_F(ReportCommand, AnUnknownCommandIsToldWhichThereAre) {
    const std::string there_are =
        "there are closedloop, merge, calibrate, openloop, report, replay";
    expectFailure({"fly"}, 2, "'fly' is no command; " + there_are);
    expectFailure({}, 2, "no command is given; " + there_are);
}

TEST_F(ReportCommand, ALineOfTheListChoosesItsRun) {
    std::vector<Row> runs(3, runOf("gap", 1, "W-RoI", "astar", kWon));
    runs[1].setup.speed_m_s = 6;
    runs[2].setup.speed_m_s = 6;
    runs[2].setup.latency_scale = 4;
    runs[2].setup.brakes_in_known_space = true;
    writeRuns(runs);
    const std::string list = run({"replay", folder(), "--seed", "1"}).err;
    for (const Row& one : runs) {
        const std::string line = choiceOf(one, runs);
        ASSERT_NE(list.find("\n  " + line), std::string::npos) << list;
        std::vector<std::string> arguments{"replay", folder(), "--seed", "1"};
        std::istringstream words(line);
        for (std::string word; words >> word && word != "#";) arguments.push_back(word);
        expectFailure(arguments, 1, "profile.json");  // chosen; it cannot be flown here
    }
}

TEST_F(ReportCommand, AReplayNeedsOneRun) {
    writeRuns(threeContenders());
    expectFailure({"replay", folder(), "--seed", "77"}, 2, "no run of seed 77");
    expectFailure({"replay", folder(), "--seed", "1", "--model", "G-Full"}, 2, "no run of seed 1");
    expectFailure({"replay", folder(), "--seed", "1"}, 2,
                  "--scenario gap --model W-RoI --guidance straight --speed 4   # timeout\n");
    expectFailure({"replay", folder()}, 2, "--seed is required");
    expectFailure({"replay", folder(), "--seed", "1", "--unknown", "nonsense"}, 2,
                  "{optimistic,brake-known}");
    for (const char* spelling : {"brake-known", "brake_known"}) {
        expectFailure({"replay", folder(), "--seed", "1", "--unknown", spelling}, 2,
                      "no run of seed 1 with these flags");
    }
    expectFailure({"replay", folder(), "--seed", "1", "--model", "O-Full-0.4"}, 1, "profile.json");
}

}  // namespace
}  // namespace hagen
