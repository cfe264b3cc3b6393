#include "filter/simd/GroundEvidence.h"
#include <algorithm>
#include <limits>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/simd/GroundEvidence.cpp"
#include <hwy/foreach_target.h>
#include "filter/ground/BlockSums.h"
#include "filter/simd/GroundGrid-inl.h"

#ifndef HAGEN_GROUND_EVIDENCE
#define HAGEN_GROUND_EVIDENCE
namespace hagen {
namespace {

using namespace evidence_rules;

/// Bit `above - 1` of a pixel's mark: the step to the pixel `above` rows higher is level.
constexpr std::uint8_t markOf(int above) { return static_cast<std::uint8_t>(1 << (above - 1)); }

/// Two counts of a block in one number: close pixels, and kLevelToo times those that are level.
constexpr std::uint64_t kLevelToo = std::uint64_t{1} << 32;

}  // namespace
}  // namespace hagen
#endif

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

template <class D>
using Bytes = hn::Rebind<std::uint8_t, D>;

/// Stores 1 for true and 0 for false.
template <class D>
HWY_INLINE void storeMask(D, hn::Mask<D> mask, std::uint8_t* HWY_RESTRICT to) {
    const hn::RebindToSigned<D> di;
    const auto ones = hn::IfThenElseZero(hn::RebindMask(di, mask), hn::Set(di, 1));
    hn::StoreU(hn::DemoteTo(Bytes<D>(), ones), Bytes<D>(), to);
}

/// Marks the level steps from each pixel to the next pixels in memory. At the top of each column,
/// where these pixels belong to another column, the caller corrects the marks.
void LevelStepsIn(std::size_t pixels, const float* HWY_RESTRICT x_m, const float* HWY_RESTRICT y_m,
                  const float* HWY_RESTRICT z_m, std::uint8_t* HWY_RESTRICT steps) {
    const auto markSteps = [&](auto d, std::size_t pixel, int max_above) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const Bytes<decltype(d)> d8;
        const auto x = hn::LoadU(d, x_m + pixel), y = hn::LoadU(d, y_m + pixel);
        const auto z = hn::LoadU(d, z_m + pixel);
        auto marks = hn::Zero(di);
        auto is_open = hn::Not(hn::IsNaN(z));  // true until a pixel is far enough
        for (int above = 1; above <= max_above && !hn::AllFalse(d, is_open); ++above) {
            const std::size_t next = pixel + static_cast<std::size_t>(above);
            const auto dx = hn::Sub(hn::LoadU(d, x_m + next), x);
            const auto dy = hn::Sub(hn::LoadU(d, y_m + next), y);
            const auto dz = hn::Sub(hn::LoadU(d, z_m + next), z);
            const auto run_m2 = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
            const auto rise_m2 = hn::Mul(dz, dz), length_m2 = hn::Add(run_m2, rise_m2);
            const auto outwards = hn::Add(hn::Mul(dx, x), hn::Mul(dy, y));
            auto is_level =  // false for NaN
                hn::And(hn::Lt(rise_m2, hn::Mul(hn::Set(d, kSteepest * kSteepest), run_m2)),
                        hn::Gt(outwards, hn::Zero(d)));
            if (above > 1)
                is_level = hn::And(is_level, hn::Lt(length_m2, hn::Set(d, kFar_m * kFar_m)));
            marks = hn::Or(marks, hn::IfThenElseZero(hn::RebindMask(di, hn::And(is_open, is_level)),
                                                     hn::Set(di, markOf(above))));
            is_open = hn::AndNot(hn::Ge(length_m2, hn::Set(d, kShort_m * kShort_m)), is_open);
        }
        hn::StoreU(hn::DemoteTo(d8, marks), d8, steps + pixel);
    };
    const std::size_t whole = pixels - std::min<std::size_t>(pixels, kAbove);
    forEachVector(whole,
                  [&](auto d, std::size_t pixel) HAGEN_INLINE { markSteps(d, pixel, kAbove); });
    for (std::size_t pixel = whole; pixel < pixels; ++pixel) {
        markSteps(hn::CappedTag<float, 1>(), pixel, static_cast<int>(pixels - 1 - pixel));
    }
}

/// Marks both pixels of each step, unless their cell has a lower pixel. `steps` has kAbove extra
/// values before the first.
void MarkLevelIn(std::size_t pixels, const float* HWY_RESTRICT z_m,
                 const std::uint16_t* HWY_RESTRICT cell, const float* HWY_RESTRICT lowest_m,
                 const std::uint8_t* HWY_RESTRICT steps, std::uint8_t* HWY_RESTRICT is_level) {
    forEachVector(pixels, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const Bytes<decltype(d)> d8;
        const auto low_m = gatherAt(d, lowest_m, cell + pixel);
        const auto is_lowest =
            hn::Le(hn::LoadU(d, z_m + pixel), hn::Add(low_m, hn::Set(d, kDrop_m)));
        auto to_or_from = hn::LoadU(d8, steps + pixel);
        for (int below = 1; below <= kAbove; ++below) {
            const auto marks = hn::LoadU(d8, steps + pixel - below);
            to_or_from = hn::Or(to_or_from, hn::And(marks, hn::Set(d8, markOf(below))));
        }
        const auto marks = hn::PromoteTo(di, to_or_from);
        storeMask(d, hn::And(is_lowest, hn::RebindMask(d, hn::Gt(marks, hn::Zero(di)))),
                  is_level + pixel);
    });
}

/// Adds 1 to the count of a block for each pixel close to the surface, and kLevelToo if it is
/// level.
void CountCloseIn(std::size_t pixels, const float* HWY_RESTRICT x_m, const float* HWY_RESTRICT y_m,
                  const float* HWY_RESTRICT height_m, const std::uint8_t* HWY_RESTRICT is_level,
                  const std::uint16_t* HWY_RESTRICT block, std::uint64_t* HWY_RESTRICT counts) {
    visitChosen(
        pixels,
        [&](auto d, std::size_t pixel, auto&, auto& places) HAGEN_INLINE {
            const hn::RebindToSigned<decltype(d)> di;
            const hn::Rebind<std::uint16_t, decltype(d)> d16;
            const auto x = hn::LoadU(d, x_m + pixel), y = hn::LoadU(d, y_m + pixel);
            const auto distance_m = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
            const auto max_m =
                hn::Add(hn::Set(d, kClose_m), hn::Mul(hn::Set(d, kClose_per_m), distance_m));
            const auto level = hn::PromoteTo(di, hn::LoadU(Bytes<decltype(d)>(), is_level + pixel));
            places =
                hn::Or(hn::PromoteTo(di, hn::LoadU(d16, block + pixel)), hn::ShiftLeft<16>(level));
            return hn::Lt(hn::Abs(hn::LoadU(d, height_m + pixel)), max_m);
        },
        [&](float, std::int32_t place)
            HAGEN_INLINE { counts[place & 0xffff] += 1 + (place >> 16) * kLevelToo; });
}

/// Lowers the tolerance of a pixel to minus infinity if `min_m` of its block is minus infinity.
void WithdrawIn(std::size_t pixels, const std::uint16_t* HWY_RESTRICT block,
                const float* HWY_RESTRICT min_m, float* HWY_RESTRICT tolerance_m) {
    forEachVector(pixels, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const auto min = gatherAt(d, min_m, block + pixel);
        // NaN stays NaN.
        hn::StoreU(hn::Add(hn::LoadU(d, tolerance_m + pixel), min), d, tolerance_m + pixel);
    });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(LevelStepsIn);
HWY_EXPORT(MarkLevelIn);
HWY_EXPORT(CountCloseIn);
HWY_EXPORT(WithdrawIn);

/// Counts of the pixels close to the surface, and of those that are level.
struct Counts {
    int close = 0, level = 0;

    void add(const Counts& other) { close += other.close, level += other.level; }
    void remove(const Counts& other) { close -= other.close, level -= other.level; }
    bool isGround() const {
        return level > 0 && static_cast<float>(level) >= kMinShare * static_cast<float>(close);
    }
};

}  // namespace

void findLevelPixels(const PixelPoints& pixels, const PixelCells& cells,
                     Image<std::uint8_t>& is_level, GroundEvidenceWorkspace& work) {
    const Eigen::Index rows = pixels.x_m.rows(), columns = pixels.x_m.cols();
    const auto size = static_cast<std::size_t>(rows * columns);
    is_level.resize(rows, columns);
    if (size == 0) return;
    // Pads with zeros, because no steps start before the first pixel.
    work.steps.resize(size + kAbove);
    std::fill_n(work.steps.begin(), kAbove, std::uint8_t{0});
    std::uint8_t* const steps = work.steps.data() + kAbove;
    HWY_DYNAMIC_DISPATCH(LevelStepsIn)
    (size, pixels.x_m.data(), pixels.y_m.data(), pixels.z_m.data(), steps);
    const Eigen::Index last_rows = std::min<Eigen::Index>(rows, kAbove);
    for (Eigen::Index end = rows; end <= rows * columns; end += rows) {
        for (int above = 0; above < last_rows; ++above) {  // number of rows above
            steps[end - 1 - above] &= static_cast<std::uint8_t>((1 << above) - 1);
        }
    }

    work.lowest_m.assign(kGridSize, kNoHeight);
    float* const lowest_m = work.lowest_m.data();
    const std::uint16_t* const cell = cells.cell.data();
    const float* const z_m = pixels.z_m.data();
    visitByTurns(
        size, [=](std::size_t pixel) __attribute__((always_inline)) {
            float& low_m = lowest_m[cell[pixel]];
            low_m = z_m[pixel] < low_m ? z_m[pixel] : low_m;  // ignores NaN
        });
    HWY_DYNAMIC_DISPATCH(MarkLevelIn)
    (size, z_m, cell, lowest_m, steps, is_level.data());
}

void keepLevelRou(const Image<Label>& labels, const Image<std::uint8_t>& is_level,
                  Image<Label>& candidates) {
    candidates.resize(labels.rows(), labels.cols());
    static_assert(static_cast<int>(Label::Rou) == 1 && static_cast<int>(Label::Unclassified) == 0);
    for (Eigen::Index pixel = 0; pixel < labels.size(); ++pixel) {
        const int is_rou = labels.data()[pixel] == Label::Rou;
        candidates.data()[pixel] = static_cast<Label>(is_rou & is_level.data()[pixel]);
    }
}

void requireEvidence(const PixelPoints& pixels, const PixelCells& cells,
                     const Image<float>& height_m, const Image<std::uint8_t>& is_level,
                     float sensor_height_m, Image<float>& tolerance_m,
                     std::vector<std::uint8_t>& has_evidence) {
    const auto size = static_cast<std::size_t>(height_m.size());
    BlocksAndNone<std::uint64_t> counts{};
    HWY_DYNAMIC_DISPATCH(CountCloseIn)
    (size, pixels.x_m.data(), pixels.y_m.data(), height_m.data(), is_level.data(),
     cells.block.data(), counts.data());
    Blocks<Counts> blocks;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        blocks[k] = {static_cast<int>(counts[k] % kLevelToo),
                     static_cast<int>(counts[k] / kLevelToo)};
    }
    sumAround<kReach>(blocks);

    constexpr float kNothing = -std::numeric_limits<float>::infinity();
    BlocksAndNone<float> min_m;
    has_evidence.assign(min_m.size(), 0);
    const float sight_m = sensor_height_m > kLowest_m ? kSight * sensor_height_m : 0;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        has_evidence[k] = blocks[k].isGround() && blockDistance_m(static_cast<int>(k)) < sight_m;
    }
    for (std::size_t k = 0; k < min_m.size(); ++k) {
        min_m[k] = has_evidence[k] != 0 ? 0.0f : kNothing;
    }
    HWY_DYNAMIC_DISPATCH(WithdrawIn)
    (size, cells.block.data(), min_m.data(), tolerance_m.data());
}

}  // namespace hagen
#endif
