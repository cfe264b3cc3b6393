#include <algorithm>
#include <cmath>
#include <vector>

#include "filter/ground/GroundGrid.h"
#include "filter/ground/StageRules.h"
#include "filter/plain/PlainStages.h"

namespace hagen::plain {
namespace {

using namespace surface_rules;

using Grid = Eigen::ArrayXXf;  // one value per cell
constexpr int kCells = GroundSurface::kCells, kCoarseCells = kCells / 2;

/// A pixel that may be ground.
struct Candidate {
    int i, j;  ///< cell of the pixel
    float z_m;
};
using Candidates = std::vector<Candidate>;

/// The cell of a coordinate along one axis; -1 if it is NaN or beyond the grid.
int cellOf(float coordinate_m, int cells) {
    const float per_m = static_cast<float>(cells) / (kCells * GroundSurface::kCell_m);
    const int middle = cells / 2 + 1;
    const float place = coordinate_m * per_m + static_cast<float>(middle);
    return place >= 1 && place < static_cast<float>(cells + 1) ? static_cast<int>(place) - 1 : -1;
}

/// Appends a pixel if it is on the grid and isCandidate(its cell).
template <class IsCandidate>
void listCandidate(const Eigen::Vector3f& pixel_m, int cells, IsCandidate isCandidate,
                   Candidates& list) {
    const Candidate c{cellOf(pixel_m.x(), cells), cellOf(pixel_m.y(), cells), pixel_m.z()};
    if (c.i >= 0 && c.j >= 0 && isCandidate(c)) list.push_back(c);
}

/// Step 1: the lowest candidate of each cell.
Grid lowestOfCells(const Candidates& candidates, int cells) {
    Grid lowest_m = Grid::Constant(cells, cells, kNoHeight);
    for (const Candidate& c : candidates) lowest_m(c.i, c.j) = std::min(lowest_m(c.i, c.j), c.z_m);
    return lowest_m;
}

Grid withoutStrays(const Grid& lowest_m) {
    const int cells = static_cast<int>(lowest_m.rows());
    Grid cleaned_m = lowest_m;
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            if (lowest_m(i, j) == kNoHeight) continue;
            int higher = 0;
            float lowest_around_m = kNoHeight;
            for (int y = std::max(j - 1, 0); y <= std::min(j + 1, cells - 1); ++y) {
                for (int x = std::max(i - 1, 0); x <= std::min(i + 1, cells - 1); ++x) {
                    if ((x == i && y == j) || lowest_m(x, y) == kNoHeight) continue;
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

/// Step 2. The envelope is the highest surface below `cleaned_m` that is nowhere too steep,
/// computed by a two-pass chamfer transform (Borgefors 1986).
class Envelope {
 public:
    explicit Envelope(const Grid& cleaned_m) : cells_(static_cast<int>(cleaned_m.rows())) {
        const float width_m =
            GroundSurface::kCell_m * kCells / static_cast<float>(cells_);  // width of a cell
        const Grid seen = (cleaned_m < kNoHeight).cast<float>();
        side_m_ = (seen > 0).select(Grid::Constant(cells_, cells_, width_m * kSteepest),
                                    Grid::Constant(cells_, cells_, width_m * kSteepestUnseen));
        ramp_m_.setZero(cells_ + 1, cells_);
        for (int i = 1; i <= cells_; ++i) {
            const auto number = seen.topRows(i).colwise().sum();
            const auto others = static_cast<float>(i) - number;
            ramp_m_.row(i) = number * (width_m * kSteepest) + others * (width_m * kSteepestUnseen);
        }
        height_m_.setConstant(cells_ + 2, cells_ + 2, kNoHeight);
        height_m_.block(1, 1, cells_, cells_) = cleaned_m;
        for (int j = 0; j < cells_; ++j) passColumn(j, true);
        for (int j = cells_ - 1; j >= 0; --j) passColumn(j, false);
    }
    auto height_m() const { return height_m_.block(1, 1, cells_, cells_); }

 private:
    /// Updates each cell of a column from the previous column and from all previous cells of the
    /// same column. The ramp is the maximum climb from the column's edge to each cell.
    void passColumn(int j, bool is_forward) {
        const int before = is_forward ? j : j + 2;  // index includes the border
        float low_m = kNoHeight;                    // minimum relative to the ramp
        for (int n = 0; n < cells_; ++n) {
            const int i = is_forward ? n : cells_ - 1 - n;
            const float side_m = side_m_(i, j);
            const float from_side_m = height_m_(i + 1, before) + side_m;
            const float from_corners_m =
                std::min(height_m_(i, before), height_m_(i + 2, before)) + kDiagonal * side_m;
            float& own_m = height_m_(i + 1, j + 1);
            own_m = std::min({own_m, from_side_m, from_corners_m});
            const float climb_m = is_forward ? ramp_m_(i + 1, j) : -ramp_m_(i, j);
            low_m = std::min(low_m, own_m - climb_m);
            own_m = std::min(own_m, low_m + climb_m);
        }
    }

    int cells_;
    Grid side_m_;    ///< climb to a cell from the cell beside it
    Grid ramp_m_;    ///< climb along a column from its edge to each cell
    Grid height_m_;  ///< heights, with a border of one cell
};

/// Weighted heights and their weights, 0 to 1.
struct WeightedGrid {
    Grid weighted_m, weight;
};

/// Step 3: the means of the candidates close to `lowest_m`.
WeightedGrid cellMeans(const Candidates& candidates, const Grid& lowest_m) {
    Grid sum_m = Grid::Zero(lowest_m.rows(), lowest_m.cols()), number = sum_m;
    visitByTurns(candidates.size(), [&](std::size_t k) {  // in the same order as simd/
        const Candidate& c = candidates[k];
        const float above_m = c.z_m - lowest_m(c.i, c.j);
        if (!(above_m >= -kBelowLowest_m && above_m <= kAboveLowest_m)) return;
        sum_m(c.i, c.j) += c.z_m;
        number(c.i, c.j) += 1;
    });
    const Grid weight = (number * (1 / kSureReturns)).min(1.0f);
    return {sum_m / number.max(1.0f) * weight, weight};
}

/// Step 4: smoothing.
Grid binomial(const Grid& grid) {
    const Eigen::Index cells = grid.rows();
    Grid g = Grid::Zero(cells + 2, cells + 2);  // with a border
    g.block(1, 1, cells, cells) = grid;
    const auto shifted = [&](int i, int j) { return g.block(1 + i, 1 + j, cells, cells); };
    const Grid sides = (shifted(-1, 0) + shifted(1, 0)) + (shifted(0, -1) + shifted(0, 1));
    const Grid corners = (shifted(1, -1) + shifted(-1, 1)) + (shifted(-1, -1) + shifted(1, 1));
    return (0.25f * grid + 0.125f * sides) + 0.0625f * corners;
}

/// Each coarse cell is the weighted mean of the four cells it covers.
WeightedGrid pull(const WeightedGrid& fine) {
    const Eigen::Index cells = fine.weight.rows() / 2;
    WeightedGrid coarse{Grid(cells, cells), Grid(cells, cells)};
    for (Eigen::Index j = 0; j < cells; ++j) {
        for (Eigen::Index i = 0; i < cells; ++i) {
            const auto sum = [&](const Grid& grid) {
                return (grid(2 * i, 2 * j) + grid(2 * i, 2 * j + 1)) +
                       (grid(2 * i + 1, 2 * j) + grid(2 * i + 1, 2 * j + 1));
            };
            const float weights = sum(fine.weight);
            coarse.weighted_m(i, j) = sum(fine.weighted_m) / std::max(weights, 1.0f);
            coarse.weight(i, j) = std::min(weights, 1.0f);
        }
    }
    return coarse;
}

/// A grid twice as fine, by bilinear interpolation between cell centres.
Grid refined(const Grid& coarse_m) {
    const int last = static_cast<int>(coarse_m.rows()) - 1;
    const auto nextOf = [&](int k) {  // the coarse cell on the other side of fine cell k
        return std::clamp(k % 2 == 0 ? k / 2 - 1 : k / 2 + 1, 0, last);
    };
    Grid fine_m(2 * last + 2, 2 * last + 2);
    for (int j = 0; j < fine_m.cols(); ++j) {
        const auto between = [&](int i) {
            return 0.75f * coarse_m(i, j / 2) + 0.25f * coarse_m(i, nextOf(j));
        };
        for (int i = 0; i < fine_m.rows(); ++i) {
            fine_m(i, j) = 0.75f * between(i / 2) + 0.25f * between(nextOf(i));
        }
    }
    return fine_m;
}

/// Pulls up to a single cell, then pushes down: a fine cell takes its missing weight from the
/// coarse grid.
Grid filled(const WeightedGrid& grid) {
    std::vector<WeightedGrid> levels{grid};
    while (levels.back().weight.rows() > 1) levels.push_back(pull(levels.back()));
    const WeightedGrid& whole = levels.back();
    Grid height_m = (whole.weight > 0).select(whole.weighted_m / whole.weight, 0.0f);
    for (std::size_t level = levels.size() - 1; level-- > 0;) {
        height_m = levels[level].weighted_m + (1 - levels[level].weight) * refined(height_m);
    }
    return height_m;
}

/// Runs steps 3 and 4.
Grid surfaceAbout(const Candidates& candidates, const Grid& lowest_m) {
    const WeightedGrid means = cellMeans(candidates, lowest_m);
    return filled({binomial(means.weighted_m), binomial(means.weight)});
}

/// Runs all four steps.
Grid wholeFit(const Candidates& candidates, int cells) {
    const Grid lowest_m = withoutStrays(lowestOfCells(candidates, cells));
    const Grid max_m = Envelope(lowest_m).height_m() + kEnvelope_m;
    return surfaceAbout(candidates, (lowest_m <= max_m).select(lowest_m, kNoHeight));
}

}  // namespace

void fitGroundSurface(const PixelPoints& pixels, const Image<bool>& is_candidate,
                      GroundSurface& surface) {
    Candidates candidates;
    for (Eigen::Index pixel = 0; pixel < is_candidate.size(); ++pixel) {
        const auto isMarked = [&](const Candidate&) { return is_candidate.data()[pixel]; };
        listCandidate(pixels.at(pixel), kCells, isMarked, candidates);
    }
    surface.height_m = wholeFit(candidates, kCells);
}

void fitGroundSurface(const PixelPoints& pixels, const Image<Label>& labels,
                      const std::vector<std::int32_t>& columns, GroundSurface& surface) {
    Candidates rou;
    for (const std::int32_t column : columns) {
        for (Eigen::Index row = 0; row < labels.rows(); ++row) {
            const auto isRou = [&](const Candidate&) { return labels(row, column) == Label::Rou; };
            listCandidate(pixels.at(column * labels.rows() + row), kCoarseCells, isRou, rou);
        }
    }
    const Grid coarse_m = refined(wholeFit(rou, kCoarseCells));
    Candidates close;
    for (Eigen::Index pixel = 0; pixel < labels.size(); ++pixel) {
        const Eigen::Vector3f point_m = pixels.at(pixel);
        const auto isClose = [&](const Candidate& c) {
            const float h_m = c.z_m - coarse_m(c.i, c.j);
            const float distance_m =
                std::sqrt(point_m.x() * point_m.x() + point_m.y() * point_m.y());
            return h_m > -kClose_m - kCloseBelow_per_m * distance_m &&
                   h_m < kClose_m + kCloseAbove_per_m * distance_m;
        };
        listCandidate(point_m, kCells, isClose, close);
    }
    surface.height_m = surfaceAbout(close, lowestOfCells(close, kCells));
}

void heightsAbove(const GroundSurface& surface, const PixelPoints& pixels, Image<float>& height_m) {
    height_m.setConstant(pixels.z_m.rows(), pixels.z_m.cols(), kNoValue);
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        const Eigen::Vector3f p = pixels.at(pixel);
        if (hasValue(p.x())) height_m.data()[pixel] = p.z() - surface.at(p.x(), p.y());
    }
}

}  // namespace hagen::plain
