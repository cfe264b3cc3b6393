// A stage restricted to an area of the ground grid gives the same results there.
#include <gtest/gtest.h>
#include <hagen/filter/CellTops.h>
#include "filter/simd/CanopyLayer.h"
#include "filter/simd/HeightLabels.h"

#include <algorithm>
#include <cmath>

#include "support/Random.h"

namespace hagen {
namespace {

constexpr int kRows = 16, kColumns = 400;

struct Crops {
    PixelPoints pixels;
    PixelCells cells;
    Image<float> height_m;
};

/// Low plants everywhere, with taller objects among them; one pixel in seven is empty.
Crops makeCrops(unsigned seed) {
    test::Random random(seed);
    Crops crops;
    for (auto* image : {&crops.pixels.x_m, &crops.pixels.y_m, &crops.pixels.z_m, &crops.height_m}) {
        image->resize(kRows, kColumns);
    }
    for (Eigen::Index k = 0; k < crops.height_m.size(); ++k) {
        const auto x_m = random.real(-50, 50);
        const auto y_m = random.real(-50, 50);
        const bool is_tall = random.chance(0.05);
        const auto z_m = random.real(0.1f, is_tall ? 1.4f : 0.5f);
        const bool is_empty = k % 7 == 0;
        crops.pixels.set(
            k, is_empty ? Eigen::Vector3f::Constant(kNoValue) : Eigen::Vector3f(x_m, y_m, z_m));
        crops.height_m.data()[k] = is_empty ? kNoValue : z_m;
    }
    findPixelCells(crops.pixels, crops.cells);
    return crops;
}

TEST(CellArea, GrowsUpToGridBorder) {
    const CellArea area = CellArea{10, 20, 120, 125}.grownBy(8);
    EXPECT_EQ(area.first_row, 2);
    EXPECT_EQ(area.end_row, 28);
    EXPECT_EQ(area.first_column, 112);
    EXPECT_EQ(area.end_column, 130);
}

TEST(CellArea, MatchesWholeGridInside) {
    const Crops crops = makeCrops(5);
    CellTops whole;
    findCellTops(crops.cells, crops.height_m, whole);
    Image<float> whole_m;
    ToleranceWorkspace work;
    toleratedHeights(crops.pixels, crops.cells, whole, {}, 2.0f, whole_m, work);
    tolerateCanopy(crops.cells, whole, 2.0f, whole_m);
    ASSERT_GT(whole_m.maxCoeff<Eigen::PropagateNumbers>(), 0.4f);  // the scene contains a canopy

    const CellArea insides[] = {
        {60, 70, 61, 73}, {0, 20, 0, 9}, {97, 130, 111, 130}, {1, 7, 60, 70}};
    CellTops tops;  // reused, so it contains heights of earlier areas
    ToleranceWorkspace work_of_area;
    for (const CellArea& inside : insides) {
        const CellArea area = inside.grownBy(kCanopyReach);
        Image<float> tolerance_m;
        findCellTops(crops.cells, crops.height_m, tops, area);
        toleratedHeights(crops.pixels, crops.cells, tops, {}, 2.0f, tolerance_m, work_of_area,
                         area);
        tolerateCanopy(crops.cells, tops, 2.0f, tolerance_m, area);
        for (int column = area.first_column; column < area.end_column; ++column) {
            for (int row = area.first_row; row < area.end_row; ++row) {
                ASSERT_EQ(tops.top_m(row, column), whole.top_m(row, column))
                    << row << " " << column;
                ASSERT_EQ(tops.highest_m(row, column), whole.highest_m(row, column));
            }
        }
        int pixels = 0;
        for (Eigen::Index k = 0; k < tolerance_m.size(); ++k) {
            const int cell = crops.cells.cell.data()[k];
            const int row = cell % CellArea::kSide, column = cell / CellArea::kSide;
            const bool is_inside = cell > 0 && row >= inside.first_row && row < inside.end_row &&
                                   column >= inside.first_column && column < inside.end_column;
            if (!is_inside) continue;
            ++pixels;
            ASSERT_EQ(tolerance_m.data()[k], whole_m.data()[k]) << k;
        }
        EXPECT_GT(pixels, 0);
    }
}

TEST(CellTops, RaisesCellsKnownToBeHigher) {
    const Crops crops = makeCrops(6);
    CellTops all;
    findCellTops(crops.cells, crops.height_m, all);
    // Every fifth pixel remains, with the height of its former cell.
    Crops thin;
    Image<float> known_m;
    for (auto* image :
         {&thin.pixels.x_m, &thin.pixels.y_m, &thin.pixels.z_m, &thin.height_m, &known_m}) {
        image->resize(kRows, kColumns / 5);
    }
    for (Eigen::Index k = 0; k < thin.height_m.size(); ++k) {
        thin.pixels.set(k, crops.pixels.at(5 * k));
        thin.height_m.data()[k] = crops.height_m.data()[5 * k];
        const int cell = crops.cells.cell.data()[5 * k];
        known_m.data()[k] = k % 3 == 0 ? kNoValue : highestOf(all, cell);
    }
    findPixelCells(thin.pixels, thin.cells);
    CellTops tops, before;
    findCellTops(thin.cells, thin.height_m, tops);
    before = tops;
    raiseHighest(thin.cells, known_m, tops);
    int raised = 0;
    for (Eigen::Index k = 0; k < known_m.size(); ++k) {
        const int cell = thin.cells.cell.data()[k];
        if (cell == 0) continue;  // empty pixel
        // The maximum of the known heights of this cell and of its own pixels.
        float expected_m = before.highest_m.data()[cell];
        for (Eigen::Index other = 0; other < known_m.size(); ++other) {
            if (thin.cells.cell.data()[other] != cell || std::isnan(known_m.data()[other]))
                continue;
            expected_m = std::max(expected_m, known_m.data()[other]);
        }
        ASSERT_EQ(tops.highest_m.data()[cell], expected_m);
        raised += expected_m > before.highest_m.data()[cell];
    }
    EXPECT_GT(raised, 50);
    EXPECT_TRUE((tops.top_m == before.top_m).all());
    for (Eigen::Index k = 0; k < known_m.size(); ++k) {
        const int cell = thin.cells.cell.data()[k];
        ASSERT_EQ(highestOf(tops, cell), before.highest_m.data()[cell]);  // no heights were raised
    }
}

TEST(CellTops, UnknownOutsideComputedArea) {
    const Crops crops = makeCrops(7);
    CellTops tops;
    const CellArea area{40, 60, 50, 90};
    findCellTops(crops.cells, crops.height_m, tops, area);
    for (int cell = 0; cell < CellArea::kSide * CellArea::kSide; ++cell) {
        const int row = cell % CellArea::kSide, column = cell / CellArea::kSide;
        const bool is_in_area = row >= 40 && row < 60 && column >= 50 && column < 90;
        ASSERT_EQ(!std::isnan(highestOf(tops, cell)), is_in_area);
    }
}

}  // namespace
}  // namespace hagen
