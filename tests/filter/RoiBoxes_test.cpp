#include "filter/RoiBoxes.h"
#include <gtest/gtest.h>

#include "support/PointScan.h"

namespace hagen {
namespace {

std::vector<RoiBox> boxesOf(const std::vector<Eigen::Vector3f>& points_m,
                            const std::vector<std::int32_t>& component) {
    LabelledReturns returns;
    returns.component = component;
    return boxRoiComponents(test::scanOf(sensorModel("VLP-16"), points_m), returns);
}

TEST(RoiBoxes, BoxContainsComponentReturns) {
    const auto boxes = boxesOf({{6, 8, 0}, {3, 4, 0}, {3, -4, 0}, {7, 6, 1}, {6, 8, -2}, {0, 1, 0}},
                               {2, 1, 1, 2, 2, 0});
    ASSERT_EQ(boxes.size(), 2u);
    EXPECT_EQ(boxes[0].component, 1);
    EXPECT_EQ(boxes[0].returns, 2u);
    EXPECT_FLOAT_EQ(boxes[0].nearest_m, 5);
    EXPECT_EQ(boxes[0].extents_m.min(), Eigen::Vector3f(3, -4, 0));
    EXPECT_EQ(boxes[0].extents_m.max(), Eigen::Vector3f(3, 4, 0));
    EXPECT_EQ(boxes[1].component, 2);
    EXPECT_EQ(boxes[1].returns, 3u);
    EXPECT_FLOAT_EQ(boxes[1].nearest_m, std::sqrt(86.0f));
    EXPECT_EQ(boxes[1].extents_m.min(), Eigen::Vector3f(6, 6, -2));
    EXPECT_EQ(boxes[1].extents_m.max(), Eigen::Vector3f(7, 8, 1));
}

TEST(RoiBoxes, LoneReturnHasNoExtent) {
    const auto boxes = boxesOf({{6, 8, 0.5f}}, {1});
    ASSERT_EQ(boxes.size(), 1u);
    EXPECT_EQ(boxes[0].extents_m.sizes(), Eigen::Vector3f::Zero());
    EXPECT_FALSE(boxes[0].extents_m.isEmpty());
}

RoiBox box(std::int32_t component, std::uint32_t returns, float size_m) {
    const Eigen::Vector3f corner = Eigen::Vector3f::Constant(size_m);
    return {component, returns, 1.0f, {-corner, corner}};
}

std::vector<std::int32_t> drawn(const std::vector<RoiBox>& boxes) {
    std::vector<std::int32_t> components;
    for (const RoiBox& box : boxesToDraw(boxes)) components.push_back(box.component);
    return components;
}

TEST(RoiBoxes, DrawsLargeOuterBoxes) {
    using Components = std::vector<std::int32_t>;
    EXPECT_EQ(drawn({box(1, 30, 1), box(2, 29, 9)}), Components{1});
    EXPECT_EQ(drawn({box(1, 30, 1), box(2, 30, 2), box(3, 30, 0.5f)}), Components{2});
    RoiBox aside = box(2, 30, 1);
    aside.extents_m.translate(Eigen::Vector3f(0.5f, 0, 0));
    EXPECT_EQ(drawn({box(1, 30, 1), aside}), (Components{1, 2}));
    EXPECT_EQ(drawn({}), Components{});
}

}  // namespace
}  // namespace hagen
