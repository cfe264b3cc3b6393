#include "filter/paper/Sharpening.h"
#include <algorithm>
#include <cmath>

namespace hagen {
namespace {

float gaussian(float distance, float sigma) {
    return std::exp(-0.5f * (distance / sigma) * (distance / sigma));
}

}  // namespace

void sharpenMaxima(const Image<float>& image_m, const std::vector<Maximum>& maxima, float sigma_px,
                   float sigma_m, Image<float>& sharpened_m, bool by_neighbours) {
    const int rows = static_cast<int>(image_m.rows());
    const int columns = static_cast<int>(image_m.cols());
    sharpened_m = image_m;
    const float beside = gaussian(1.0f, sigma_px),
                diagonal = gaussian(std::hypot(1.0f, 1.0f), sigma_px);
    for (const Maximum& maximum : maxima) {
        const float centre_m = image_m(maximum.row, maximum.column);
        float weighted_sum = 0.0f, weights = 0.0f;
        for (int column_step = -1; column_step <= 1; ++column_step) {
            const int column = wrapColumn(maximum.column + column_step, columns);
            for (int row_step = -1; row_step <= 1; ++row_step) {
                const int row = maximum.row + row_step;
                if (row < 0 || row >= rows || (row_step == 0 && column_step == 0)) continue;
                const float neighbour_m = image_m(row, column);
                if (!hasValue(neighbour_m)) continue;
                const float spatial = row_step == 0 || column_step == 0 ? beside : diagonal;
                const float weight = gaussian(std::abs(neighbour_m - centre_m), sigma_m) * spatial;
                weighted_sum += weight * (by_neighbours ? neighbour_m : centre_m);
                weights += weight;
            }
        }
        // The weights underflow to 0 if all neighbours are many sigmas away.
        if (weights > 0.0f) {
            sharpened_m(maximum.row, maximum.column) = centre_m + weighted_sum / weights;
        }
    }
}

void mergeMaxima(const Image<float>& depth_m, const Image<float>& proximity_m,
                 const Image<float>& sharpened_m, const std::vector<Maximum>& maxima,
                 float min_range_m, Image<float>& merged_m) {
    merged_m = depth_m;
    for (const Maximum& maximum : maxima) {
        const float before_m = proximity_m(maximum.row, maximum.column);
        const float sharpened = sharpened_m(maximum.row, maximum.column);
        const float nearer_by_m = 0.5f * (before_m + sharpened) - before_m;
        float& merged = merged_m(maximum.row, maximum.column);
        merged = std::max(merged - nearer_by_m, std::min(merged, min_range_m));
    }
}

void mergeDepths(const Image<float>& depth_m, const Image<float>& sharpened_m,
                 const std::vector<Maximum>& maxima, Image<float>& merged_m) {
    merged_m = depth_m;
    for (const Maximum& maximum : maxima) {
        float& merged = merged_m(maximum.row, maximum.column);
        merged = 0.5f * (merged + sharpened_m(maximum.row, maximum.column));
    }
}

}  // namespace hagen
