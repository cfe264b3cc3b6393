#include <hagen/segmentation/GroundSurface.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hagen {
namespace {

using Grid = Eigen::ArrayXXf;

constexpr int kCells = GroundSurface::kCells;
constexpr float kCell_m = GroundSurface::kCell_m;
constexpr float kReach_m = 0.5f * kCells * kCell_m;

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr float kStray_m = 0.4f;  // so far below its neighbours nothing is ground
constexpr int kStrayNeighbours = 3;
constexpr float kSteepest = 0.3f;         // slope of the ground against its plane, where it is seen
constexpr float kSteepestUnseen = 0.17f;  // and where it is not: tall things hide it, not hills
constexpr float kEnvelope_m = 0.15f;      // a cell may stand out of the steepest slopes by this
constexpr float kAboveLowest_m = 0.05f, kBelowLowest_m = 0.1f;  // what a cell's mean is taken of
constexpr float kSureReturns = 5;  // a mean of so many has its full weight

int cellOf(float coordinate_m) {
    const float cell = std::floor((coordinate_m + kReach_m) / kCell_m);
    return cell >= 0 && cell < kCells ? static_cast<int>(cell) : -1;
}

template <class Visit>
void forEachCandidate(const PixelPoints& pixels, const Image<bool>& is_candidate, Visit visit) {
    for (Eigen::Index pixel = 0; pixel < is_candidate.size(); ++pixel) {
        if (!is_candidate.data()[pixel]) continue;
        const int i = cellOf(pixels.x_m.data()[pixel]), j = cellOf(pixels.y_m.data()[pixel]);
        if (i >= 0 && j >= 0) visit(i, j, pixels.z_m.data()[pixel]);
    }
}

Grid lowestOfCells(const PixelPoints& pixels, const Image<bool>& is_candidate) {
    Grid lowest_m = Grid::Constant(kCells, kCells, kNone);
    forEachCandidate(pixels, is_candidate, [&](int i, int j, float z_m) {
        lowest_m(i, j) = std::min(lowest_m(i, j), z_m);
    });
    return lowest_m;
}

/// Step 1: returns below the ground do not count.
Grid withoutStrays(const Grid& lowest_m) {
    Grid cleaned_m = lowest_m;
    for (int j = 0; j < kCells; ++j) {
        for (int i = 0; i < kCells; ++i) {
            if (lowest_m(i, j) == kNone) continue;
            int higher = 0;
            float lowest_around_m = kNone;
            for (int y = std::max(j - 1, 0); y <= std::min(j + 1, kCells - 1); ++y) {
                for (int x = std::max(i - 1, 0); x <= std::min(i + 1, kCells - 1); ++x) {
                    if ((x == i && y == j) || lowest_m(x, y) == kNone) continue;
                    higher += lowest_m(x, y) - lowest_m(i, j) > kStray_m;
                    lowest_around_m = std::min(lowest_around_m, lowest_m(x, y));
                }
            }
            if (higher >= kStrayNeighbours) {
                cleaned_m(i, j) = std::max(lowest_m(i, j), lowest_around_m);
            }
        }
    }
    return cleaned_m;
}

/// The greatest surface below `height_m` that is nowhere too steep: kSteepest in a cell that has a
/// height, kSteepestUnseen in one that has none. Distances are those of a chamfer in two passes
/// (Borgefors 1986).
Grid lowerEnvelope(const Grid& height_m) {
    Grid e = Grid::Constant(kCells + 2, kCells + 2, kNone);  // with a border all around
    e.block(1, 1, kCells, kCells) = height_m;
    const Grid side_m =
        kCell_m * (e == kNone)
                      .select(Grid::Constant(kCells + 2, kCells + 2, kSteepestUnseen),
                              Grid::Constant(kCells + 2, kCells + 2, kSteepest));
    const float corner = std::sqrt(2.0f);
    for (int j = 1; j <= kCells; ++j) {
        for (int i = 1; i <= kCells; ++i) {
            const float sides_m = std::min(e(i - 1, j), e(i, j - 1));
            const float corners_m = std::min(e(i - 1, j - 1), e(i + 1, j - 1));
            e(i, j) =
                std::min({e(i, j), sides_m + side_m(i, j), corners_m + corner * side_m(i, j)});
        }
    }
    for (int j = kCells; j >= 1; --j) {
        for (int i = kCells; i >= 1; --i) {
            const float sides_m = std::min(e(i + 1, j), e(i, j + 1));
            const float corners_m = std::min(e(i + 1, j + 1), e(i - 1, j + 1));
            e(i, j) =
                std::min({e(i, j), sides_m + side_m(i, j), corners_m + corner * side_m(i, j)});
        }
    }
    return e.block(1, 1, kCells, kCells);
}

/// Heights and how much each is to be trusted, 0 to 1.
struct WeightedGrid {
    Grid height_m, weight;
};

WeightedGrid binomial(const WeightedGrid& grid) {
    static constexpr float kKernel[3] = {0.25f, 0.5f, 0.25f};
    WeightedGrid smooth{Grid::Zero(kCells, kCells), Grid::Zero(kCells, kCells)};
    for (int j = 0; j < kCells; ++j) {
        for (int i = 0; i < kCells; ++i) {
            float sum_m = 0, weights = 0;
            for (int y = std::max(j - 1, 0); y <= std::min(j + 1, kCells - 1); ++y) {
                for (int x = std::max(i - 1, 0); x <= std::min(i + 1, kCells - 1); ++x) {
                    const float w = kKernel[x - i + 1] * kKernel[y - j + 1] * grid.weight(x, y);
                    sum_m += w * grid.height_m(x, y);
                    weights += w;
                }
            }
            if (weights > 0) smooth.height_m(i, j) = sum_m / weights;
            smooth.weight(i, j) = weights;
        }
    }
    return smooth;
}

/// Each coarse cell is the weighted mean of the four it covers.
WeightedGrid pull(const WeightedGrid& fine) {
    const Eigen::Index cells = fine.weight.rows() / 2;
    WeightedGrid coarse{Grid::Zero(cells, cells), Grid::Zero(cells, cells)};
    for (Eigen::Index j = 0; j < cells; ++j) {
        for (Eigen::Index i = 0; i < cells; ++i) {
            const auto weight = fine.weight.block<2, 2>(2 * i, 2 * j);
            const float weights = weight.sum();
            if (!(weights > 0)) continue;
            coarse.height_m(i, j) =
                (weight * fine.height_m.block<2, 2>(2 * i, 2 * j)).sum() / weights;
            coarse.weight(i, j) = std::min(1.0f, weights);
        }
    }
    return coarse;
}

float bilinear(const Grid& grid, float i, float j) {
    const Eigen::Index last = grid.rows() - 1;
    i = std::clamp(i, 0.0f, static_cast<float>(last));
    j = std::clamp(j, 0.0f, static_cast<float>(last));
    const Eigen::Index i0 = static_cast<Eigen::Index>(i), j0 = static_cast<Eigen::Index>(j);
    const Eigen::Index i1 = std::min(i0 + 1, last), j1 = std::min(j0 + 1, last);
    const float u = i - static_cast<float>(i0), v = j - static_cast<float>(j0);
    return (1 - u) * ((1 - v) * grid(i0, j0) + v * grid(i0, j1)) +
           u * ((1 - v) * grid(i1, j0) + v * grid(i1, j1));
}

/// What a fine cell lacks in weight it takes from the coarse grid.
void push(const Grid& coarse_m, WeightedGrid& fine) {
    for (Eigen::Index j = 0; j < fine.weight.cols(); ++j) {
        for (Eigen::Index i = 0; i < fine.weight.rows(); ++i) {
            const float w = fine.weight(i, j);
            if (w >= 1) continue;
            const float below_m = bilinear(coarse_m, 0.5f * static_cast<float>(i) - 0.25f,
                                           0.5f * static_cast<float>(j) - 0.25f);
            fine.height_m(i, j) = w * fine.height_m(i, j) + (1 - w) * below_m;
        }
    }
}

Grid filled(const WeightedGrid& grid) {
    std::vector<WeightedGrid> levels{grid};
    while (levels.back().weight.rows() > 1) levels.push_back(pull(levels.back()));
    for (std::size_t level = levels.size() - 1; level > 0; --level) {
        push(levels[level].height_m, levels[level - 1]);
    }
    return levels.front().height_m;
}

/// Whether a height above the first fit can be ground: the farther away, the less is known.
bool isCloseToGround(float height_m, float distance_m) {
    return height_m > -0.2f - 0.01f * distance_m && height_m < 0.2f + 0.005f * distance_m;
}

}  // namespace

float GroundSurface::at(float x_m, float y_m) const {
    return bilinear(height_m, (x_m + kReach_m) / kCell_m - 0.5f, (y_m + kReach_m) / kCell_m - 0.5f);
}

void fitGroundSurface(const PixelPoints& pixels, const Image<bool>& is_candidate,
                      GroundSurface& surface) {
    const Grid lowest_m = withoutStrays(lowestOfCells(pixels, is_candidate));
    const Grid envelope_m = lowerEnvelope(lowest_m);

    WeightedGrid grid{Grid::Zero(kCells, kCells), Grid::Zero(kCells, kCells)};
    forEachCandidate(pixels, is_candidate, [&](int i, int j, float z_m) {
        const bool is_ground = lowest_m(i, j) <= envelope_m(i, j) + kEnvelope_m;
        const float above_m = z_m - lowest_m(i, j);
        if (!is_ground || above_m < -kBelowLowest_m || above_m > kAboveLowest_m) return;
        grid.height_m(i, j) += z_m;
        grid.weight(i, j) += 1;
    });
    grid.height_m = (grid.weight > 0).select(grid.height_m / grid.weight, 0.0f);
    grid.weight = (grid.weight / kSureReturns).min(1.0f);
    surface.height_m = filled(binomial(grid));
}

void fitGroundSurface(const PixelPoints& pixels, const Image<Label>& labels,
                      GroundSurface& surface) {
    Image<bool> is_candidate = labels == Label::Rou;
    fitGroundSurface(pixels, is_candidate, surface);

    Image<float> height_m;
    heightsAbove(surface, pixels, height_m);
    for (Eigen::Index pixel = 0; pixel < labels.size(); ++pixel) {
        const float distance_m = std::hypot(pixels.x_m.data()[pixel], pixels.y_m.data()[pixel]);
        is_candidate.data()[pixel] = isCloseToGround(height_m.data()[pixel], distance_m);
    }
    fitGroundSurface(pixels, is_candidate, surface);
}

void heightsAbove(const GroundSurface& surface, const PixelPoints& pixels, Image<float>& height_m) {
    height_m.resize(pixels.z_m.rows(), pixels.z_m.cols());
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        const float x_m = pixels.x_m.data()[pixel], y_m = pixels.y_m.data()[pixel];
        height_m.data()[pixel] =
            hasValue(x_m) ? pixels.z_m.data()[pixel] - surface.at(x_m, y_m) : kNoValue;
    }
}

}  // namespace hagen
