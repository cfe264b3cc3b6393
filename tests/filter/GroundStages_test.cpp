// Compares the vectorised ground stages with simple reference implementations, on every instruction
// set.
#include <gtest/gtest.h>
#include <hagen/filter/CanopyLayer.h>
#include <hagen/filter/FilterWorkspace.h>

#include <cmath>
#include <cstring>

#include "support/InstructionSets.h"
#include "support/PlainGround.h"
#include "support/Random.h"

namespace hagen {
namespace {

/// The returns of a rotating sensor over rolling ground with obstacles, low plants, stray returns
/// below the ground, gaps and returns outside the grid; in the sensor frame, 2 m up.
struct Sight {
    PixelPoints pixels;
    Image<Label> labels;
};

Sight randomSight(test::Random& random, int rows, int columns, float step_m, double missing) {
    Sight s;
    for (auto* image : {&s.pixels.x_m, &s.pixels.y_m, &s.pixels.z_m}) {
        image->setConstant(rows, columns, kNoValue);
    }
    s.labels.setConstant(rows, columns, Label::Unclassified);
    const double plants = random.chance(0.5) ? 0.5 : 0.05;
    const auto rounded = [&](float value) {
        return step_m > 0 ? step_m * std::round(value / step_m) : value;
    };
    for (int column = 0; column < columns; ++column) {
        const float azimuth_rad =
            6.2831853f * static_cast<float>(column) / static_cast<float>(columns);
        const float wall_m = random.chance(0.3) ? random.real(3, 30) : 100.0f;
        for (int row = 0; row < rows; ++row) {
            if (random.chance(missing)) continue;
            const float out = static_cast<float>(row + 1) / static_cast<float>(rows);
            const float ground_m = 2 + 55 * out * out + random.real(0, 0.5f);
            const bool is_wall = ground_m > wall_m;
            const float distance_m = std::min(ground_m, wall_m);
            const float x_m = distance_m * std::cos(azimuth_rad);
            const float y_m = distance_m * std::sin(azimuth_rad);
            float above_m = random.real(-0.02f, 0.02f);
            if (random.chance(plants)) above_m = random.real(0, 0.7f);
            if (is_wall) above_m = random.real(0, 4);
            if (random.chance(0.01)) above_m = -1;
            const float z_m = 0.3f * std::sin(0.2f * x_m) + 0.02f * y_m - 2 + above_m;
            s.pixels.x_m(row, column) = rounded(x_m);
            s.pixels.y_m(row, column) = rounded(y_m);
            s.pixels.z_m(row, column) = rounded(z_m);
            s.labels(row, column) = is_wall != random.chance(0.05) ? Label::Roi : Label::Rou;
        }
    }
    return s;
}

/// Sizes that are no multiple of a vector, one column, many rows, equal values, empty images.
template <class Visit>
void forManySights(Visit visit) {
    test::Random random(110);
    for (const int rows : {1, 2, 15, 16, 33, 64, 128}) {
        for (const int columns : {1, 5, 37, 401}) {
            for (const float step_m : {0.0f, 0.25f}) {
                for (const double missing : {0.0, 0.3, 1.0}) {
                    SCOPED_TRACE(testing::Message() << rows << " x " << columns << ", step "
                                                    << step_m << ", missing " << missing);
                    visit(randomSight(random, rows, columns, step_m, missing));
                }
            }
        }
    }
}

void expectNear(const Image<float>& a, const Image<float>& b, float most) {
    ASSERT_EQ(a.rows(), b.rows());
    ASSERT_EQ(a.cols(), b.cols());
    for (Eigen::Index i = 0; i < a.size(); ++i) {
        ASSERT_EQ(hasValue(a.data()[i]), hasValue(b.data()[i])) << i;
        if (!hasValue(a.data()[i])) continue;
        ASSERT_NEAR(a.data()[i], b.data()[i], most) << i;
    }
}

const HeightTolerance kTolerance;
constexpr float kSensorHeight_m = 2;
FilterWorkspace work;  // shared by all tests, as by all scans in a filter

/// All stages from the pixels to the labels.
struct Judged {
    Eigen::Isometry3f frame;
    PixelCells cells;
    Image<std::uint8_t> is_level;
    GroundSurface surface;
    Image<float> height_m, tolerance_m;
    std::vector<std::uint8_t> has_evidence;
    CellTops tops;
    Image<Label> labels;
};

Judged judged(const Sight& sight) {
    Judged j;
    PixelPoints pixels = sight.pixels;
    j.frame = fitGroundFrame(pixels, Attitude{0.02f, -0.03f}, work.ground_frame);
    movePixels(j.frame, pixels);
    findPixelCells(pixels, j.cells);
    findLevelPixels(pixels, j.cells, j.is_level, work.evidence);
    keepLevelRou(sight.labels, j.is_level, work.candidates);
    fitGroundSurface(pixels, work.candidates, j.surface, work.ground_surface);
    heightsAbove(j.surface, pixels, j.height_m);
    findCellTops(j.cells, j.height_m, j.tops);
    toleratedHeights(pixels, j.cells, j.tops, kTolerance, j.frame.translation().z(), j.tolerance_m,
                     work.tolerance);
    tolerateCanopy(j.cells, j.tops, j.tolerance_m);
    requireEvidence(pixels, j.cells, j.height_m, j.is_level, j.tolerance_m, j.has_evidence,
                    work.evidence);
    labelByHeight(j.height_m, j.tolerance_m, j.labels);
    growFeet(pixels, j.height_m, j.labels, work.feet);
    removeSpecks(pixels, j.height_m, j.tolerance_m, j.labels, work.specks);
    return j;
}

TEST(GroundStages, TheFrameIsThatOfAPlainFit) {
    forManySights([](const Sight& sight) {
        const Attitude attitude{0.02f, -0.03f};
        const Eigen::Isometry3f fast = fitGroundFrame(sight.pixels, attitude, work.ground_frame);
        const Eigen::Isometry3f plain = test::plain::fitGroundFrame(sight.pixels, attitude);
        EXPECT_TRUE(fast.isApprox(plain, 1e-4f)) << fast.matrix() << "\n\n" << plain.matrix();
    });
}

TEST(GroundStages, TheSurfaceIsThatOfAPlainFit) {
    int apart = 0;
    forManySights([&](const Sight& sight) {
        Sight in_ground = sight;
        Eigen::Isometry3f up = Eigen::Isometry3f::Identity();
        up.translation().z() = kSensorHeight_m;
        movePixels(up, in_ground.pixels);
        GroundSurface fast, plain;
        fitGroundSurface(in_ground.pixels, in_ground.labels, fast, work.ground_surface);
        test::plain::fitGroundSurface(in_ground.pixels, in_ground.labels, plain);
        expectNear(fast.height_m, plain.height_m, 5e-2f);
        apart += ((fast.height_m - plain.height_m).abs() > 1e-3f).any();

        Image<float> fast_m, plain_m;
        heightsAbove(plain, in_ground.pixels, fast_m);
        test::plain::heightsAbove(plain, in_ground.pixels, plain_m);
        expectNear(fast_m, plain_m, 1e-4f);
    });
    // A cell on either side of a limit changes those around it; few sights have one.
    EXPECT_LE(apart, 1);
}

TEST(GroundStages, TolerancesAndLabelsAreThoseOfPlainLoops) {
    int canopies = 0, feet = 0, specks = 0;
    forManySights([&](const Sight& sight) {
        PixelPoints pixels = sight.pixels;
        Eigen::Isometry3f up = Eigen::Isometry3f::Identity();
        up.translation().z() = kSensorHeight_m;
        movePixels(up, pixels);
        const Image<float>& height_m = pixels.z_m;
        PixelCells cells;
        CellTops tops;
        Image<float> fast_m, plain_m;
        findPixelCells(pixels, cells);
        findCellTops(cells, height_m, tops);
        toleratedHeights(pixels, cells, tops, kTolerance, kSensorHeight_m, fast_m, work.tolerance);
        test::plain::toleratedHeights(pixels, height_m, kTolerance, kSensorHeight_m, plain_m);
        expectNear(fast_m, plain_m, 1e-5f);
        const Image<float> before_m = plain_m;
        fast_m = plain_m;
        tolerateCanopy(cells, tops, fast_m);
        test::plain::tolerateCanopy(pixels, height_m, plain_m);
        expectNear(fast_m, plain_m, 1e-3f);
        canopies += !test::same(before_m, plain_m);

        Image<Label> fast, plain;
        labelByHeight(height_m, plain_m, fast);
        test::plain::labelByHeight(height_m, plain_m, plain);
        EXPECT_TRUE((fast == plain).all());
        Image<Label> labels = plain;
        growFeet(pixels, height_m, fast, work.feet);
        test::plain::growFeet(pixels, height_m, plain);
        EXPECT_TRUE((fast == plain).all());
        feet += (labels != plain).any();
        labels = plain;
        removeSpecks(pixels, height_m, plain_m, fast, work.specks);
        test::plain::removeSpecks(pixels, height_m, plain_m, plain);
        EXPECT_TRUE((fast == plain).all());
        specks += (labels != plain).any();
    });
    EXPECT_GT(canopies, 10);  // otherwise nothing was compared
    EXPECT_GT(feet, 10);
    EXPECT_GT(specks, 10);
}

TEST(GroundStages, EvidenceIsThatOfPlainLoops) {
    int withdrawn = 0, kept = 0;
    forManySights([&](const Sight& sight) {
        PixelPoints pixels = sight.pixels;
        Eigen::Isometry3f up = Eigen::Isometry3f::Identity();
        up.translation().z() = kSensorHeight_m;
        movePixels(up, pixels);
        Image<std::uint8_t> plain;
        test::plain::findLevelPixels(pixels, plain);
        Image<Label> candidates;
        test::plain::keepLevelRou(sight.labels, plain, candidates);
        const Image<float>& height_m = pixels.z_m;
        Image<float> before_m, plain_m;
        test::plain::toleratedHeights(pixels, height_m, kTolerance, kSensorHeight_m, before_m);
        plain_m = before_m;
        test::plain::requireEvidence(pixels, height_m, plain, plain_m);
        withdrawn += (plain_m < 0).any();
        kept += (plain_m >= 0).any();

        PixelCells cells;
        findPixelCells(pixels, cells);
        forEachInstructionSet([&](const std::string& name) {
            Image<std::uint8_t> fast;
            findLevelPixels(pixels, cells, fast, work.evidence);
            EXPECT_TRUE((fast == plain).all()) << name;
            keepLevelRou(sight.labels, fast, work.candidates);
            EXPECT_TRUE((work.candidates == candidates).all()) << name;
            Image<float> fast_m = before_m;
            std::vector<std::uint8_t> has_evidence;
            requireEvidence(pixels, cells, height_m, fast, fast_m, has_evidence, work.evidence);
            EXPECT_TRUE(test::same(fast_m, plain_m)) << name;
        });
    });
    EXPECT_GT(withdrawn, 10);  // otherwise nothing was compared
    EXPECT_GT(kept, 10);
}

bool sameBits(const Eigen::ArrayXXf& a, const Eigen::ArrayXXf& b) {
    return a.size() == b.size() &&
           std::memcmp(a.data(), b.data(), sizeof(float) * static_cast<std::size_t>(a.size())) == 0;
}

TEST(GroundStages, AreTheSameToTheLastBitOnEveryInstructionSet) {
    forManySights([](const Sight& sight) {
        std::vector<Judged> results;
        forEachInstructionSet([&](const std::string& name) {
            results.push_back(judged(sight));
            const Judged &first = results.front(), &own = results.back();
            EXPECT_EQ(first.frame.matrix(), own.frame.matrix()) << name;
            EXPECT_TRUE((first.is_level == own.is_level).all()) << name;
            EXPECT_TRUE(sameBits(first.surface.height_m, own.surface.height_m)) << name;
            EXPECT_TRUE(test::same(first.height_m, own.height_m)) << name;
            EXPECT_TRUE(test::same(first.tolerance_m, own.tolerance_m)) << name;
            EXPECT_TRUE(sameBits(first.tops.top_m, own.tops.top_m)) << name;
            EXPECT_TRUE((first.cells.cell == own.cells.cell).all()) << name;
            EXPECT_TRUE((first.cells.block == own.cells.block).all()) << name;
            EXPECT_TRUE((first.labels == own.labels).all()) << name;
        });
        ASSERT_FALSE(results.empty());
    });
}

}  // namespace
}  // namespace hagen
