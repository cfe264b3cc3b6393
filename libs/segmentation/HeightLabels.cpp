#include <hagen/segmentation/GroundSurface.h>
#include <hagen/segmentation/HeightLabels.h>
#include <algorithm>
#include <cmath>

namespace hagen {
namespace {

constexpr float kLeastTolerance_m = 0.04f;
constexpr float kTallest_m = 1.1f;       // more than this is no reason to tolerate less
constexpr float kFootHeight_m = 0.015f;  // a foot is no lower than this
constexpr int kFootRows = 4;             // a pixel's angle is with the next of so many rows above
constexpr float kDoubt_m = 0.2f;         // a height so close to its tolerance is put to the vote
constexpr float kVoteReach_m = 1.0f;     // in distance from the sensor
constexpr int kLeastVotes = 3;

}  // namespace

void toleratedHeights(const PixelPoints& pixels, const Image<float>& height_m,
                      const HeightTolerance& tolerance, Image<float>& tolerance_m) {
    constexpr int kCells = GroundSurface::kCells;
    Eigen::ArrayXXf tallest_m = Eigen::ArrayXXf::Zero(kCells + 2, kCells + 2);  // with a border
    const auto cellOf = [&](float coordinate_m) {
        const float cell = std::floor(coordinate_m / GroundSurface::kCell_m) + 0.5f * kCells;
        return static_cast<int>(std::clamp(cell, -1.0f, static_cast<float>(kCells))) + 1;
    };
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        const float h_m = height_m.data()[pixel];
        if (!hasValue(h_m)) continue;
        float& tall_m =
            tallest_m(cellOf(pixels.x_m.data()[pixel]), cellOf(pixels.y_m.data()[pixel]));
        tall_m = std::max(tall_m, std::min(h_m, kTallest_m));
    }
    tolerance_m.setConstant(height_m.rows(), height_m.cols(), kNoValue);
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        if (!hasValue(height_m.data()[pixel])) continue;
        const float x_m = pixels.x_m.data()[pixel], y_m = pixels.y_m.data()[pixel];
        const int i = std::clamp(cellOf(x_m), 1, kCells), j = std::clamp(cellOf(y_m), 1, kCells);
        const float tall_m = tallest_m.block<3, 3>(i - 1, j - 1).maxCoeff();
        tolerance_m.data()[pixel] =
            std::max(kLeastTolerance_m, tolerance.near_m + tolerance.per_m * std::hypot(x_m, y_m) -
                                            tolerance.beside_tall * tall_m);
    }
}

void labelByHeight(const Image<float>& height_m, const Image<float>& tolerance_m,
                   Image<Label>& labels) {
    labels.resize(height_m.rows(), height_m.cols());
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        const float h_m = height_m.data()[pixel];
        labels.data()[pixel] = !hasValue(h_m)                    ? Label::Unclassified
                               : h_m > tolerance_m.data()[pixel] ? Label::Roi
                                                                 : Label::Rou;
    }
}

void growFeet(const PixelPoints& pixels, const Image<float>& height_m, Image<Label>& labels) {
    const int rows = static_cast<int>(labels.rows());
    for (int column = 0; column < labels.cols(); ++column) {
        int above = -1;
        for (int row = rows - 1; row >= 0; --row) {
            if (!hasValue(height_m(row, column))) continue;
            if (above >= 0 && above - row <= kFootRows && labels(above, column) == Label::Roi &&
                height_m(row, column) > kFootHeight_m) {
                const float dx_m = pixels.x_m(above, column) - pixels.x_m(row, column);
                const float dy_m = pixels.y_m(above, column) - pixels.y_m(row, column);
                const float dz_m = pixels.z_m(above, column) - pixels.z_m(row, column);
                const bool is_steep = std::abs(dz_m) > std::hypot(dx_m, dy_m);  // than 45 degrees
                if (is_steep) labels(row, column) = Label::Roi;
            }
            above = row;
        }
    }
}

void removeSpecks(const PixelPoints& pixels, const Image<float>& height_m,
                  const Image<float>& tolerance_m, Image<Label>& labels) {
    const int rows = static_cast<int>(labels.rows()), columns = static_cast<int>(labels.cols());
    const Image<Label> before = labels;
    const auto distance = [&](int row, int column) {
        return std::hypot(pixels.x_m(row, column), pixels.y_m(row, column));
    };
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < rows; ++row) {
            const float beyond_m = height_m(row, column) - tolerance_m(row, column);
            if (!(std::abs(beyond_m) < kDoubt_m)) continue;
            int votes = 0, for_roi = 0;
            for (int step = -1; step <= 1; ++step) {
                const int c = wrapColumn(column + step, columns);
                for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows - 1); ++r) {
                    if (!hasValue(height_m(r, c))) continue;
                    if (std::abs(distance(r, c) - distance(row, column)) > kVoteReach_m) continue;
                    ++votes;
                    for_roi += before(r, c) == Label::Roi;
                }
            }
            if (votes < kLeastVotes || 2 * for_roi == votes) continue;
            labels(row, column) = 2 * for_roi > votes ? Label::Roi : Label::Rou;
        }
    }
}

}  // namespace hagen
