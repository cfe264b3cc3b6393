#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include <hagen/simulation/Flight.h>
#include <hagen/simulation/Scenarios.h>

#include <map>
#include <set>
#include <stdexcept>

namespace hagen::simulation {
namespace {

using testing::HasSubstr;

std::set<ObjectClass> kindsOf(const Scene& scene) {
    std::set<ObjectClass> kinds;
    for (const SceneObject& object : scene.content().objects) kinds.insert(object.kind);
    if (!scene.content().movers.empty()) kinds.insert(ObjectClass::Mover);
    return kinds;
}

const std::map<std::string, std::set<ObjectClass>>& expectedKinds() {
    static const std::set<ObjectClass> wood{ObjectClass::Canopy, ObjectClass::Tree,
                                            ObjectClass::Wall};
    static const std::map<std::string, std::set<ObjectClass>> expected{
        {"orchard",
         {ObjectClass::Canopy, ObjectClass::Tree, ObjectClass::Pole, ObjectClass::Vehicle}},
        {"field", {ObjectClass::Canopy, ObjectClass::Tree, ObjectClass::Pole}},
        {"forest-0.02", wood},
        {"forest-0.05", wood},
        {"forest-0.10", wood},
        {"wires", {ObjectClass::Canopy, ObjectClass::Tree, ObjectClass::Pole, ObjectClass::Wire}},
        {"gap", {ObjectClass::Canopy, ObjectClass::Tree, ObjectClass::Wall}},
        {"street",
         {ObjectClass::Canopy, ObjectClass::Tree, ObjectClass::Pole, ObjectClass::Building,
          ObjectClass::Vehicle, ObjectClass::Wall}},
        {"terrain", {ObjectClass::Canopy, ObjectClass::Tree, ObjectClass::Wall}},
        {"u-trap", {ObjectClass::Canopy, ObjectClass::Tree, ObjectClass::Wall}},
        {"movers", {ObjectClass::Canopy, ObjectClass::Tree, ObjectClass::Mover}},
        {"hall", {ObjectClass::Wall, ObjectClass::Pole}}};
    return expected;
}

class EachScenario : public testing::TestWithParam<std::string> {};

TEST_P(EachScenario, HasClassesAndObjectNumbers) {
    const Scene scene = makeScene(GetParam(), 1);
    std::set<ObjectClass> kinds = kindsOf(scene);
    EXPECT_EQ(kinds.count(ObjectClass::Terrain), 1u);
    for (const ObjectClass kind : expectedKinds().at(GetParam())) {
        EXPECT_EQ(kinds.count(kind), 1u) << nameOf(kind);
    }
    std::set<int> numbers;
    for (const SceneObject& object : scene.content().objects) {
        if (labelOf(object.kind) == Label::Rou) {
            EXPECT_EQ(object.number, 0);
        } else {
            EXPECT_TRUE(numbers.insert(object.number).second) << object.number;
        }
    }
    EXPECT_EQ(numbers.count(0), 0u);
}

/// No obstacle is within 0.5 m of the path at any flight altitude.
TEST_P(EachScenario, PathIsFree) {
    const Scene scene = makeScene(GetParam(), 2);
    std::vector<Ray> rays;
    for (double way_m = 0; way_m < scene.path().length_m(); way_m += 0.25) {
        const Eigen::Vector2d at = scene.path().at(way_m);
        for (const double altitude_m : {1.2, 2.0, 3.0, 4.5, 7.0, 10.0, 15.0}) {
            const double z = scene.terrain().height_m(at.x(), at.y()) + altitude_m;
            for (int i = 0; i < 6; ++i) {
                const double angle = i * kPi / 3;
                const Eigen::Vector3d aside(std::cos(angle), std::sin(angle), 0);
                rays.push_back(
                    {Eigen::Vector3d(at.x(), at.y(), z).cast<float>(), aside.cast<float>(), 0});
            }
        }
    }
    std::vector<RayHit> hits;
    for (const double time_s : {0.0, 13.0, 57.0}) {
        scene.snapshotOver(time_s, 0.1).cast(rays, 0.5f, hits);
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const bool is_solid = labelOf(hits[i].kind) == Label::Roi;
            ASSERT_FALSE(is_solid)
                << nameOf(hits[i].kind) << " at " << rays[i].origin_m.transpose();
        }
    }
}

TEST_P(EachScenario, TakeOffStaysAboveSoil) {
    const Scene scene = makeScene(GetParam(), 2);
    FlightSettings take_off;
    take_off.altitude_m = 0.2;
    const Flight flight(scene.terrain(), scene.path(), take_off, 2);
    std::vector<Ray> rays;  // down, from 5 m above the sensor
    for (double time_s = 0; time_s < 100; time_s += 0.05) {
        const Eigen::Vector3d at = flight.at(time_s).position_m + 5 * Eigen::Vector3d::UnitZ();
        rays.push_back({at.cast<float>(), -Eigen::Vector3f::UnitZ(), 0});
    }
    std::vector<RayHit> hits;
    scene.snapshotOver(0, 0.1).cast(rays, 20, hits);
    float lowest = 9;
    for (const RayHit& hit : hits) {
        if (hit.kind == ObjectClass::Terrain) lowest = std::min(lowest, hit.range_m - 5);
    }
    EXPECT_GT(lowest, 0.03f);
}

INSTANTIATE_TEST_SUITE_P(All, EachScenario, testing::ValuesIn(scenarioNames()),
                         [](const auto& name) {
                             std::string words;
                             for (const char c : name.param)
                                 words += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                             return words;
                         });

TEST(ScenariosTest, DependOnSeed) {
    const auto placesOf = [](std::uint64_t seed) {
        std::vector<float> places;
        const Scene scene = makeScene("wires", seed);
        for (const SceneObject& object : scene.content().objects) {
            for (int i = 0; i < 16; ++i) places.push_back(object.pose.matrix().data()[i]);
        }
        for (const Shape& shape : scene.content().shapes) {
            for (const Eigen::Vector3f& v : shape.vertices_m) places.push_back(v.z());
        }
        return places;
    };
    const std::vector<float> one = placesOf(1);
    EXPECT_EQ(one, placesOf(1));
    EXPECT_NE(one, placesOf(2));
}

TEST(ScenariosTest, DenseForestsHaveMoreTrees) {
    const auto trees = [](const std::string& name) {
        int count = 0;
        const Scene scene = makeScene(name, 4);
        for (const SceneObject& object : scene.content().objects)
            count += object.kind == ObjectClass::Tree;
        return count;
    };
    EXPECT_GT(trees("forest-0.05"), 1.8 * trees("forest-0.02"));
    EXPECT_GT(trees("forest-0.10"), 1.6 * trees("forest-0.05"));
}

/// Both sides of a trap start at the ends of its back wall and are parallel.
TEST(ScenariosTest, TrapsAreOpenOnOneSide) {
    const Scene scene = makeScene("u-trap", 1);
    std::vector<Eigen::Vector2d> middles_m;  // in the order back, one side, other side ...
    for (const SceneObject& object : scene.content().objects) {
        if (object.kind != ObjectClass::Wall) continue;
        const std::vector<Eigen::Vector3f>& vertices_m =
            scene.content().shapes[object.shape].vertices_m;
        Eigen::Vector3f sum_m = Eigen::Vector3f::Zero();
        for (const Eigen::Vector3f& vertex_m : vertices_m) sum_m += vertex_m;
        middles_m.emplace_back(
            (sum_m / static_cast<float>(vertices_m.size())).head<2>().cast<double>());
    }
    ASSERT_EQ(middles_m.size(), 4u * 3);
    for (std::size_t back = 0; back < middles_m.size(); back += 3) {
        const Eigen::Vector2d one_m = middles_m[back + 1] - middles_m[back],
                              other_m = middles_m[back + 2] - middles_m[back];
        EXPECT_GT((one_m + other_m).norm(), 3);  // length of the sides
        EXPECT_GT((one_m - other_m).norm(), 5);  // length of the back
        EXPECT_NEAR((one_m + other_m).dot(one_m - other_m), 0, 1e-3);
    }
}

TEST(ScenariosTest, RejectsUnknownNames) {
    for (const std::string& name : scenarioNames()) {
        EXPECT_THAT([] { makeScene("jungle", 1); },
                    testing::ThrowsMessage<std::invalid_argument>(
                        testing::AllOf(HasSubstr("'jungle'"), HasSubstr(name))));
    }
}

}  // namespace
}  // namespace hagen::simulation
