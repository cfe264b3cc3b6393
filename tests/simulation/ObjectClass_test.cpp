#include <gtest/gtest.h>
#include <hagen/simulation/ObjectClass.h>

#include <set>

namespace hagen::simulation {
namespace {

TEST(ObjectClassTest, NamesAreUnique) {
    std::set<std::string> names;
    std::set<int> numbers;
    for (const ObjectClass kind : allKinds()) {
        names.insert(nameOf(kind));
        numbers.insert(static_cast<int>(kind));
    }
    EXPECT_EQ(names.size(), 11u);
    EXPECT_EQ(*numbers.begin(), 1);
    EXPECT_EQ(*numbers.rbegin(), 11);
    EXPECT_EQ(nameOf(ObjectClass::Wire), "wire");
}

TEST(ObjectClassTest, ClassesHaveLabels) {
    EXPECT_EQ(labelOf(ObjectClass::Terrain), Label::Rou);
    EXPECT_EQ(labelOf(ObjectClass::Canopy), Label::Rou);
    EXPECT_EQ(labelOf(ObjectClass::Wire), Label::Roi);
    EXPECT_EQ(labelOf(ObjectClass::Mover), Label::Roi);
    EXPECT_EQ(labelOf(ObjectClass::Dust), Label::Unclassified);
    EXPECT_EQ(labelOf(ObjectClass::Airframe), Label::Unclassified);
    EXPECT_EQ(labelOf(ObjectClass::None), Label::Unclassified);
}

}  // namespace
}  // namespace hagen::simulation
