#include <hagen/segmentation/GroundSurface.h>
#include <algorithm>
#include <limits>
#include <vector>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "GroundSurface.cpp"
#include <hwy/foreach_target.h>
#include "GroundGrid-inl.h"

// Why it is fast: the first fit, which only tells what is close, is coarse; in the second a pixel
// is touched by two short loops, the lowest of its cell and the mean, whose lists of cells and
// heights are written by compressing stores; all else is whole vectors of cells.

#ifndef HAGEN_GROUND_SURFACE
#define HAGEN_GROUND_SURFACE
namespace hagen {
namespace {

constexpr int kCells = GroundSurface::kCells;
constexpr int kCoarseCells = kCells / 2;      // of the first fit to labels
constexpr Eigen::Index kCoarseColumns = 200;  // of an image; of so many or more, its points do

/// The square as so many cells along each side.
template <int kSide>
constexpr float kWidth_m = GroundSurface::kCell_m* kCells / kSide;

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr float kStray_m = 0.4f;  // so far below its neighbours nothing is ground
constexpr float kStrayNeighbours = 3;
constexpr float kSteepest = 0.3f;         // slope of the ground against its plane, where it is seen
constexpr float kSteepestUnseen = 0.17f;  // and where it is not: tall things hide it, not hills
constexpr float kEnvelope_m = 0.15f;      // a cell may stand out of the steepest slopes by this
constexpr float kAboveLowest_m = 0.05f, kBelowLowest_m = 0.1f;  // what a cell's mean is taken of
constexpr float kSureReturns = 5;  // a mean of so many has its full weight

using Heights = std::vector<float>;  // a cell's at its place in the grid

/// A grid of heights and how much each is to be trusted, 0 to 1; each level covers the square with
/// cells twice as wide, and has a border too.
struct Level {
    int cells = 0;
    Heights weighted_m;  ///< height * weight
    Heights weight;
    Heights height_m;  ///< filled

    int column(int j) const { return (j + 1) * (cells + 2) + 1; }
    /// Gives the border at both ends of each column the heights beside it.
    void extendColumns() {
        for (int j = 0; j < cells; ++j) {
            height_m[column(j) - 1] = height_m[column(j)];
            height_m[column(j) + cells] = height_m[column(j) + cells - 1];
        }
    }
};

/// Memory that a fit to a grid of kSide x kSide cells needs.
template <int kSide>
struct Workspace {
    static constexpr int kSize = (kSide + 2) * (kSide + 2);

    std::vector<std::int32_t> cell;  ///< of the candidates
    Heights z_m;
    std::size_t candidates = 0;

    Heights lowest_m, cleaned_m, envelope_m, ramp_m;
    Heights sum_m, number;  ///< of the candidates that a cell's mean is taken of
    std::vector<Level> levels;

    Workspace() {
        for (auto* heights_m : {&lowest_m, &cleaned_m, &envelope_m, &ramp_m}) {
            heights_m->assign(kSize, kNone);
        }
        for (auto* sums : {&sum_m, &number}) sums->assign(kSize, 0.0f);
        for (int cells = kSide; cells >= 1; cells /= 2) {
            const Heights zero((cells + 2) * (cells + 2), 0.0f);
            levels.push_back({cells, zero, zero, zero});
        }
    }
    /// Begins a list of the candidates among so many pixels; room is for whole vectors.
    void beginList(std::size_t pixels) {
        candidates = 0;
        constexpr std::size_t kWidest = 64;
        if (cell.size() >= pixels + kWidest) return;
        cell.resize(pixels + kWidest);
        z_m.resize(pixels + kWidest);
    }
};

/// Pixels that lie one after the other.
struct PixelSpan {
    const float *x_m, *y_m, *z_m;
    std::size_t size;

    PixelSpan part(std::size_t first, std::size_t of_size) const {
        return {x_m + first, y_m + first, z_m + first, of_size};
    }
};

/// The lowest candidate of each cell.
template <int kSide>
void findLowest(Workspace<kSide>& work) {
    std::fill(work.lowest_m.begin(), work.lowest_m.end(), kNone);
    float* const lowest_m = work.lowest_m.data();
    const std::int32_t* const cell = work.cell.data();
    const float* const z_m = work.z_m.data();
    visitByTurns(
        work.candidates, [=](std::size_t k) __attribute__((always_inline)) {
            lowest_m[cell[k]] = std::min(lowest_m[cell[k]], z_m[k]);
        });
}

/// Step 3, first half: a cell's mean is of its candidates close to the lowest, `ground_m`; of none
/// where that is no ground.
template <int kSide>
void sumUpClose(Workspace<kSide>& work, const float* ground_m) {
    for (auto* sums : {&work.sum_m, &work.number}) std::fill(sums->begin(), sums->end(), 0.0f);
    float *const sum_m = work.sum_m.data(), *const number = work.number.data();
    const std::int32_t* const cell = work.cell.data();
    const float* const z_m = work.z_m.data();
    visitByTurns(
        work.candidates, [=](std::size_t k) __attribute__((always_inline)) {
            const float above_m = z_m[k] - ground_m[cell[k]];
            // 1 where it is ground, 0 where it is not; a comparison alone would become a branch.
            const float is_ground =
                static_cast<float>((above_m >= -kBelowLowest_m) & (above_m <= kAboveLowest_m));
            sum_m[cell[k]] += is_ground * z_m[k];
            number[cell[k]] += is_ground;
        });
}

}  // namespace
}  // namespace hagen
#endif

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

using F = hn::ScalableTag<float>;
using V = hn::Vec<F>;

/// Appends the pixels on the grid that isCandidate(d, pixel, x_m, y_m, cell) to the list.
template <int kSide, class IsCandidate>
HWY_INLINE void listCandidates(const PixelSpan& pixels, Workspace<kSide>& work,
                               IsCandidate isCandidate) {
    std::int32_t* HWY_RESTRICT cell = work.cell.data();
    float* HWY_RESTRICT height_m = work.z_m.data();
    std::size_t n = work.candidates;
    forEachVector(pixels.size, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const auto x = hn::LoadU(d, pixels.x_m + pixel), y = hn::LoadU(d, pixels.y_m + pixel);
        const auto cells = gridCells<kSide>(d, x, y);
        const auto is_candidate =
            hn::And(cells.is_on_grid, isCandidate(d, pixel, x, y, cells.cell));
        // Whole vectors are written, what is too much is written over by the next: masked stores
        // are slow on some machines.
        auto heights_m = hn::LoadU(d, pixels.z_m + pixel);
        auto place = cells.cell;
        const std::size_t listed = compress(d, is_candidate, heights_m, place);
        hn::StoreU(heights_m, d, height_m + n);
        hn::StoreU(place, di, cell + n);
        n += listed;
    });
    work.candidates = n;
}

/// Of each `step`-th column of an image.
template <int kSide>
HWY_INLINE void listMarked(const PixelSpan& image, std::size_t rows, std::size_t step,
                           const std::uint8_t* HWY_RESTRICT mark, std::uint8_t wanted,
                           Workspace<kSide>& work) {
    const std::size_t at_once = step == 1 ? image.size : rows;
    for (std::size_t first = 0; first < image.size; first += step * at_once) {
        listCandidates(image.part(first, at_once), work,
                       [&](auto d, std::size_t pixel, auto, auto, auto) HAGEN_INLINE {
                           const hn::RebindToSigned<decltype(d)> di;
                           const hn::Rebind<std::uint8_t, decltype(d)> d8;
                           const auto marks =
                               hn::PromoteTo(di, hn::LoadU(d8, mark + first + pixel));
                           return hn::RebindMask(d, hn::Eq(marks, hn::Set(di, wanted)));
                       });
    }
}

void ListMarkedIn(const PixelSpan& image, const std::uint8_t* mark, std::uint8_t wanted,
                  Workspace<kCells>& work) {
    listMarked(image, image.size, 1, mark, wanted, work);
}

void ListCoarseIn(const PixelSpan& image, std::size_t rows, std::size_t step,
                  const std::uint8_t* mark, std::uint8_t wanted, Workspace<kCoarseCells>& work) {
    listMarked(image, rows, step, mark, wanted, work);
}

/// What is close to the coarse surface, refined to one height a cell, can be ground: the farther
/// away, the less is known. One height is gathered a pixel, where the way between cells takes four.
void ListCloseIn(const PixelSpan& pixels, const float* HWY_RESTRICT coarse_m,
                 Workspace<kCells>& work) {
    listCandidates(
        pixels, work, [&](auto d, std::size_t pixel, auto x, auto y, auto cell) HAGEN_INLINE {
            const auto z = hn::LoadU(d, pixels.z_m + pixel);
            const auto h_m = hn::Sub(z, hn::GatherIndex(d, coarse_m, cell));
            const auto distance_m = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
            const auto least_m = hn::Sub(hn::Set(d, -0.2f), hn::Mul(hn::Set(d, 0.01f), distance_m));
            const auto most_m = hn::Add(hn::Set(d, 0.2f), hn::Mul(hn::Set(d, 0.005f), distance_m));
            return hn::And(hn::Gt(h_m, least_m), hn::Lt(h_m, most_m));
        });
}

/// Step 1: returns below the ground do not count.
template <int kSide>
void removeStrays(const Heights& lowest_m, Heights& cleaned_m) {
    const F d;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; i += static_cast<int>(hn::Lanes(d))) {
            const float* HWY_RESTRICT cell = lowest_m.data() + gridColumn<kSide>(j) + i;
            const V low_m = hn::LoadU(d, cell), none = hn::Set(d, kNone);
            V cleaned = low_m;
            if (!hn::AllTrue(d, hn::Eq(low_m, none))) {
                const V stray_m = hn::Set(d, kStray_m), one = hn::Set(d, 1.0f);
                V higher = hn::Zero(d), lowest_around_m = none;
                for (const int neighbour :
                     {-kStride<kSide> - 1, -kStride<kSide>, -kStride<kSide> + 1, -1, 1,
                      kStride<kSide> - 1, kStride<kSide>, kStride<kSide> + 1}) {
                    const V around_m = hn::LoadU(d, cell + neighbour);
                    const auto is_higher =
                        hn::And(hn::Gt(hn::Sub(around_m, low_m), stray_m), hn::Lt(around_m, none));
                    higher = hn::Add(higher, hn::IfThenElseZero(is_higher, one));
                    lowest_around_m = hn::Min(lowest_around_m, around_m);
                }
                const auto is_stray =
                    hn::And(hn::Ge(higher, hn::Set(d, kStrayNeighbours)), hn::Lt(low_m, none));
                cleaned = hn::IfThenElse(is_stray, hn::Max(low_m, lowest_around_m), low_m);
            }
            hn::StoreU(cleaned, d, cleaned_m.data() + gridColumn<kSide>(j) + i);
        }
    }
}

/// Vectors of a chamfer's way along a column, of cells that lie one after the other.
using Along = hn::CappedTag<float, 8>;
using VA = hn::Vec<Along>;

/// Each cell's combined with all before it in the vector. `neutral` changes nothing.
template <bool kForward, class Combine>
HWY_INLINE VA combinedSoFar(VA cells, VA neutral, Combine combine) {
#if HWY_TARGET == HWY_SCALAR
    (void)neutral, (void)combine;
    return cells;
#else
    const Along d;
    if constexpr (kForward) {
        cells = combine(cells, hn::CombineShiftRightBytes<12>(d, cells, neutral));
        cells = combine(cells, hn::CombineShiftRightBytes<8>(d, cells, neutral));
        if constexpr (hn::MaxLanes(d) == 8) {
            cells = combine(cells, hn::ConcatLowerLower(d, hn::Broadcast<3>(cells), neutral));
        }
    } else {
        cells = combine(cells, hn::CombineShiftRightBytes<4>(d, neutral, cells));
        cells = combine(cells, hn::CombineShiftRightBytes<8>(d, neutral, cells));
        if constexpr (hn::MaxLanes(d) == 8) {
            cells = combine(cells, hn::ConcatUpperUpper(d, neutral, hn::Broadcast<0>(cells)));
        }
    }
    return cells;
#endif
}

/// The last cell's in every lane.
template <bool kForward>
HWY_INLINE VA lastOf(VA cells) {
#if HWY_TARGET == HWY_SCALAR
    return cells;
#else
    const Along d;
    if constexpr (kForward) {
        cells = hn::Broadcast<3>(cells);
        return hn::MaxLanes(d) == 8 ? hn::ConcatUpperUpper(d, cells, cells) : cells;
    } else {
        cells = hn::Broadcast<0>(cells);
        return hn::MaxLanes(d) == 8 ? hn::ConcatLowerLower(d, cells, cells) : cells;
    }
#endif
}

/// How high the ground may climb along a column, from before its first cell up to each: whole
/// numbers of steps over cells with a height and over others, the same in any order.
template <int kSide>
HWY_INLINE void findRamp(const float* HWY_RESTRICT cleaned_m, float* HWY_RESTRICT ramp_m) {
    const Along d;
    const VA seen_m = hn::Set(d, kWidth_m<kSide> * kSteepest), one = hn::Set(d, 1.0f);
    const VA unseen_m = hn::Set(d, kWidth_m<kSide> * kSteepestUnseen);
    VA seen = hn::Zero(d);  // cells, up to the last vector
    ramp_m[-1] = 0;
    for (int i = 0; i < kSide; i += static_cast<int>(hn::Lanes(d))) {
        const auto is_seen = hn::Lt(hn::LoadU(d, cleaned_m + i), hn::Set(d, kNone));
        const auto sum = [](VA a, VA b) HAGEN_INLINE { return hn::Add(a, b); };
        const VA more = combinedSoFar<true>(hn::IfThenElseZero(is_seen, one), hn::Zero(d), sum);
        const VA number = hn::Add(seen, more);
        const VA others = hn::Sub(hn::Iota(d, static_cast<float>(i + 1)), number);
        hn::StoreU(hn::Add(hn::Mul(number, seen_m), hn::Mul(others, unseen_m)), d, ramp_m + i);
        seen = hn::Add(seen, lastOf<true>(more));
    }
}

/// One column of a chamfer's pass (Borgefors 1986). Along the column a cell is reached from all
/// before it: against the ramp, that is the lowest of them, which is the same in any order.
template <int kSide, bool kForward>
HWY_INLINE void chamferColumn(const float* HWY_RESTRICT cleaned_m, const float* HWY_RESTRICT ramp_m,
                              const float* HWY_RESTRICT before_m, float* HWY_RESTRICT envelope_m) {
    const Along d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const VA none = hn::Set(d, kNone), corner = hn::Set(d, 1.41421356f);
    const VA seen_m = hn::Set(d, kWidth_m<kSide> * kSteepest);
    const VA unseen_m = hn::Set(d, kWidth_m<kSide> * kSteepestUnseen);
    const auto lower = [](VA a, VA b) HAGEN_INLINE { return hn::Min(a, b); };
    VA lowest_m = none;  // of all vectors before, against the ramp
    for (int step = 0; step < kSide; step += lanes) {
        const int i = kForward ? step : kSide - lanes - step;
        const auto is_seen = hn::Lt(hn::LoadU(d, cleaned_m + i), none);
        const VA side_m = hn::IfThenElse(is_seen, seen_m, unseen_m);
        const VA corners_m =
            hn::Min(hn::LoadU(d, before_m + i - 1), hn::LoadU(d, before_m + i + 1));
        const VA from_side_m = hn::Add(hn::LoadU(d, before_m + i), side_m);
        const VA from_corners_m = hn::Add(corners_m, hn::Mul(corner, side_m));
        const VA own_m =
            hn::Min(hn::LoadU(d, envelope_m + i), hn::Min(from_side_m, from_corners_m));
        const VA climb_m =
            kForward ? hn::LoadU(d, ramp_m + i) : hn::Neg(hn::LoadU(d, ramp_m + i - 1));
        const VA against_m = combinedSoFar<kForward>(hn::Sub(own_m, climb_m), none, lower);
        const VA reached_m = hn::Add(hn::Min(lowest_m, against_m), climb_m);
        hn::StoreU(hn::Min(own_m, reached_m), d, envelope_m + i);
        lowest_m = hn::Min(lowest_m, lastOf<kForward>(against_m));
    }
}

/// Step 2: the greatest surface below `cleaned_m` that is nowhere too steep: kSteepest in a cell
/// that has a height, kSteepestUnseen in one that has none. What stands out of it is taken away.
template <int kSide>
void removeObstacles(Heights& cleaned_m, Heights& ramp_m, Heights& envelope_m) {
    std::copy(cleaned_m.begin(), cleaned_m.end(), envelope_m.begin());
    const float* const cleaned = cleaned_m.data();
    float* const e = envelope_m.data();
    float* const ramp = ramp_m.data();
    for (int j = 0; j < kSide; ++j) {
        const int column = gridColumn<kSide>(j);
        findRamp<kSide>(cleaned + column, ramp + column);
        chamferColumn<kSide, true>(cleaned + column, ramp + column, e + column - kStride<kSide>,
                                   e + column);
    }
    for (int j = kSide - 1; j >= 0; --j) {
        const int column = gridColumn<kSide>(j);
        chamferColumn<kSide, false>(cleaned + column, ramp + column, e + column + kStride<kSide>,
                                    e + column);
    }
    const F d;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; i += static_cast<int>(hn::Lanes(d))) {
            float* HWY_RESTRICT cell = cleaned_m.data() + gridColumn<kSide>(j) + i;
            const V low_m = hn::LoadU(d, cell);
            const V most_m =
                hn::Add(hn::LoadU(d, e + gridColumn<kSide>(j) + i), hn::Set(d, kEnvelope_m));
            hn::StoreU(hn::IfThenElse(hn::Le(low_m, most_m), low_m, hn::Set(d, kNone)), d, cell);
        }
    }
}

/// Step 3, second half: sums of heights and their numbers become weighted heights and weights.
template <int kSide>
void weigh(Heights& sums_m, Heights& numbers) {
    const F d;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; i += static_cast<int>(hn::Lanes(d))) {
            float* HWY_RESTRICT sum_m = sums_m.data() + gridColumn<kSide>(j) + i;
            float* HWY_RESTRICT number = numbers.data() + gridColumn<kSide>(j) + i;
            const V n = hn::LoadU(d, number), one = hn::Set(d, 1.0f);
            if (hn::AllTrue(d, hn::Eq(n, hn::Zero(d)))) continue;  // as most are
            const V weight = hn::Min(hn::Mul(n, hn::Set(d, 1 / kSureReturns)), one);
            const V mean_m = hn::Div(hn::LoadU(d, sum_m), hn::Max(n, one));
            hn::StoreU(hn::Mul(mean_m, weight), d, sum_m);
            hn::StoreU(weight, d, number);
        }
    }
}

/// A binomial of 3 x 3 cells.
template <int kSide>
HWY_INLINE V binomial(const float* HWY_RESTRICT cell) {
    const F d;
    const auto bothSides = [&](int step) HAGEN_INLINE {
        return hn::Add(hn::LoadU(d, cell - step), hn::LoadU(d, cell + step));
    };
    const V sides = hn::Add(bothSides(1), bothSides(kStride<kSide>));
    const V corners = hn::Add(bothSides(kStride<kSide> - 1), bothSides(kStride<kSide> + 1));
    return hn::Add(
        hn::Add(hn::Mul(hn::Set(d, 0.25f), hn::LoadU(d, cell)), hn::Mul(hn::Set(d, 0.125f), sides)),
        hn::Mul(hn::Set(d, 0.0625f), corners));
}

/// Step 4, first half: weighted heights and weights.
template <int kSide>
void smoothHeights(const Heights& sum_m, const Heights& number, Level& smooth) {
    const F d;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; i += static_cast<int>(hn::Lanes(d))) {
            const int cell = gridColumn<kSide>(j) + i;
            const V weight = binomial<kSide>(number.data() + cell);
            hn::StoreU(weight, d, smooth.weight.data() + cell);
            const bool is_empty = hn::AllTrue(d, hn::Eq(weight, hn::Zero(d)));  // as many are
            const V weighted_m = is_empty ? hn::Zero(d) : binomial<kSide>(sum_m.data() + cell);
            hn::StoreU(weighted_m, d, smooth.weighted_m.data() + cell);
        }
    }
}

/// Each coarse cell is the weighted mean of the four it covers. `d` has at most as many lanes as
/// there are coarse cells in a column.
template <class D>
HWY_INLINE void pull(D d, const Level& fine, Level& coarse) {
    using VD = hn::Vec<D>;
    const int lanes = static_cast<int>(hn::Lanes(d));
    HWY_ALIGN float across[kStride<kCells> + 64];  // sums over two columns
    const VD one = hn::Set(d, 1.0f);
    for (int j = 0; j < coarse.cells; ++j) {
        const int left = fine.column(2 * j), right = fine.column(2 * j + 1);
        const auto sumAcross = [&](const Heights& values) HAGEN_INLINE {
            for (int i = 0; i < fine.cells; i += lanes) {
                hn::StoreU(hn::Add(hn::LoadU(d, values.data() + left + i),
                                   hn::LoadU(d, values.data() + right + i)),
                           d, across + i);
            }
        };
        const auto sumAlong = [&](int i) HAGEN_INLINE {
            VD even, odd;
            hn::LoadInterleaved2(d, across + 2 * i, even, odd);
            return hn::Add(even, odd);
        };
        float* HWY_RESTRICT weighted_m = coarse.weighted_m.data() + coarse.column(j);
        float* HWY_RESTRICT weight = coarse.weight.data() + coarse.column(j);
        sumAcross(fine.weighted_m);
        for (int i = 0; i < coarse.cells; i += lanes) hn::StoreU(sumAlong(i), d, weighted_m + i);
        sumAcross(fine.weight);
        for (int i = 0; i < coarse.cells; i += lanes) {
            const VD weights = sumAlong(i);
            hn::StoreU(hn::Div(hn::LoadU(d, weighted_m + i), hn::Max(weights, one)), d,
                       weighted_m + i);
            hn::StoreU(hn::Min(weights, one), d, weight + i);
        }
    }
}

/// Column j of a grid twice as fine, bilinear between the middles of the coarse cells: those of a
/// fine cell's own and the next one have 3/4 and 1/4.
template <class D>
HWY_INLINE void refineColumn(D d, const Level& coarse, int j, float* HWY_RESTRICT fine_m) {
    using VD = hn::Vec<D>;
    const int lanes = static_cast<int>(hn::Lanes(d)), last = coarse.cells - 1;
    const VD near = hn::Set(d, 0.75f), far = hn::Set(d, 0.25f);
    const int own = j / 2, next = std::clamp(j % 2 == 0 ? own - 1 : own + 1, 0, last);
    const float* HWY_RESTRICT own_m = coarse.height_m.data() + coarse.column(own);
    const float* HWY_RESTRICT next_m = coarse.height_m.data() + coarse.column(next);
    for (int i = 0; i < coarse.cells; i += lanes) {
        const auto betweenColumns = [&](int cell) HAGEN_INLINE {
            return hn::Add(hn::Mul(near, hn::LoadU(d, own_m + cell)),
                           hn::Mul(far, hn::LoadU(d, next_m + cell)));
        };
        const VD mostly = hn::Mul(near, betweenColumns(i));
        const VD even_m = hn::Add(mostly, hn::Mul(far, betweenColumns(i - 1)));
        const VD odd_m = hn::Add(mostly, hn::Mul(far, betweenColumns(i + 1)));
        hn::StoreInterleaved2(even_m, odd_m, d, fine_m + 2 * i);
    }
}

/// What a fine cell lacks in weight it takes from the coarse grid. Column j of the result goes to
/// filled_m + j * stride.
template <class D>
HWY_INLINE void push(D d, const Level& coarse, const Level& fine, float* HWY_RESTRICT filled_m,
                     int stride) {
    using VD = hn::Vec<D>;
    const int lanes = static_cast<int>(hn::Lanes(d));
    HWY_ALIGN float below_m[kStride<kCells> + 64];  // of the fine grid's cells
    for (int j = 0; j < fine.cells; ++j) {
        refineColumn(d, coarse, j, below_m);
        const float* HWY_RESTRICT weight = fine.weight.data() + fine.column(j);
        const float* HWY_RESTRICT weighted_m = fine.weighted_m.data() + fine.column(j);
        for (int i = 0; i < fine.cells; i += lanes) {
            const VD lacking = hn::Sub(hn::Set(d, 1.0f), hn::LoadU(d, weight + i));
            hn::StoreU(
                hn::Add(hn::LoadU(d, weighted_m + i), hn::Mul(lacking, hn::LoadU(d, below_m + i))),
                d, filled_m + j * stride + i);
        }
    }
}

/// Calls visit(d, level) with the widest vectors that fit into a column of so many cells.
template <class Visit>
HWY_INLINE void withVectorsFor(int cells, Visit visit) {
    if (cells >= 16) return visit(hn::CappedTag<float, 16>());
    if (cells >= 4) return visit(hn::CappedTag<float, 4>());
    visit(hn::CappedTag<float, 1>());
}

/// Step 4, second half.
void fill(std::vector<Level>& levels, float* HWY_RESTRICT surface_m, int surface_stride) {
    for (std::size_t k = 1; k < levels.size(); ++k) {
        withVectorsFor(levels[k].cells,
                       [&](auto d) HAGEN_INLINE { pull(d, levels[k - 1], levels[k]); });
    }
    Level& whole = levels.back();
    const int only = whole.column(0);
    whole.height_m[only] =
        whole.weight[only] > 0 ? whole.weighted_m[only] / whole.weight[only] : 0.0f;
    for (std::size_t k = levels.size() - 1; k > 0; --k) {
        Level& fine = levels[k - 1];
        levels[k].extendColumns();
        float* const filled_m = k > 1 ? fine.height_m.data() + fine.column(0) : surface_m;
        const int stride = k > 1 ? fine.cells + 2 : surface_stride;
        withVectorsFor(levels[k].cells,
                       [&](auto d) HAGEN_INLINE { push(d, levels[k], fine, filled_m, stride); });
    }
}

/// All steps, for the candidates listed.
template <int kSide, bool kCleans>
HWY_INLINE void fit(Workspace<kSide>& work, float* HWY_RESTRICT surface_m, int stride) {
    findLowest(work);
    if constexpr (kCleans) {
        removeStrays<kSide>(work.lowest_m, work.cleaned_m);
        removeObstacles<kSide>(work.cleaned_m, work.ramp_m, work.envelope_m);
    }
    sumUpClose(work, (kCleans ? work.cleaned_m : work.lowest_m).data());
    weigh<kSide>(work.sum_m, work.number);
    smoothHeights<kSide>(work.sum_m, work.number, work.levels.front());
    fill(work.levels, surface_m, stride);
}

void FitIn(Workspace<kCells>& work, float* surface_m) {
    fit<kCells, true>(work, surface_m, kCells);
}

/// Steps 3 and 4.
void FitCloseIn(Workspace<kCells>& work, float* surface_m) {
    fit<kCells, false>(work, surface_m, kCells);
}

/// The heights go to the middles of the fine grid's cells, which has a border.
void FitCoarseIn(Workspace<kCoarseCells>& work, float* HWY_RESTRICT fine_m) {
    Level& coarse = work.levels.front();
    fit<kCoarseCells, true>(work, coarse.height_m.data() + coarse.column(0), kStride<kCoarseCells>);
    coarse.extendColumns();
    for (int j = 0; j < kCells; ++j) {
        refineColumn(hn::CappedTag<float, 16>(), coarse, j, fine_m + gridColumn(j));
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(ListMarkedIn);
HWY_EXPORT(ListCoarseIn);
HWY_EXPORT(ListCloseIn);
HWY_EXPORT(FitIn);
HWY_EXPORT(FitCoarseIn);
HWY_EXPORT(FitCloseIn);

/// Kept from scan to scan, so that none is allocated; holds nothing between them.
template <int kSide>
Workspace<kSide>& workspace() {
    thread_local Workspace<kSide> work;
    return work;
}

PixelSpan spanOf(const PixelPoints& pixels) {
    return {pixels.x_m.data(), pixels.y_m.data(), pixels.z_m.data(),
            static_cast<std::size_t>(pixels.x_m.size())};
}

/// A rough surface under the ROU, from so few columns as it takes.
void fitCoarse(const PixelPoints& pixels, const Image<Label>& labels, float* fine_m) {
    Workspace<kCoarseCells>& work = workspace<kCoarseCells>();
    const PixelSpan image = spanOf(pixels);
    const Eigen::Index step = std::max<Eigen::Index>(1, labels.cols() / kCoarseColumns);
    work.beginList(image.size);
    HWY_DYNAMIC_DISPATCH(ListCoarseIn)
    (image, static_cast<std::size_t>(labels.rows()), static_cast<std::size_t>(step),
     reinterpret_cast<const std::uint8_t*>(labels.data()), static_cast<std::uint8_t>(Label::Rou),
     work);
    HWY_DYNAMIC_DISPATCH(FitCoarseIn)(work, fine_m);
}

}  // namespace

void fitGroundSurface(const PixelPoints& pixels, const Image<bool>& is_candidate,
                      GroundSurface& surface) {
    static_assert(sizeof(bool) == 1);
    Workspace<kCells>& work = workspace<kCells>();
    const PixelSpan image = spanOf(pixels);
    work.beginList(image.size);
    surface.height_m.resize(kCells, kCells);
    HWY_DYNAMIC_DISPATCH(ListMarkedIn)
    (image, reinterpret_cast<const std::uint8_t*>(is_candidate.data()), true, work);
    HWY_DYNAMIC_DISPATCH(FitIn)(work, surface.height_m.data());
}

void fitGroundSurface(const PixelPoints& pixels, const Image<Label>& labels,
                      GroundSurface& surface) {
    // Kept from scan to scan, so that none is allocated; holds nothing between them.
    thread_local Heights coarse_m(kGridSize);
    fitCoarse(pixels, labels, coarse_m.data());
    Workspace<kCells>& work = workspace<kCells>();
    const PixelSpan image = spanOf(pixels);
    work.beginList(image.size);
    surface.height_m.resize(kCells, kCells);
    HWY_DYNAMIC_DISPATCH(ListCloseIn)(image, coarse_m.data(), work);
    HWY_DYNAMIC_DISPATCH(FitCloseIn)(work, surface.height_m.data());
}

}  // namespace hagen
#endif
