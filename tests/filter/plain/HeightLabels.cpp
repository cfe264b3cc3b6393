#include <algorithm>
#include <cmath>

#include "filter/ground/GroundGrid.h"
#include "filter/ground/StageRules.h"
#include "filter/plain/PlainStages.h"

namespace hagen::plain {

void toleratedHeights(const PixelPoints& pixels, const PixelCells& cells, const CellTops& tops,
                      const HeightTolerance& tolerance, float sensor_height_m,
                      Image<float>& tolerance_m) {
    using namespace tolerance_rules;
    tolerance_m.setConstant(cells.cell.rows(), cells.cell.cols(), kNoValue);
    for (Eigen::Index pixel = 0; pixel < tolerance_m.size(); ++pixel) {
        const float x_m = pixels.x_m.data()[pixel], y_m = pixels.y_m.data()[pixel];
        if (!hasValue(x_m)) continue;
        // A pixel outside the grid uses the nearest cell inside.
        const int cell = cells.cell.data()[pixel];
        const int i = std::clamp(cell % kGridStride, 1, GroundSurface::kCells);
        const int j = std::clamp(cell / kGridStride, 1, GroundSurface::kCells);
        const float highest_m = std::max(tops.top_m.block<3, 1>(i - 1, j).maxCoeff(),
                                         std::max(tops.top_m(i, j - 1), tops.top_m(i, j + 1)));
        const float tall_m = std::clamp(highest_m, 0.0f, kTallest_m);
        const float distance_m = std::sqrt(x_m * x_m + y_m * y_m);
        const float shallow = std::min(distance_m * (1 / (kShallow * sensor_height_m)), 1.0f);
        tolerance_m.data()[pixel] =
            std::max(kMinTolerance_m, tolerance.near_m + tolerance.per_m * distance_m -
                                          tolerance.beside_tall * shallow * tall_m);
    }
}

void labelByHeight(const Image<float>& height_m, const Image<float>& tolerance_m,
                   Image<Label>& labels) {
    labels.resize(height_m.rows(), height_m.cols());
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        const float h_m = height_m.data()[pixel];
        const bool is_roi = h_m > tolerance_m.data()[pixel] || h_m < kMinGround_m;
        labels.data()[pixel] = !hasValue(h_m) ? Label::Unclassified
                               : is_roi       ? Label::Roi
                                              : Label::Rou;
    }
}

}  // namespace hagen::plain
