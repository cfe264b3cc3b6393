#include "support/PlainGround.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

// Each stage is in its own namespace, because they use the same names.
namespace hagen::test::plain {
namespace {

/// The cell of a coordinate along one axis, counted from the grid's edge. Rounded like the fast
/// stages: points within some micrometres of a cell border may be in either cell.
float wholeCells(float coordinate_m, int cells = GroundSurface::kCells) {
    const float width_m =
        GroundSurface::kCell_m * GroundSurface::kCells / static_cast<float>(cells);
    return std::floor(coordinate_m * (1 / width_m) + static_cast<float>(cells / 2 + 1)) - 1;
}

}  // namespace

namespace surface_stage {
namespace {

using Grid = Eigen::ArrayXXf;  // over the square, with any number of cells per side

constexpr float kReach_m = 0.5f * GroundSurface::kCells * GroundSurface::kCell_m;
constexpr int kCoarseCells = 64;              // of the first fit to labels
constexpr Eigen::Index kCoarseColumns = 200;  // of an image: this many are enough

float widthOfCell_m(const Grid& grid) { return 2 * kReach_m / static_cast<float>(grid.rows()); }

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr float kStray_m = 0.4f;  // ground is never this far below its neighbours
constexpr int kStrayNeighbours = 3;
constexpr float kSteepest = 0.3f;         // maximum slope of visible ground against its plane
constexpr float kSteepestUnseen = 0.15f;  // and of hidden ground: tall objects hide it, not hills
constexpr float kEnvelope_m = 0.15f;      // maximum height of a cell above the steepest slopes
constexpr float kAboveLowest_m = 0.05f, kBelowLowest_m = 0.1f;  // candidates close to the lowest
constexpr float kSureReturns = 5;  // a mean over this many has full weight

int cellOf(float coordinate_m, int cells) {
    const float cell = wholeCells(coordinate_m, cells);
    return cell >= 0 && cell < static_cast<float>(cells) ? static_cast<int>(cell) : -1;
}

template <class Visit>
void forEachCandidate(const PixelPoints& pixels, const Image<bool>& is_candidate, int cells,
                      Visit visit) {
    for (Eigen::Index pixel = 0; pixel < is_candidate.size(); ++pixel) {
        if (!is_candidate.data()[pixel]) continue;
        const int i = cellOf(pixels.x_m.data()[pixel], cells);
        const int j = cellOf(pixels.y_m.data()[pixel], cells);
        if (i >= 0 && j >= 0) visit(i, j, pixels.z_m.data()[pixel]);
    }
}

Grid lowestOfCells(const PixelPoints& pixels, const Image<bool>& is_candidate, int cells) {
    Grid lowest_m = Grid::Constant(cells, cells, kNone);
    forEachCandidate(pixels, is_candidate, cells, [&](int i, int j, float z_m) {
        lowest_m(i, j) = std::min(lowest_m(i, j), z_m);
    });
    return lowest_m;
}

/// Step 1: ignores returns below the ground.
Grid withoutStrays(const Grid& lowest_m) {
    const int cells = static_cast<int>(lowest_m.rows());
    Grid cleaned_m = lowest_m;
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            if (lowest_m(i, j) == kNone) continue;
            int higher = 0;
            float lowest_around_m = kNone;
            for (int y = std::max(j - 1, 0); y <= std::min(j + 1, cells - 1); ++y) {
                for (int x = std::max(i - 1, 0); x <= std::min(i + 1, cells - 1); ++x) {
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

/// The highest surface below `height_m` that is nowhere too steep: kSteepest in cells with a
/// height, kSteepestUnseen in others. Distances are those of a two-pass chamfer transform
/// (Borgefors 1986).
Grid lowerEnvelope(const Grid& height_m) {
    const int cells = static_cast<int>(height_m.rows());
    Grid e = Grid::Constant(cells + 2, cells + 2, kNone);  // with a border on all sides
    e.block(1, 1, cells, cells) = height_m;
    const Grid side_m =
        widthOfCell_m(height_m) * (e == kNone)
                                      .select(Grid::Constant(cells + 2, cells + 2, kSteepestUnseen),
                                              Grid::Constant(cells + 2, cells + 2, kSteepest));
    const float corner = std::sqrt(2.0f);
    for (int j = 1; j <= cells; ++j) {
        for (int i = 1; i <= cells; ++i) {
            const float sides_m = std::min(e(i - 1, j), e(i, j - 1));
            const float corners_m = std::min(e(i - 1, j - 1), e(i + 1, j - 1));
            e(i, j) =
                std::min({e(i, j), sides_m + side_m(i, j), corners_m + corner * side_m(i, j)});
        }
    }
    for (int j = cells; j >= 1; --j) {
        for (int i = cells; i >= 1; --i) {
            const float sides_m = std::min(e(i + 1, j), e(i, j + 1));
            const float corners_m = std::min(e(i + 1, j + 1), e(i - 1, j + 1));
            e(i, j) =
                std::min({e(i, j), sides_m + side_m(i, j), corners_m + corner * side_m(i, j)});
        }
    }
    return e.block(1, 1, cells, cells);
}

/// Heights and their weights, 0 to 1.
struct WeightedGrid {
    Grid height_m, weight;
};

WeightedGrid binomial(const WeightedGrid& grid) {
    static constexpr float kKernel[3] = {0.25f, 0.5f, 0.25f};
    const int cells = static_cast<int>(grid.weight.rows());
    WeightedGrid smooth{Grid::Zero(cells, cells), Grid::Zero(cells, cells)};
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            float sum_m = 0, weights = 0;
            for (int y = std::max(j - 1, 0); y <= std::min(j + 1, cells - 1); ++y) {
                for (int x = std::max(i - 1, 0); x <= std::min(i + 1, cells - 1); ++x) {
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

/// Each coarse cell is the weighted mean of the four cells it covers.
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

/// A fine cell takes its missing weight from the coarse grid.
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

/// Whether a height above the first fit may be ground; the tolerance grows with distance.
bool isCloseToGround(float height_m, float distance_m) {
    return height_m > -0.2f - 0.01f * distance_m && height_m < 0.2f + 0.005f * distance_m;
}

float surfaceAt(const Grid& surface_m, float x_m, float y_m) {
    const float width_m = widthOfCell_m(surface_m);
    return bilinear(surface_m, (x_m + kReach_m) / width_m - 0.5f,
                    (y_m + kReach_m) / width_m - 0.5f);
}

/// Of a cell of the surface.
float middleOf(int cell) {
    return (static_cast<float>(cell) + 0.5f) * GroundSurface::kCell_m - kReach_m;
}

/// Steps 3 and 4; `lowest_m` in ground cells, kNone elsewhere.
Grid surfaceAbout(const Grid& lowest_m, const PixelPoints& pixels,
                  const Image<bool>& is_candidate) {
    const int cells = static_cast<int>(lowest_m.rows());
    WeightedGrid grid{Grid::Zero(cells, cells), Grid::Zero(cells, cells)};
    forEachCandidate(pixels, is_candidate, cells, [&](int i, int j, float z_m) {
        const float above_m = z_m - lowest_m(i, j);
        if (!(above_m >= -kBelowLowest_m && above_m <= kAboveLowest_m)) return;
        grid.height_m(i, j) += z_m;
        grid.weight(i, j) += 1;
    });
    grid.height_m = (grid.weight > 0).select(grid.height_m / grid.weight, 0.0f);
    grid.weight = (grid.weight / kSureReturns).min(1.0f);
    return filled(binomial(grid));
}

/// All four steps.
Grid wholeFit(const PixelPoints& pixels, const Image<bool>& is_candidate, int cells) {
    const Grid lowest_m = withoutStrays(lowestOfCells(pixels, is_candidate, cells));
    const Grid envelope_m = lowerEnvelope(lowest_m);
    return surfaceAbout((lowest_m <= envelope_m + kEnvelope_m).select(lowest_m, kNone), pixels,
                        is_candidate);
}

}  // namespace

void heightsAbove(const GroundSurface& surface, const PixelPoints& pixels, Image<float>& height_m) {
    height_m.resize(pixels.z_m.rows(), pixels.z_m.cols());
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        const float x_m = pixels.x_m.data()[pixel], y_m = pixels.y_m.data()[pixel];
        height_m.data()[pixel] =
            hasValue(x_m) ? pixels.z_m.data()[pixel] - surfaceAt(surface.height_m, x_m, y_m)
                          : kNoValue;
    }
}

void fitGroundSurface(const PixelPoints& pixels, const Image<Label>& labels,
                      GroundSurface& surface) {
    const Eigen::Index step = std::max<Eigen::Index>(1, labels.cols() / kCoarseColumns);
    Image<bool> is_candidate = labels == Label::Rou;
    for (Eigen::Index column = 0; column < labels.cols(); ++column) {
        if (column % step != 0) is_candidate.col(column) = false;
    }
    const Grid coarse_m = wholeFit(pixels, is_candidate, kCoarseCells);
    for (Eigen::Index pixel = 0; pixel < labels.size(); ++pixel) {
        const float x_m = pixels.x_m.data()[pixel], y_m = pixels.y_m.data()[pixel];
        const int i = cellOf(x_m, GroundSurface::kCells), j = cellOf(y_m, GroundSurface::kCells);
        const bool is_close = i >= 0 && j >= 0 &&
                              isCloseToGround(pixels.z_m.data()[pixel] -
                                                  surfaceAt(coarse_m, middleOf(i), middleOf(j)),
                                              std::hypot(x_m, y_m));
        is_candidate.data()[pixel] = is_close;
    }
    surface.height_m = surfaceAbout(lowestOfCells(pixels, is_candidate, GroundSurface::kCells),
                                    pixels, is_candidate);
}

}  // namespace surface_stage

namespace labels_stage {
namespace {

constexpr float kLeastTolerance_m = 0.04f;
constexpr float kTallest_m = 1.1f;       // taller objects do not reduce the tolerance further
constexpr float kFootHeight_m = 0.015f;  // minimum height of a foot
constexpr int kFootRows = 4;             // maximum rows from a foot up to the obstacle
constexpr float kDoubt_m = 0.2f;         // heights this close to the tolerance are voted on
constexpr float kVoteReach_m = 1.0f;     // in distance from the sensor
constexpr int kLeastVotes = 3;

}  // namespace

void toleratedHeights(const PixelPoints& pixels, const Image<float>& height_m,
                      const HeightTolerance& tolerance, float sensor_height_m,
                      Image<float>& tolerance_m) {
    constexpr int kCells = GroundSurface::kCells;
    // With a border.
    Eigen::Array<std::vector<float>, Eigen::Dynamic, Eigen::Dynamic> in_cell_m(kCells + 2,
                                                                               kCells + 2);
    const auto cellOf = [&](float coordinate_m) {
        const float cell = wholeCells(coordinate_m);
        return static_cast<int>(std::clamp(cell, -1.0f, static_cast<float>(kCells))) + 1;
    };
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        const float h_m = height_m.data()[pixel];
        if (!(h_m < 1.5f)) continue;  // empty or overhead
        in_cell_m(cellOf(pixels.x_m.data()[pixel]), cellOf(pixels.y_m.data()[pixel]))
            .push_back(h_m);
    }
    Eigen::ArrayXXf tallest_m = Eigen::ArrayXXf::Zero(kCells + 2, kCells + 2);
    for (Eigen::Index cell = 0; cell < tallest_m.size(); ++cell) {
        std::vector<float>& heights_m = in_cell_m.data()[cell];
        std::sort(heights_m.rbegin(), heights_m.rend());
        if (heights_m.empty()) continue;
        const float top_m = heights_m[heights_m.size() > 1 ? 1 : 0];
        tallest_m.data()[cell] = std::clamp(top_m, 0.0f, kTallest_m);
    }
    tolerance_m.setConstant(height_m.rows(), height_m.cols(), kNoValue);
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        if (!hasValue(height_m.data()[pixel])) continue;
        const float x_m = pixels.x_m.data()[pixel], y_m = pixels.y_m.data()[pixel];
        const int i = std::clamp(cellOf(x_m), 1, kCells), j = std::clamp(cellOf(y_m), 1, kCells);
        const float tall_m = std::max(tallest_m.block<3, 1>(i - 1, j).maxCoeff(),
                                      std::max(tallest_m(i, j - 1), tallest_m(i, j + 1)));
        const float distance_m = std::hypot(x_m, y_m);
        const float shallow = std::min(distance_m / (3 * sensor_height_m), 1.0f);
        tolerance_m.data()[pixel] =
            std::max(kLeastTolerance_m, tolerance.near_m + tolerance.per_m * distance_m -
                                            tolerance.beside_tall * shallow * tall_m);
    }
}

void labelByHeight(const Image<float>& height_m, const Image<float>& tolerance_m,
                   Image<Label>& labels) {
    labels.resize(height_m.rows(), height_m.cols());
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        const float h_m = height_m.data()[pixel];
        const bool is_ground = h_m <= tolerance_m.data()[pixel] && h_m >= -1.5f;
        labels.data()[pixel] = !hasValue(h_m) ? Label::Unclassified
                               : is_ground    ? Label::Rou
                                              : Label::Roi;
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
    const auto distance = [&](int row, int column) {  // in steps of 1/64 m
        const float x_m = pixels.x_m(row, column), y_m = pixels.y_m(row, column);
        return std::floor(std::min(std::sqrt(x_m * x_m + y_m * y_m), 511.0f) * 64 + 0.5f) / 64;
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
}  // namespace labels_stage

namespace canopy_stage {
namespace {

constexpr int kCells = GroundSurface::kCells;
constexpr int kBlockCells = 4;
constexpr int kBlocks = kCells / kBlockCells;  // along each side, 3 m each
constexpr int kReach = 6;                      // blocks in each direction

constexpr float kLowest_m = 0.1f, kTallest_m = 1.0f;  // of a canopy's plants
constexpr float kLeastShare = 0.35f;                  // of the cells seen nearby
constexpr float kMostTall = 0.2f;                     // share of higher cells: walls, trees
constexpr float kLeastCells = 30;                     // seen nearby; with fewer, no canopy
constexpr float kDeviations = 2.0f;
constexpr float kMargin_m = 0.1f;
constexpr float kStandsOut_m = 0.1f;

/// The cell of a coordinate, or -1 beyond the grid.
int cellOf(float coordinate_m) {
    const float cell = wholeCells(coordinate_m);
    return cell >= 0 && cell < kCells ? static_cast<int>(cell) : -1;
}

/// The plants in the cells of one or more blocks.
struct Stand {
    float seen = 0;    ///< cells with returns
    float tall = 0;    ///< cells whose highest return is higher than plants
    float plants = 0;  ///< cells whose highest return is that of a low plant
    float sum_m = 0;   ///< sum of the plants' heights
    float sum_m2 = 0;  ///< sum of their squares

    void addCell(float top_m) {
        seen += 1;
        if (top_m >= kTallest_m) tall += 1;
        if (!(top_m > kLowest_m && top_m < kTallest_m)) return;
        plants += 1;
        sum_m += top_m;
        sum_m2 += top_m * top_m;
    }
    void add(const Stand& other) {
        seen += other.seen;
        tall += other.tall;
        plants += other.plants;
        sum_m += other.sum_m;
        sum_m2 += other.sum_m2;
    }
    /// The height that plants do not exceed; 0 without a canopy.
    float canopy_m() const {
        if (seen < kLeastCells || plants < kLeastShare * seen) return 0;
        if (tall > kMostTall * seen) return 0;
        const float mean_m = sum_m / plants;
        const float variance_m2 = std::max(sum_m2 / plants - mean_m * mean_m, 0.0f);
        return mean_m + std::min(kDeviations * std::sqrt(variance_m2), mean_m) + kMargin_m;
    }
};
using Stands = Eigen::Array<Stand, Eigen::Dynamic, Eigen::Dynamic>;

/// The sums over kReach blocks in each direction, along the first index.
Stands sumsAlong(const Stands& stands) {
    Stands sums(kBlocks, kBlocks);
    for (int j = 0; j < kBlocks; ++j) {
        for (int i = 0; i < kBlocks; ++i) {
            const int first = std::max(i - kReach, 0), last = std::min(i + kReach, kBlocks - 1);
            for (int k = first; k <= last; ++k) sums(i, j).add(stands(k, j));
        }
    }
    return sums;
}

}  // namespace

void tolerateCanopy(const PixelPoints& pixels, const Image<float>& height_m,
                    Image<float>& tolerance_m) {
    Eigen::ArrayXXf top_m = Eigen::ArrayXXf::Constant(kCells, kCells, kNoValue), second_m = top_m;
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        float h_m = height_m.data()[pixel];
        if (!(h_m < 1.5f)) continue;  // empty or overhead
        const int i = cellOf(pixels.x_m.data()[pixel]), j = cellOf(pixels.y_m.data()[pixel]);
        if (i < 0 || j < 0) continue;
        if (!(top_m(i, j) >= h_m)) std::swap(top_m(i, j), h_m);
        if (!(second_m(i, j) >= h_m)) second_m(i, j) = h_m;
    }
    Stands stands(kBlocks, kBlocks);
    for (int j = 0; j < kCells; ++j) {
        for (int i = 0; i < kCells; ++i) {
            if (hasValue(top_m(i, j)))
                stands(i / kBlockCells, j / kBlockCells).addCell(top_m(i, j));
        }
    }
    const Stands around = sumsAlong(sumsAlong(stands).transpose()).transpose();
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        if (!hasValue(height_m.data()[pixel])) continue;
        const int i = cellOf(pixels.x_m.data()[pixel]), j = cellOf(pixels.y_m.data()[pixel]);
        if (i < 0 || j < 0) continue;
        float& tolerated_m = tolerance_m.data()[pixel];
        const float canopy_m = around(i / kBlockCells, j / kBlockCells).canopy_m();
        const float stands_m = hasValue(second_m(i, j)) ? second_m(i, j) : top_m(i, j);
        if (stands_m > canopy_m + kStandsOut_m) continue;
        tolerated_m = std::max(tolerated_m, canopy_m);
    }
}
}  // namespace canopy_stage

namespace evidence_stage {
namespace {

constexpr int kCells = GroundSurface::kCells;
constexpr int kBlockCells = 4;
constexpr int kBlocks = kCells / kBlockCells;  // along each side, 3 m each
constexpr int kReach = 4;                      // blocks in each direction

constexpr float kSteepest = 0.3f;  // slope of a level step
constexpr float kShort_m = 0.08f;  // a step as short as this is too noisy
constexpr float kFar_m = 2.0f;     // no step over other pixels is longer
constexpr int kAbove = 4;          // pixels above that a step may lead to
constexpr float kDrop_m = 0.3f;    // nothing in a cell is farther below a level pixel
constexpr float kLeastShare = 0.55f;

/// The cell of a coordinate; all coordinates beyond the grid are in the cells around it.
int cellOf(float coordinate_m) {
    return static_cast<int>(
        std::clamp(wholeCells(coordinate_m), -1.0f, static_cast<float>(kCells)));
}

bool isLevelStep(const Eigen::Vector3f& below, const Eigen::Vector3f& above) {
    const Eigen::Vector3f step = above - below;
    const float run_m2 = step.x() * step.x() + step.y() * step.y();
    const float outwards = step.x() * below.x() + step.y() * below.y();
    return outwards > 0 && step.z() * step.z() < kSteepest * kSteepest * run_m2;
}

/// Pixels close to the surface, and those of them that are level.
struct Counts {
    int close = 0, level = 0;
};
using Blocks = Eigen::Array<Counts, kBlocks, kBlocks>;

bool hasEvidence(const Blocks& blocks, int i, int j) {
    Counts around;
    for (int y = std::max(j - kReach, 0); y <= std::min(j + kReach, kBlocks - 1); ++y) {
        for (int x = std::max(i - kReach, 0); x <= std::min(i + kReach, kBlocks - 1); ++x) {
            around.close += blocks(x, y).close;
            around.level += blocks(x, y).level;
        }
    }
    return around.level > 0 &&
           static_cast<float>(around.level) >= kLeastShare * static_cast<float>(around.close);
}

}  // namespace

void findLevelPixels(const PixelPoints& pixels, Image<std::uint8_t>& is_level) {
    const Eigen::Index rows = pixels.x_m.rows(), columns = pixels.x_m.cols();
    constexpr float kNone = std::numeric_limits<float>::infinity();
    Eigen::ArrayXXf lowest_m = Eigen::ArrayXXf::Constant(kCells + 2, kCells + 2, kNone);
    for (Eigen::Index pixel = 0; pixel < rows * columns; ++pixel) {
        const Eigen::Vector3f point = pixels.at(pixel);
        if (!hasValue(point.z())) continue;
        float& low_m = lowest_m(cellOf(point.x()) + 1, cellOf(point.y()) + 1);
        low_m = std::min(low_m, point.z());
    }
    is_level.setZero(rows, columns);
    for (Eigen::Index column = 0; column < columns; ++column) {
        for (Eigen::Index row = 0; row < rows; ++row) {
            const Eigen::Index pixel = column * rows + row;
            const Eigen::Vector3f point = pixels.at(pixel);
            if (!hasValue(point.z())) continue;
            // Whether the pixels in these rows of the column are a step.
            const auto isStep = [&](Eigen::Index low, Eigen::Index high) {
                if (low < 0 || high >= rows) return false;
                const Eigen::Vector3f below = pixels.at(column * rows + low);
                const Eigen::Vector3f above = pixels.at(column * rows + high);
                if (high > low + 1 && !((above - below).squaredNorm() < kFar_m * kFar_m)) {
                    return false;
                }
                for (Eigen::Index between = low + 1; between < high; ++between) {
                    const Eigen::Vector3f other = pixels.at(column * rows + between);
                    if ((other - below).squaredNorm() >= kShort_m * kShort_m) return false;
                }
                return isLevelStep(below, above);
            };
            bool is_on_step = false;
            for (Eigen::Index k = 1; k <= kAbove; ++k) {
                is_on_step = is_on_step || isStep(row, row + k) || isStep(row - k, row);
            }
            const float low_m = lowest_m(cellOf(point.x()) + 1, cellOf(point.y()) + 1);
            is_level(row, column) = is_on_step && point.z() <= low_m + kDrop_m;
        }
    }
}

void keepLevelRou(const Image<Label>& labels, const Image<std::uint8_t>& is_level,
                  Image<Label>& candidates) {
    candidates.setConstant(labels.rows(), labels.cols(), Label::Unclassified);
    for (Eigen::Index pixel = 0; pixel < labels.size(); ++pixel) {
        if (labels.data()[pixel] == Label::Rou && is_level.data()[pixel] == 1) {
            candidates.data()[pixel] = Label::Rou;
        }
    }
}

void requireEvidence(const PixelPoints& pixels, const Image<float>& height_m,
                     const Image<std::uint8_t>& is_level, Image<float>& tolerance_m) {
    struct Block {
        int i, j;
        bool is_on_grid;
    };
    const auto blockOf = [&](Eigen::Index pixel) {
        const int i = cellOf(pixels.x_m.data()[pixel]), j = cellOf(pixels.y_m.data()[pixel]);
        return Block{i / kBlockCells, j / kBlockCells,
                     i >= 0 && i < kCells && j >= 0 && j < kCells};
    };
    Blocks blocks;
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        if (!hasValue(height_m.data()[pixel])) continue;
        const float x_m = pixels.x_m.data()[pixel], y_m = pixels.y_m.data()[pixel];
        const float most_m = 0.2f + 0.005f * std::sqrt(x_m * x_m + y_m * y_m);
        const Block block = blockOf(pixel);
        if (!block.is_on_grid || !(std::abs(height_m.data()[pixel]) < most_m)) continue;
        ++blocks(block.i, block.j).close;
        blocks(block.i, block.j).level += is_level.data()[pixel];
    }
    Eigen::Array<bool, kBlocks, kBlocks> is_ground;
    for (int j = 0; j < kBlocks; ++j) {
        for (int i = 0; i < kBlocks; ++i) is_ground(i, j) = hasEvidence(blocks, i, j);
    }
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        if (!hasValue(tolerance_m.data()[pixel])) continue;
        const Block block = blockOf(pixel);
        if (block.is_on_grid && is_ground(block.i, block.j)) continue;
        tolerance_m.data()[pixel] = -std::numeric_limits<float>::infinity();
    }
}
}  // namespace evidence_stage

namespace frame_stage {
namespace {

constexpr float kCell_m = 0.75f;
constexpr float kReach_m = 40.0f;
constexpr int kCells = 107;  // 2 kReach_m / kCell_m, rounded up

constexpr Eigen::Index kColumns = 200;  // of an image: this many are enough
constexpr int kRounds = 6;
constexpr double kFirstScale_m = 1.0;  // of residuals, in the first round
constexpr double kScaleStep = 0.8;
constexpr double kLeastScale_m = 0.3;
constexpr double kAbove = 2.0, kBelow = 1.0;  // weights fall faster above the ground
constexpr double kRangeScale_m2 = 400.0;      // 20 m, squared

/// The lowest point of each cell that has points.
std::vector<Eigen::Vector3d> lowestOfCells(const PixelPoints& pixels,
                                           const Eigen::Matrix3f& rotation) {
    std::vector<Eigen::Vector3f> lowest(kCells * kCells, Eigen::Vector3f::Constant(kNoValue));
    const Eigen::Index step = std::max<Eigen::Index>(1, pixels.x_m.cols() / kColumns);
    for (Eigen::Index pixel = 0; pixel < pixels.x_m.size(); ++pixel) {
        if (pixel / pixels.x_m.rows() % step != 0 || !hasValue(pixels.x_m.data()[pixel])) continue;
        const Eigen::Vector3f point = rotation * pixels.at(pixel);
        const float u = (point.x() + kReach_m) / kCell_m, v = (point.y() + kReach_m) / kCell_m;
        if (!(u >= 0 && v >= 0 && u < kCells && v < kCells)) continue;
        Eigen::Vector3f& low = lowest[static_cast<int>(u) * kCells + static_cast<int>(v)];
        if (!(low.z() <= point.z())) low = point;
    }
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector3f& point : lowest) {
        if (hasValue(point.z())) points.push_back(point.cast<double>());
    }
    return points;
}

/// The plane z = a x + b y + c through the points, by weighted least squares.
template <class Weight>
Eigen::Vector3d planeThrough(const std::vector<Eigen::Vector3d>& points, Weight weight) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-9;  // allows collinear points
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : points) {
        const Eigen::Vector3d row(p.x(), p.y(), 1);
        const double w = weight(p);
        normal += w * row * row.transpose();
        right += w * p.z() * row;
    }
    return normal.ldlt().solve(right);
}

Eigen::Vector3d fitPlane(const std::vector<Eigen::Vector3d>& points) {
    const auto nearness = [](const Eigen::Vector3d& p) {
        return 1.0 / (1.0 + p.head<2>().squaredNorm() / kRangeScale_m2);
    };
    Eigen::Vector3d plane = planeThrough(points, nearness);
    double scale_m = kFirstScale_m;
    for (int round = 0; round < kRounds; ++round) {
        plane = planeThrough(points, [&](const Eigen::Vector3d& p) {
            const double residual_m = p.z() - plane.dot(Eigen::Vector3d(p.x(), p.y(), 1));
            const double step = residual_m / scale_m;
            const double doubt = 1.0 + (residual_m > 0 ? kAbove : kBelow) * step * step;
            return nearness(p) / (doubt * doubt);
        });
        scale_m = std::max(kLeastScale_m, scale_m * kScaleStep);
    }
    return plane;
}

}  // namespace

Eigen::Isometry3f fitGroundFrame(const PixelPoints& pixels, const Attitude& attitude) {
    const Eigen::Matrix3f level = levelFromSensor(attitude);
    const std::vector<Eigen::Vector3d> points = lowestOfCells(pixels, level);

    Eigen::Vector3d plane = Eigen::Vector3d::Zero();
    if (points.size() >= 3) {
        plane = fitPlane(points);
    } else if (!points.empty()) {
        plane.z() = std::min(points.front().z(), points.back().z());
    }
    const Eigen::Vector3d normal = Eigen::Vector3d(-plane.x(), -plane.y(), 1).normalized();
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(normal, Eigen::Vector3d::UnitZ());

    Eigen::Isometry3f ground_from_sensor = Eigen::Isometry3f::Identity();
    ground_from_sensor.linear() = turn.toRotationMatrix().cast<float>() * level;
    ground_from_sensor.translation().z() = static_cast<float>(-plane.z() * normal.z());
    return ground_from_sensor;
}
}  // namespace frame_stage

namespace points_stage {
void locatePixels(const Scan& scan, const PixelDirections& directions, const RangeImage& image,
                  const Image<float>& depth_m, PixelPoints& pixels) {
    const int rows = static_cast<int>(depth_m.rows()), columns = static_cast<int>(depth_m.cols());
    for (auto* coordinate : {&pixels.x_m, &pixels.y_m, &pixels.z_m}) {
        coordinate->setConstant(rows, columns, kNoValue);
    }
    for (Eigen::Index pixel = 0; pixel < depth_m.size(); ++pixel) {
        const std::int32_t i = image.closest_return.data()[pixel];
        if (i != RangeImage::kNoReturn) {
            pixels.set(pixel, {scan.x_m[i], scan.y_m[i], scan.z_m[i]});
        } else if (hasValue(depth_m.data()[pixel])) {
            const Eigen::Index row = pixel % rows, column = pixel / rows;
            const float level_m = depth_m.data()[pixel] * directions.row_cosine[row];
            pixels.set(pixel, {level_m * directions.column_cosine[column],
                               level_m * directions.column_sine[column],
                               depth_m.data()[pixel] * directions.row_sine[row]});
        }
    }
}

void movePixels(const Eigen::Isometry3f& to_from_here, PixelPoints& pixels) {
    for (Eigen::Index pixel = 0; pixel < pixels.x_m.size(); ++pixel) {
        pixels.set(pixel, to_from_here * pixels.at(pixel));
    }
}
}  // namespace points_stage

Eigen::Isometry3f fitGroundFrame(const PixelPoints& pixels, const Attitude& attitude) {
    return frame_stage::fitGroundFrame(pixels, attitude);
}
void locatePixels(const Scan& scan, const PixelDirections& directions, const RangeImage& image,
                  const Image<float>& depth_m, PixelPoints& pixels) {
    points_stage::locatePixels(scan, directions, image, depth_m, pixels);
}
void fitGroundSurface(const PixelPoints& pixels, const Image<Label>& labels,
                      GroundSurface& surface) {
    surface_stage::fitGroundSurface(pixels, labels, surface);
}
void findLevelPixels(const PixelPoints& pixels, Image<std::uint8_t>& is_level) {
    evidence_stage::findLevelPixels(pixels, is_level);
}
void keepLevelRou(const Image<Label>& labels, const Image<std::uint8_t>& is_level,
                  Image<Label>& candidates) {
    evidence_stage::keepLevelRou(labels, is_level, candidates);
}
void heightsAbove(const GroundSurface& surface, const PixelPoints& pixels, Image<float>& height_m) {
    surface_stage::heightsAbove(surface, pixels, height_m);
}
void toleratedHeights(const PixelPoints& pixels, const Image<float>& height_m,
                      const HeightTolerance& tolerance, float sensor_height_m,
                      Image<float>& tolerance_m) {
    labels_stage::toleratedHeights(pixels, height_m, tolerance, sensor_height_m, tolerance_m);
}
void tolerateCanopy(const PixelPoints& pixels, const Image<float>& height_m,
                    Image<float>& tolerance_m) {
    canopy_stage::tolerateCanopy(pixels, height_m, tolerance_m);
}
void requireEvidence(const PixelPoints& pixels, const Image<float>& height_m,
                     const Image<std::uint8_t>& is_level, Image<float>& tolerance_m) {
    evidence_stage::requireEvidence(pixels, height_m, is_level, tolerance_m);
}
void labelByHeight(const Image<float>& height_m, const Image<float>& tolerance_m,
                   Image<Label>& labels) {
    labels_stage::labelByHeight(height_m, tolerance_m, labels);
}
void growFeet(const PixelPoints& pixels, const Image<float>& height_m, Image<Label>& labels) {
    labels_stage::growFeet(pixels, height_m, labels);
}
void removeSpecks(const PixelPoints& pixels, const Image<float>& height_m,
                  const Image<float>& tolerance_m, Image<Label>& labels) {
    labels_stage::removeSpecks(pixels, height_m, tolerance_m, labels);
}

}  // namespace hagen::test::plain
