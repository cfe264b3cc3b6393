#include "filter/simd/HeightLabels.h"
#include <algorithm>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/simd/HeightLabels.cpp"
#include <hwy/foreach_target.h>
#include "filter/simd/GroundGrid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

constexpr int kCells = GroundSurface::kCells;
using namespace tolerance_rules;

/// The maximum of each cell and its four neighbours, limited to 0...kTallest_m. The border gets the
/// values of the adjacent cells.
void TallestAroundIn(const float* HWY_RESTRICT top_m, const CellArea& area,
                     float* HWY_RESTRICT tallest_m) {
    const hn::ScalableTag<float> d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const int first_i = std::max(area.first_row - 1, 0) / lanes * lanes;  // in whole vectors
    const int end_i = std::min(area.end_row - 1, kCells);
    const int end_j = std::min(area.end_column - 1, kCells);
    for (int j = std::max(area.first_column - 1, 0); j < end_j; ++j) {
        float* HWY_RESTRICT result_m = tallest_m + gridColumn(j);
        for (int i = first_i; i < end_i; i += lanes) {
            const float* HWY_RESTRICT cell = top_m + gridColumn(j) + i;
            auto highest_m = hn::Zero(d);
            for (const int place : {-kGridStride, -1, 0, 1, kGridStride}) {
                highest_m = hn::Max(highest_m, hn::LoadU(d, cell + place));
            }
            hn::StoreU(hn::Min(highest_m, hn::Set(d, kTallest_m)), d, result_m + i);
        }
        result_m[-1] = result_m[0];
        result_m[kCells] = result_m[kCells - 1];
    }
    const auto copyColumn = [&](int from, int to) {
        std::copy_n(tallest_m + gridColumn(from) - 1, kGridStride, tallest_m + gridColumn(to) - 1);
    };
    copyColumn(0, -1);
    copyColumn(kCells - 1, kCells);
}

void ToleratedHeightsIn(std::size_t pixels, const float* HWY_RESTRICT x_m,
                        const float* HWY_RESTRICT y_m, const std::uint16_t* HWY_RESTRICT cell,
                        const float* HWY_RESTRICT tallest_m, const HeightTolerance& tolerance,
                        float sensor_height_m, float* HWY_RESTRICT tolerance_m) {
    const float shallow_per_m = 1 / (kShallow * sensor_height_m);
    forEachVector(pixels, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const auto x = hn::LoadU(d, x_m + pixel), y = hn::LoadU(d, y_m + pixel);
        const auto distance_m = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
        const auto tall_m = gatherAt(d, tallest_m, cell + pixel);
        const auto shallow =
            hn::Min(hn::Mul(distance_m, hn::Set(d, shallow_per_m)), hn::Set(d, 1.0f));
        const auto tolerated_m = hn::Sub(
            hn::Add(hn::Set(d, tolerance.near_m), hn::Mul(hn::Set(d, tolerance.per_m), distance_m)),
            hn::Mul(hn::Mul(hn::Set(d, tolerance.beside_tall), shallow), tall_m));
        const auto min_m = hn::Set(d, kMinTolerance_m);
        const auto is_less = hn::Lt(tolerated_m, min_m);  // false for NaN
        hn::StoreU(hn::IfThenElse(is_less, min_m, tolerated_m), d, tolerance_m + pixel);
    });
}

void LabelByHeightIn(std::size_t pixels, const float* HWY_RESTRICT height_m,
                     const float* HWY_RESTRICT tolerance_m, std::uint8_t* HWY_RESTRICT label) {
    forEachVector(pixels, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const hn::Rebind<std::uint8_t, decltype(d)> d8;
        const auto h_m = hn::LoadU(d, height_m + pixel);
        const auto has_value = hn::RebindMask(di, hn::Eq(h_m, h_m));
        const auto is_high =
            hn::RebindMask(di, hn::Or(hn::Gt(h_m, hn::LoadU(d, tolerance_m + pixel)),
                                      hn::Lt(h_m, hn::Set(d, kMinGround_m))));
        const auto is = [&](Label what)
                            HAGEN_INLINE { return hn::Set(di, static_cast<std::int32_t>(what)); };
        const auto rou_or_roi = hn::IfThenElse(is_high, is(Label::Roi), is(Label::Rou));
        static_assert(static_cast<int>(Label::Unclassified) == 0);
        hn::StoreU(hn::DemoteTo(d8, hn::IfThenElseZero(has_value, rou_or_roi)), d8, label + pixel);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(TallestAroundIn);
HWY_EXPORT(ToleratedHeightsIn);
HWY_EXPORT(LabelByHeightIn);

}  // namespace

void toleratedHeights(const PixelPoints& pixels, const PixelCells& cells, const CellTops& tops,
                      const HeightTolerance& tolerance, float sensor_height_m,
                      Image<float>& tolerance_m, ToleranceWorkspace& work, const CellArea& area) {
    work.tallest_m.resize(kGridSize);
    HWY_DYNAMIC_DISPATCH(TallestAroundIn)(tops.top_m.data(), area, work.tallest_m.data());
    tolerance_m.resize(cells.cell.rows(), cells.cell.cols());
    HWY_DYNAMIC_DISPATCH(ToleratedHeightsIn)
    (tolerance_m.size(), pixels.x_m.data(), pixels.y_m.data(), cells.cell.data(),
     work.tallest_m.data(), tolerance, sensor_height_m, tolerance_m.data());
}

void labelByHeight(const Image<float>& height_m, const Image<float>& tolerance_m,
                   Image<Label>& labels) {
    static_assert(sizeof(Label) == 1);
    labels.resize(height_m.rows(), height_m.cols());
    HWY_DYNAMIC_DISPATCH(LabelByHeightIn)
    (height_m.size(), height_m.data(), tolerance_m.data(),
     reinterpret_cast<std::uint8_t*>(labels.data()));
}

}  // namespace hagen
#endif
