#include "filter/RoiComponents.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/InstructionSets.h"
#include "support/Random.h"

namespace hagen {
namespace {

Image<std::int32_t> numbered(const Image<float>& depth_m, const Image<Label>& labels,
                             float max_gap_m = 1.0f) {
    static ComponentsWorkspace work;  // reused, as in a filter
    Image<std::int32_t> components;
    numberRoiComponents(depth_m, labels, max_gap_m, components, work);
    return components;
}

/// The definition: flood fill, starting at the closest pixel without a number.
Image<std::int32_t> floodedNumbers(const Image<float>& depth_m, const Image<Label>& labels,
                                   float max_gap_m) {
    const int rows = static_cast<int>(depth_m.rows()), columns = static_cast<int>(depth_m.cols());
    Image<std::int32_t> components = Image<std::int32_t>::Zero(rows, columns);
    std::vector<int> nearest_first;
    for (int pixel = 0; pixel < rows * columns; ++pixel) {
        if (labels.data()[pixel] == Label::Roi) nearest_first.push_back(pixel);
    }
    std::stable_sort(nearest_first.begin(), nearest_first.end(),
                     [&](int a, int b) { return depth_m.data()[a] < depth_m.data()[b]; });
    std::int32_t number = 0;
    for (const int closest : nearest_first) {
        if (components.data()[closest] != 0) continue;
        components.data()[closest] = ++number;
        std::vector<int> queue{closest};
        for (std::size_t next = 0; next < queue.size(); ++next) {
            const int row = queue[next] % rows, column = queue[next] / rows;
            forEachOf4Neighbours(row, column, rows, columns, [&](int to_row, int to_column) {
                if (labels(to_row, to_column) != Label::Roi) return;
                if (components(to_row, to_column) != 0) return;
                const float gap_m = std::abs(depth_m(to_row, to_column) - depth_m(row, column));
                if (!(gap_m < max_gap_m)) return;
                components(to_row, to_column) = number;
                queue.push_back(to_column * rows + to_row);
            });
        }
    }
    return components;
}

TEST(RoiComponents, MatchPlainFloodOnEveryInstructionSet) {
    test::Random random(20);
    for (int round = 0; round < 150; ++round) {
        const int rows = random.chance(0.5) ? random.whole(2, 16) : random.whole(17, 200);
        const int columns = random.chance(0.3) ? random.whole(1, 3) : random.whole(4, 90);
        Image<float> depth_m = random.image(rows, columns, 1.0f, 5.0f, 0.1);
        if (random.chance(0.4)) depth_m = depth_m.round();  // equal depths
        const double share = random.real(0.0f, 1.0f);
        Image<Label> labels(rows, columns);
        for (int pixel = 0; pixel < depth_m.size(); ++pixel) {
            labels.data()[pixel] = !hasValue(depth_m.data()[pixel]) ? Label::Unclassified
                                   : random.chance(share)           ? Label::Roi
                                                                    : Label::Rou;
        }
        const float max_gap_m = random.real(0.0f, 4.0f);
        const auto expected = floodedNumbers(depth_m, labels, max_gap_m);
        forEachInstructionSet([&](const std::string& name) {
            const auto found = numbered(depth_m, labels, max_gap_m);
            ASSERT_TRUE((found == expected).all()) << name << " " << rows << " x " << columns;
        });
        if (HasFatalFailure()) return;
    }
}

TEST(RoiComponents, NearestObstacleIsFirst) {
    Image<float> depth_m(1, 7);
    depth_m << 9.0f, 9.1f, 5.0f, 5.1f, 4.9f, 12.0f, 12.0f;
    Image<Label> labels = Image<Label>::Constant(1, 7, Label::Roi);
    labels(0, 5) = labels(0, 6) = Label::Rou;
    Image<std::int32_t> expected(1, 7);
    expected << 2, 2, 1, 1, 1, 0, 0;
    EXPECT_TRUE((numbered(depth_m, labels) == expected).all());
}

TEST(RoiComponents, WrapInAzimuthAndAreNotDiagonal) {
    Image<float> depth_m = Image<float>::Constant(2, 6, 5.0f);
    Image<Label> labels = Image<Label>::Constant(2, 6, Label::Rou);
    labels(0, 0) = labels(0, 5) = labels(1, 1) = Label::Roi;
    const auto components = numbered(depth_m, labels);
    EXPECT_EQ(components(0, 0), components(0, 5));
    EXPECT_NE(components(0, 0), components(1, 1));
}

TEST(RoiComponents, WithoutRoiAreEmpty) {
    const auto depth_m = Image<float>::Constant(4, 5, 2.0f);
    EXPECT_TRUE((numbered(depth_m, Image<Label>::Constant(4, 5, Label::Rou)) == 0).all());
}

}  // namespace
}  // namespace hagen
