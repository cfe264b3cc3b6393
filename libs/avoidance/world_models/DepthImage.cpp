#include "avoidance/world_models/DepthImage.h"

#include <algorithm>
#include <cmath>

namespace hagen::avoidance {

namespace {

constexpr std::uint16_t kMax_mm = 65535;

}  // namespace

DepthImage::DepthImage() {
    std::size_t pixels = 0;
    for (int level = 0; level < kLevels; ++level) {
        first_[level] = pixels;
        pixels += static_cast<std::size_t>((kColumns >> level) * (kRows >> level));
    }
    pixels_.assign(pixels, {kMax_mm, 0});
}

/// Columns run around a square whose corners lie on the axes, rows likewise from pole to pole.
DepthImage::Place DepthImage::placeOf(const Eigen::Vector3f& ray) {
    const float x = ray.x(), y = ray.y(), z = ray.z();
    const float flat = std::max(std::abs(x) + std::abs(y), 1e-9f);
    const float across = y / flat;
    const float around = x >= 0 ? (y >= 0 ? across : 4 + across) : 2 - across;
    const float rho = std::sqrt(x * x + y * y);
    const float up = z / std::max(rho + std::abs(z), 1e-9f);
    return {around * kPixelsPerUnit, (up + 1) * kPixelsPerUnit};
}

void DepthImage::project(const std::vector<Eigen::Vector3f>& points_m,
                         const Eigen::Vector3f& origin_m) {
    std::fill(pixels_.begin(), pixels_.end(), Pixel{kMax_mm, 0});
    for (const Eigen::Vector3f& point_m : points_m) {
        const Eigen::Vector3f ray = point_m - origin_m;
        const float range_mm = std::clamp(1000 * ray.norm(), 1.0f, 65534.0f);
        const Place place = placeOf(ray);
        const int column = static_cast<int>(place.column) & (kColumns - 1);
        const int row = std::clamp(static_cast<int>(place.row), 0, kRows - 1);
        Pixel& pixel = pixels_[indexOf(0, column, row)];
        pixel.nearest_mm = std::min(pixel.nearest_mm, static_cast<std::uint16_t>(range_mm));
        pixel.farthest_mm = std::max(pixel.farthest_mm, static_cast<std::uint16_t>(range_mm));
    }
    for (int level = 1; level < kLevels; ++level) {
        for (int row = 0; row < kRows >> level; ++row) {
            const Pixel* below = &pixels_[indexOf(level - 1, 0, 2 * row)];
            const Pixel* above = &pixels_[indexOf(level - 1, 0, 2 * row + 1)];
            Pixel* pixel = &pixels_[indexOf(level, 0, row)];
            for (int column = 0; column < kColumns >> level; ++column, below += 2, above += 2) {
                const auto nearer = [](const Pixel* two) {
                    return std::min(two[0].nearest_mm, two[1].nearest_mm);
                };
                const auto farther = [](const Pixel* two) {
                    return std::max(two[0].farthest_mm, two[1].farthest_mm);
                };
                *pixel++ = {std::min(nearer(below), nearer(above)),
                            std::max(farther(below), farther(above))};
            }
        }
    }
}

int DepthImage::levelFor(float half_columns, float half_rows, float max_half) {
    constexpr float kMoreColumns = 16;
    int level = 0;
    float half = std::max(half_columns / kMoreColumns, half_rows);
    for (; half > max_half && level < kLevels - 1; half /= 2) ++level;
    return level;
}

DepthImage::Depths DepthImage::depthsIn(int level, int left, int right, int low, int high) const {
    const int columns = kColumns >> level;
    std::uint16_t nearest_mm = kMax_mm, farthest_mm = 0;
    for (int row = low; row <= high; ++row) {
        for (int column = left; column <= right; ++column) {
            const Pixel& pixel = pixels_[indexOf(level, column & (columns - 1), row)];
            nearest_mm = std::min(nearest_mm, pixel.nearest_mm);
            farthest_mm = std::max(farthest_mm, pixel.farthest_mm);
        }
    }
    if (farthest_mm == 0) return {0, 0};
    return {1e-3f * static_cast<float>(nearest_mm), 1e-3f * static_cast<float>(farthest_mm)};
}

DepthImage::Depths DepthImage::depthsAround(const Place& place, float half_columns, float half_rows,
                                            float max_half) const {
    const int level = levelFor(half_columns, half_rows, max_half);
    const float scale = 1 / static_cast<float>(1 << level);
    const int columns = kColumns >> level, rows = kRows >> level;
    const auto pixelOf = [&](float at) { return static_cast<int>(std::floor(at * scale)); };
    const int left = pixelOf(place.column - half_columns);
    return depthsIn(level, left, std::min(pixelOf(place.column + half_columns), left + columns - 1),
                    std::clamp(pixelOf(place.row - half_rows), 0, rows - 1),
                    std::clamp(pixelOf(place.row + half_rows), 0, rows - 1));
}

DepthImage::Block DepthImage::block(const Eigen::Vector3f& to_first_m, float step_m,
                                    float half_columns, float half_rows, float max_half) {
    static const Values kX = Values::NullaryExpr([](Eigen::Index i) { return float(i & 3); });
    static const Values kY = Values::NullaryExpr([](Eigen::Index i) { return float(i >> 2 & 3); });
    static const Values kZ = Values::NullaryExpr([](Eigen::Index i) { return float(i >> 4); });
    const Values x = to_first_m.x() + step_m * kX, y = to_first_m.y() + step_m * kY,
                 z = to_first_m.z() + step_m * kZ;
    Block block;
    const Values around2 = x.square() + y.square();
    block.away_m = (around2 + z.square()).sqrt();
    // Like placeOf(), without branches.
    const Values across = y / (x.abs() + y.abs()).max(1e-9f);
    const Values column = (x >= 0).select((y >= 0).select(across, 4 + across), 2 - across);
    const Values row = z / (around2.sqrt() + z.abs()).max(1e-9f);
    block.level = levelFor(half_columns, half_rows, max_half);
    const float scale = 1 / static_cast<float>(1 << block.level);
    const float per_unit = kPixelsPerUnit * scale;
    const int columns = kColumns >> block.level, rows = kRows >> block.level;
    // Adding whole turns keeps columns positive, so that truncation rounds down.
    const float turns = static_cast<float>(2 * columns);
    const float wide = std::min(half_columns * scale, 0.5f * static_cast<float>(columns - 1));
    block.left = (column * per_unit + (turns - wide)).cast<int>();
    block.right = (column * per_unit + (turns + wide)).cast<int>();
    const Values middle = (row + 1) * per_unit;
    block.low = (middle - half_rows * scale).max(0.0f).cast<int>().min(rows - 1);
    block.high = (middle + half_rows * scale).max(0.0f).cast<int>().min(rows - 1);
    return block;
}

std::size_t DepthImage::bytes() const { return pixels_.capacity() * sizeof(Pixel); }

}  // namespace hagen::avoidance
