#include "filter/paper/Labelling.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>

#include <cmath>
#include <string>

#include "support/InstructionSets.h"
#include "support/Random.h"

namespace hagen {
namespace {

constexpr float kNoGate_rad = static_cast<float>(kPi / 2);

Image<Label> labelled(const Image<float>& depth_m, const Image<float>& angle_rad, float beta_rad,
                      Seeds seeds = Seeds::Lowest, float seed_gate_rad = kNoGate_rad) {
    static LabellingWorkspace work;  // reused, as in a filter
    Image<Label> labels;
    labelRegions(depth_m, angle_rad, beta_rad, seeds, seed_gate_rad, labels, work);
    return labels;
}

/// Reference implementation without a queue: propagates labels until nothing changes.
Image<Label> slowLabels(const Image<float>& depth_m, const Image<float>& angle_rad, float beta_rad,
                        Seeds seeds) {
    const int rows = static_cast<int>(depth_m.rows()), columns = static_cast<int>(depth_m.cols());
    const bool ground = seeds == Seeds::Lowest;
    Image<bool> reached = Image<bool>::Constant(rows, columns, false);
    for (int column = 0; column < columns; ++column) {
        int lowest = -1, highest = -1, nearest = -1;
        for (int row = rows - 1; row >= 0; --row) {
            if (hasValue(depth_m(row, column))) lowest = row;
            if (!hasValue(angle_rad(row, column)) || !hasValue(depth_m(row, column))) continue;
            if (highest < 0) highest = row;
            if (nearest < 0 || depth_m(row, column) <= depth_m(nearest, column)) nearest = row;
        }
        if (ground && lowest >= 0 && hasValue(angle_rad(lowest, column)))
            reached(lowest, column) = true;
        if (!ground && highest >= 0) reached(highest, column) = reached(nearest, column) = true;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int column = 0; column < columns; ++column) {
            for (int row = 0; row < rows; ++row) {
                if (reached(row, column) || !hasValue(angle_rad(row, column))) continue;
                const auto from = [&](int other_row, int other_column) {
                    if (other_row < 0 || other_row >= rows) return false;
                    other_column = (other_column + columns) % columns;
                    return reached(other_row, other_column) &&
                           std::abs(angle_rad(other_row, other_column) - angle_rad(row, column)) <
                               beta_rad;
                };
                if (from(row - 1, column) || from(row + 1, column) || from(row, column - 1) ||
                    from(row, column + 1)) {
                    reached(row, column) = changed = true;
                }
            }
        }
    }
    Image<Label> labels(rows, columns);
    for (int pixel = 0; pixel < rows * columns; ++pixel) {
        if (!hasValue(depth_m.data()[pixel])) {
            labels.data()[pixel] = Label::Unclassified;
        } else if (!hasValue(angle_rad.data()[pixel])) {
            labels.data()[pixel] = Label::Roi;
        } else {
            labels.data()[pixel] = reached.data()[pixel] == ground ? Label::Rou : Label::Roi;
        }
    }
    return labels;
}

TEST(Labelling, MatchesSlowLabellerOnEveryInstructionSet) {
    test::Random random(24);
    for (int round = 0; round < 80; ++round) {
        const int rows = random.chance(0.5) ? random.whole(1, 70) : random.whole(71, 256);
        const int columns = random.chance(0.3) ? random.whole(1, 3) : random.whole(4, 40);
        const Image<float> depth_m = random.image(rows, columns, 1.0f, 30.0f, 0.1);
        // A few angles, so that many differ by exactly beta; regions may cross empty pixels.
        Image<float> angle_rad = random.image(rows, columns, 0.0f, 4.0f, 0.05).round() * 0.25f;
        if (random.chance(0.5)) angle_rad = depth_m.isNaN().select(kNoValue, angle_rad);
        const float beta_rad = 0.25f * static_cast<float>(random.whole(1, 4));
        for (const Seeds seeds : {Seeds::Lowest, Seeds::TopAndNearest}) {
            const Image<Label> expected = slowLabels(depth_m, angle_rad, beta_rad, seeds);
            forEachInstructionSet([&](const std::string& name) {
                const Image<Label> found = labelled(depth_m, angle_rad, beta_rad, seeds);
                ASSERT_TRUE((found == expected).all()) << name << " " << rows << " x " << columns;
            });
            if (HasFatalFailure()) return;
        }
    }
}

TEST(Labelling, FollowsWindingPath) {
    // Angle 0 is the path: up one column, across, down the next, and so on. Angle 1 separates it.
    for (const int rows : {5, 64, 65, 130}) {
        const int columns = 40;
        Image<float> angle_rad = Image<float>::Constant(rows, columns, 1.0f);
        for (int column = 0; column < columns - 1; column += 2) {
            angle_rad.col(column).setZero();
            angle_rad(column % 4 == 0 ? rows - 1 : 0, column + 1) = 0.0f;
        }
        angle_rad.col(columns - 1).setConstant(2.0f);
        Image<float> depth_m = Image<float>::Constant(rows, columns, 10.0f);
        // Only column 0 has a seed: elsewhere, the lowest pixel has no angle.
        for (int column = 1; column < columns; ++column) angle_rad(0, column) = kNoValue;
        for (int column = 3; column < columns - 1; column += 4) angle_rad(1, column) = 0.0f;
        for (const Seeds seeds : {Seeds::Lowest, Seeds::TopAndNearest}) {
            ASSERT_TRUE((labelled(depth_m, angle_rad, 0.1f, seeds) ==
                         slowLabels(depth_m, angle_rad, 0.1f, seeds))
                            .all());
        }
        const Image<Label> labels = labelled(depth_m, angle_rad, 0.1f);
        EXPECT_EQ(labels(rows / 2, columns - 2), Label::Rou);
    }
}

TEST(Labelling, GatedSeedIsRoiUnlessReached) {
    // The lowest pixels of columns 0 and 1 are steep, that of column 2 is level; from 2 to 1,
    // angles differ by 0.4.
    Image<float> depth_m(3, 3), angle_rad(3, 3);
    depth_m.row(0) = 5.0f;
    depth_m.row(1) = 6.0f;
    depth_m.row(2) = 7.0f;
    angle_rad << 1.5f, 0.8f, 0.1f,  //
        1.5f, 0.5f, 0.1f,           //
        1.5f, 1.5f, 0.1f;
    angle_rad.col(0) = 1.55f;
    Image<Label> expected(3, 3);
    expected << Label::Roi, Label::Rou, Label::Rou,  //
        Label::Roi, Label::Rou, Label::Rou,          //
        Label::Roi, Label::Roi, Label::Rou;
    EXPECT_TRUE((labelled(depth_m, angle_rad, 0.45f, Seeds::Lowest, 0.6f) == expected).all());
    EXPECT_TRUE(
        (labelled(depth_m, angle_rad, 0.45f, Seeds::Lowest, kNoGate_rad).col(0) == Label::Rou)
            .all());
}

TEST(Labelling, NinetyDegreeGateIsOpen) {
    Image<float> depth_m(2, 3);
    depth_m << 5, 5, 5, 4, 4, 4;  // leans towards the sensor
    const Image<float> upright_rad = Image<float>::Constant(2, 3, kNoGate_rad);
    EXPECT_TRUE((labelled(depth_m, upright_rad, 0.1f) == Label::Rou).all());
    EXPECT_TRUE((labelled(depth_m, upright_rad, 0.1f, Seeds::Lowest, 1.56f) == Label::Roi).all());
}

TEST(Labelling, GateAppliesOnlyToGroundSeeds) {
    Image<float> depth_m(2, 3);
    depth_m << 5, 5, 5, 4, 4, 4;
    const Image<float> angle_rad = Image<float>::Constant(2, 3, 1.5f);
    EXPECT_TRUE(
        (labelled(depth_m, angle_rad, 0.1f, Seeds::TopAndNearest, 0.1f) == Label::Roi).all());
}

TEST(Labelling, EverySeedMarksAllRou) {
    test::Random random(32);
    for (const int rows : {3, 16, 70}) {
        const Image<float> depth_m = random.image(rows, 20, 1.0f, 30.0f, 0.2);
        const Image<float> angle_rad = random.image(rows, 20, 0.0f, 1.5f, 0.2);
        const Image<Label> labels = labelled(depth_m, angle_rad, 0.1f, Seeds::Every, 0.2f);
        EXPECT_TRUE(((labels == Label::Unclassified) == depth_m.isNaN()).all());
        EXPECT_TRUE(((labels == Label::Rou) == (!depth_m.isNaN() && !angle_rad.isNaN())).all());
    }
}

TEST(Zone, BeyondZoneIsRou) {
    Image<float> depth_m(1, 4);
    depth_m << 5.0f, 20.0f, 20.001f, kNoValue;
    Image<Label> labels(1, 4);
    labels << Label::Roi, Label::Roi, Label::Roi, Label::Unclassified;
    limitToZone(depth_m, 20.0f, labels);
    EXPECT_EQ(labels(0, 0), Label::Roi);
    EXPECT_EQ(labels(0, 1), Label::Roi);
    EXPECT_EQ(labels(0, 2), Label::Rou);
    EXPECT_EQ(labels(0, 3), Label::Unclassified);
}

}  // namespace
}  // namespace hagen
