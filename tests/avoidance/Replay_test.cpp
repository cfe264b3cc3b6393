// Contents of a replay: the recording, the true scene and the ending.
#include <gmock/gmock.h>

#include "SampleRuns.h"
#include "avoidance/flights/Calibration.h"
#include "avoidance/replays/FlightRecording.h"
#include "avoidance/replays/Replay.h"
#include "support/Program.h"
#include "support/ReadView.h"

namespace hagen {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using namespace test;

avoidance::FlightRecording smallRecording() {
    avoidance::FlightRecording recording;
    recording.run = test::runOf("gap", 1, "O-Full-0.4", "astar", kWon);
    recording.is_same = true;
    recording.ending = "reached the goal at 9.00 s";
    recording.start_m = {5, 0, 2};
    recording.goal_m = {45, 0, 2};
    avoidance::RecordedStep step{};
    step.roi_m = {{6, 0, 2}};
    step.rou_m = {{7, 0, 0}, {8, 0, 0}};
    step.motions = {{{{5, 0, 2}, {6, 0, 2}}, false}};
    recording.steps = {step, step};
    recording.track = {{{6, 2, 5}, 3, 0.5}};
    recording.model = {{{6, 0, 2}, 0, 2}, {{9, 0, 2}, 0, 1}};
    recording.model_edge_m = 0.4f;
    return recording;
}

TEST(Replay, PageStoresCentimetresFromStart) {
    const std::string page = avoidance::replayPage(smallRecording());
    EXPECT_THAT(page, HasSubstr("<title>gap, seed 1, OctoMap 0.4 m, A*, 4 m/s: success</title>"));
    const auto data = test::viewData(page);
    EXPECT_EQ(data["notes"][0]["text"], "Reached the goal at 9.00 s");
    auto flight = test::viewArrays(data["flight"]);
    EXPECT_THAT(flight["track"], ElementsAre(100, 200, 300));
    EXPECT_THAT(flight["clearances"], ElementsAre(50));
    EXPECT_THAT(flight["lives"], ElementsAre(0, 2, 0, 1));
    auto frame = test::viewArrays(data["frames"][0]);
    EXPECT_THAT(frame["xyz"], ElementsAre(100, 0, 0, 200, 0, -200, 300, 0, -200));
    EXPECT_THAT(frame["label"], ElementsAre(2, 1, 1));
    EXPECT_THAT(frame["way_sizes"], ElementsAre(-2));  // negative: not free
    EXPECT_EQ(test::viewData(avoidance::replayPage({}))["frames"].size(), 0u);
}

TEST(Replay, RecordingIsInterruptible) {
    struct Interrupted {};
    const avoidance::Run run = test::runOf("gap", 1, "W-RoI", "straight", test::kWon);
    const auto profile = avoidance::constantProfile(1);
    int steps = 0;
    const auto endAtTheThird = [&] {
        if (++steps == 3) throw Interrupted();
    };
    EXPECT_THROW(avoidance::record(run, profile, {}, endAtTheThird), Interrupted);
}

/// A triangle at x = 7 m, and another that moves from 7 to 8 m in one step.
avoidance::TrueScene smallScene() {
    avoidance::TrueScene scene;
    simulation::Shape triangle;
    triangle.addTriangle({0, 0, 0}, {0.005f, 0, 0}, {0, 0, 0.01f});
    scene.shapes = {triangle};
    const Eigen::Affine3f here(Eigen::Translation3f(7, 0, 2)), there(Eigen::Translation3f(8, 0, 2));
    scene.objects = {{simulation::ObjectClass::Tree, 1, 0, here}};
    scene.movers = {{0, {here, there}}};
    scene.ground = {{0, 0}, 2, 1, 1, {1.5}};
    return scene;
}

TEST(Replay, PageStoresShapesAndPoses) {
    avoidance::FlightRecording recording = smallRecording();
    recording.scene = smallScene();
    const std::string page = avoidance::replayPage(recording);
    const auto data = test::viewData(page);
    const auto& scene = data["flight"]["scene"];
    auto flight = test::viewArrays(data["flight"]);
    EXPECT_THAT(flight[scene["shapes"][0]], ElementsAre(0, 0, 0, 1, 0, 0, 0, 0, 2));  // half cm
    EXPECT_EQ(scene["things"][0]["kind"], "tree");
    EXPECT_EQ(scene["things"][0]["poses"][0].get<std::vector<double>>(),
              (std::vector<double>{1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0}));
    EXPECT_THAT(flight[scene["movers"][0]["poses"]], ElementsAre(200, 0, 0, 0, 300, 0, 0, 0));
    EXPECT_EQ(scene["ground"]["along_x"], 1);
    EXPECT_THAT(flight["ground"], ElementsAre(-50));
}

TEST(TrueScene, MatchesCourse) {
    const avoidance::Course course = avoidance::makeCourse("movers", 3);
    const simulation::SceneContent& content = course.scene.content();
    const avoidance::TrueScene seen = avoidance::trueSceneOf(course.scene, course.bounds_m, 3);
    EXPECT_EQ(seen.objects.size() + 1, content.objects.size());
    for (const simulation::SceneObject& object : seen.objects) {
        EXPECT_NE(object.kind, simulation::ObjectClass::Terrain);
        EXPECT_FALSE(seen.shapes[object.shape].triangles.empty());
    }
    ASSERT_EQ(seen.movers.size(), content.movers.size());
    for (std::size_t i = 0; i < seen.movers.size(); ++i) {
        EXPECT_FALSE(seen.shapes[seen.movers[i].shape].triangles.empty());  // even for rods
        for (const double time_s : {0.0, 1.3, 2.99, 3.0}) {
            const Eigen::Affine3f truly =
                simulation::poseOf(content.movers[i], content.terrain, time_s);
            const Eigen::Affine3f drawn = avoidance::poseAt(seen.movers[i], time_s);
            EXPECT_LT((truly.translation() - drawn.translation()).norm(), 0.03f) << time_s;
            EXPECT_TRUE(truly.linear().isApprox(drawn.linear(), 0.01f)) << time_s;
        }
    }
    const avoidance::TrueScene::Ground& ground = seen.ground;
    ASSERT_EQ(ground.heights_m.size(), std::size_t(ground.along_x * ground.along_y));
    EXPECT_EQ(ground.heights_m[std::size_t(3 * ground.along_x + 5)],
              content.terrain.height_m(ground.min_m.x() + 10, ground.min_m.y() + 6));
}

TEST(Ending, DescribesOutcome) {
    const avoidance::Course course = avoidance::makeCourse("movers", 3);
    avoidance::TrialResult result{};
    result.time_s = 2.5;
    result.outcome = kHit;
    const Eigen::Vector3d start_m = course.start_m;
    const double ground_m = course.scene.terrain().height_m(start_m.x(), start_m.y());
    const std::string ground =
        avoidance::endingOf(course, result, 4, {start_m.x(), start_m.y(), ground_m + 0.2});
    EXPECT_EQ(ground.rfind("hit the ground at 2.50 s: 0.", 0), 0u) << ground;
    EXPECT_THAT(ground, HasSubstr(" m from the vehicle's centre"));

    const simulation::MovingObstacle& person = course.scene.content().movers.front();
    const Eigen::Affine3f pose = simulation::poseOf(person, course.scene.terrain(), result.time_s);
    const Eigen::Vector3f above_head = pose * Eigen::Vector3f(0, 0, 2);
    const std::string moving = avoidance::endingOf(course, result, 4, above_head.cast<double>());
    EXPECT_EQ(moving.rfind("hit a moving object at 2.50 s: 0.2", 0), 0u) << moving;

    result.outcome = kWon;
    EXPECT_EQ(avoidance::endingOf(course, result, 4, course.goal_m), "reached the goal at 2.50 s");
    result.outcome = kLate;
    EXPECT_EQ(avoidance::endingOf(course, result, 4, start_m),
              "gave up for lack of progress at 2.50 s");
    EXPECT_EQ(avoidance::endingOf(course, result, 4, {1000, 0, 2}), "left the course at 2.50 s");
    // The limit is three times the time for 40 m, plus 20 s: 50 s at 4 m/s, 80 s at 2 m/s.
    result.time_s = 50.5;
    EXPECT_EQ(avoidance::endingOf(course, result, 4, start_m), "ran out of time at 50.50 s");
    EXPECT_EQ(avoidance::endingOf(course, result, 2, start_m),
              "gave up for lack of progress at 50.50 s");
    EXPECT_EQ(avoidance::endingOf(course, result, 4, {1000, 0, 2}), "left the course at 50.50 s");
}

}  // namespace
}  // namespace hagen
