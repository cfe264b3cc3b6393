#include <gtest/gtest.h>
#include <hagen/simulation/Kind.h>

#include <set>

namespace hagen::simulation {
namespace {

TEST(KindTest, EveryKindHasANumberAndANameOfItsOwn) {
    std::set<std::string> names;
    std::set<int> numbers;
    for (const Kind kind : allKinds()) {
        names.insert(nameOf(kind));
        numbers.insert(static_cast<int>(kind));
    }
    EXPECT_EQ(names.size(), 11u);
    EXPECT_EQ(*numbers.begin(), 1);
    EXPECT_EQ(*numbers.rbegin(), 11);
    EXPECT_EQ(nameOf(Kind::Wire), "wire");
}

TEST(KindTest, GroundIsRouAndObstaclesAreRoiAndTheVehicleItselfIsNeither) {
    EXPECT_EQ(labelOf(Kind::Terrain), Label::Rou);
    EXPECT_EQ(labelOf(Kind::Canopy), Label::Rou);
    EXPECT_EQ(labelOf(Kind::Wire), Label::Roi);
    EXPECT_EQ(labelOf(Kind::Mover), Label::Roi);
    EXPECT_EQ(labelOf(Kind::Dust), Label::Unclassified);
    EXPECT_EQ(labelOf(Kind::Airframe), Label::Unclassified);
    EXPECT_EQ(labelOf(Kind::None), Label::Unclassified);
}

}  // namespace
}  // namespace hagen::simulation
