// Compares the vectorised ground stages with their definitions and across instruction sets.
#include <gtest/gtest.h>
#include <hagen/filter/HagenFilter.h>
#include "filter/FilterWorkspace.h"
#include "filter/SampleColumns.h"
#include "filter/ground/StageRules.h"
#include "filter/plain/PlainStages.h"
#include "filter/simd/CanopyLayer.h"
#include "scan/InstructionSets.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "support/InstructionSets.h"
#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

/// The returns of a rotating sensor 2 m above rolling ground, in the sensor frame, with obstacles,
/// low plants, stray returns below the ground, gaps and returns outside the grid.
struct StageInput {
    PixelPoints pixels;
    Image<Label> labels;
};

StageInput randomSight(test::Random& random, int rows, int columns, float step_m, double missing) {
    StageInput s;
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

/// A yard with poles and walls, simulated with range noise and missing returns, and the filter's
/// labels.
StageInput simulatedSight(test::Random& random, const char* sensor_name) {
    const SensorModel sensor = sensorModel(sensor_name);
    const auto noise = [&](const Eigen::Vector3d&, test::Hit& hit) {
        hit.range_m = random.chance(0.06) ? 1e9 : hit.range_m + random.real(-0.03f, 0.03f);
    };
    const Scan scan =
        test::scanScene(test::yard(), sensor, 700, {0, 0, 2.1}, Eigen::Matrix3d::Identity(), noise)
            .scan;
    HagenFilter filter(sensor);
    const SegmentationResult& result = filter.segment(scan, Attitude{});
    return {result.ground.pixels, result.labels};
}

/// Visits simulated scans, sizes that are not multiples of a vector, a single column, many rows,
/// equal values and empty images.
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
    for (const char* const sensor : {"VLP-16", "HDL-32E", "HDL-64E"}) {
        SCOPED_TRACE(sensor);
        visit(simulatedSight(random, sensor));
    }
}

const HeightTolerance kTolerance;
FilterWorkspace stages_work;  // reused, as in a filter

/// The results of all stages from pixels to labels.
struct Judged {
    Eigen::Isometry3f frame;
    PixelCells cells;
    Image<std::uint8_t> is_level;
    GroundSurface surface, surface_of_rou;
    Image<float> height_m, tolerance_m;
    std::vector<std::uint8_t> has_evidence;
    CellTops tops;
    Image<Label> labels;
    bool raised, grown, despeckled;  ///< whether these stages changed anything
};

Judged judged(const StageInput& sight) {
    Judged j;
    PixelPoints pixels = sight.pixels;
    j.frame = fitGroundFrame(pixels, Attitude{0.02f, -0.03f}, stages_work.ground_frame);
    movePixels(j.frame, pixels);
    findPixelCells(pixels, j.cells);
    findLevelPixels(pixels, j.cells, j.is_level, stages_work.evidence);
    keepLevelRou(sight.labels, j.is_level, stages_work.candidates);
    fitGroundSurface(pixels, stages_work.candidates, j.surface, stages_work.ground_surface);
    fitGroundSurface(pixels, sight.labels == Label::Rou, j.surface_of_rou,
                     stages_work.ground_surface);
    heightsAbove(j.surface, pixels, j.height_m);
    findCellTops(j.cells, j.height_m, j.tops);
    toleratedHeights(pixels, j.cells, j.tops, kTolerance, std::max(j.frame.translation().z(), 0.1f),
                     j.tolerance_m, stages_work.tolerance);
    const Image<float> before_m = j.tolerance_m;
    tolerateCanopy(j.cells, j.tops, j.frame.translation().z(), j.tolerance_m);
    j.raised = !test::same(before_m, j.tolerance_m);
    requireEvidence(pixels, j.cells, j.height_m, j.is_level, j.frame.translation().z(),
                    j.tolerance_m, j.has_evidence);
    labelByHeight(j.height_m, j.tolerance_m, j.labels);
    Image<Label> before = j.labels;
    growFeet(pixels, j.height_m, j.labels, stages_work.feet);
    j.grown = (before != j.labels).any();
    before = j.labels;
    removeSpecks(pixels, j.height_m, j.tolerance_m, j.labels, stages_work.specks);
    j.despeckled = (before != j.labels).any();
    return j;
}

/// Like judged(), by the definitions.
Judged defined(const StageInput& sight) {
    Judged j;
    PixelPoints pixels = sight.pixels;
    std::vector<std::int32_t> columns;
    sampleColumns(sight.labels.cols(), frame_rules::kEnoughColumns, columns);
    j.frame = plain::fitGroundFrame(pixels, Attitude{0.02f, -0.03f}, columns);
    movePixels(j.frame, pixels);
    plain::findPixelCells(pixels, j.cells);
    plain::findLevelPixels(pixels, j.cells, j.is_level);
    keepLevelRou(sight.labels, j.is_level, stages_work.candidates);
    sampleColumns(sight.labels.cols(), surface_rules::kEnoughColumns, columns);
    plain::fitGroundSurface(pixels, stages_work.candidates, columns, j.surface);
    plain::fitGroundSurface(pixels, sight.labels == Label::Rou, j.surface_of_rou);
    plain::heightsAbove(j.surface, pixels, j.height_m);
    plain::findCellTops(j.cells, j.height_m, j.tops);
    plain::toleratedHeights(pixels, j.cells, j.tops, kTolerance,
                            std::max(j.frame.translation().z(), 0.1f), j.tolerance_m);
    plain::tolerateCanopy(j.cells, j.tops, j.frame.translation().z(), j.tolerance_m);
    plain::requireEvidence(pixels, j.cells, j.height_m, j.is_level, j.frame.translation().z(),
                           j.tolerance_m, j.has_evidence);
    plain::labelByHeight(j.height_m, j.tolerance_m, j.labels);
    plain::growFeet(pixels, j.height_m, j.labels);
    plain::removeSpecks(pixels, j.height_m, j.tolerance_m, j.labels);
    return j;
}

bool sameBits(const Eigen::ArrayXXf& a, const Eigen::ArrayXXf& b) {
    return a.size() == b.size() &&
           std::memcmp(a.data(), b.data(), sizeof(float) * static_cast<std::size_t>(a.size())) == 0;
}

void expectSame(const Judged& a, const Judged& b) {
    EXPECT_EQ(a.frame.matrix(), b.frame.matrix());
    EXPECT_TRUE((a.cells.cell == b.cells.cell).all());
    EXPECT_TRUE((a.cells.block == b.cells.block).all());
    EXPECT_TRUE((a.is_level == b.is_level).all());
    EXPECT_TRUE(sameBits(a.surface.height_m, b.surface.height_m));
    EXPECT_TRUE(sameBits(a.surface_of_rou.height_m, b.surface_of_rou.height_m));
    EXPECT_TRUE(test::same(a.height_m, b.height_m));
    EXPECT_TRUE(sameBits(a.tops.highest_m, b.tops.highest_m));
    EXPECT_TRUE(sameBits(a.tops.top_m, b.tops.top_m));
    EXPECT_TRUE(test::same(a.tolerance_m, b.tolerance_m));
    EXPECT_EQ(a.has_evidence, b.has_evidence);
    EXPECT_TRUE((a.labels == b.labels).all());
}

TEST(GroundStages, MatchDefinitions) {
    forManySights([](const StageInput& sight) { expectSame(judged(sight), defined(sight)); });
}

TEST(GroundStages, MatchOnEveryInstructionSet) {
    forManySights([](const StageInput& sight) {
        std::vector<Judged> results;
        forEachInstructionSet([&](const std::string& name) {
            SCOPED_TRACE(name);
            results.push_back(judged(sight));
            expectSame(results.front(), results.back());
        });
        ASSERT_FALSE(results.empty());
    });
}

/// Ensures that the comparisons above are not vacuous.
TEST(GroundStages, TestScansExerciseEveryStage) {
    int canopies = 0, feet = 0, specks = 0, withdrawn = 0, kept = 0;
    forManySights([&](const StageInput& sight) {
        const Judged j = judged(sight);
        canopies += j.raised;
        feet += j.grown;
        specks += j.despeckled;
        withdrawn += (j.tolerance_m < 0).any();
        kept += (j.tolerance_m >= 0).any();
    });
    for (const int number : {canopies, feet, specks, withdrawn, kept}) EXPECT_GT(number, 10);
}

}  // namespace
}  // namespace hagen
