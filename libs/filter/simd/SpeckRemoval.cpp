#include "filter/simd/SpeckRemoval.h"
#include <cmath>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/simd/SpeckRemoval.cpp"
#include <hwy/foreach_target.h>
#include "filter/simd/GroundGrid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

using namespace speck_rules;
constexpr int kVote = 1, kVoteForRoi = 17;  // a sum of 9 contains both counts, RoI votes times 16

/// Fills one column of the images in SpeckWorkspace.
void EnterColumnIn(std::size_t rows, const float* HWY_RESTRICT x_m, const float* HWY_RESTRICT y_m,
                   const float* HWY_RESTRICT height_m, const float* HWY_RESTRICT tolerance_m,
                   const std::uint8_t* HWY_RESTRICT label, std::int16_t* HWY_RESTRICT distance,
                   std::int16_t* HWY_RESTRICT doubt, std::int16_t* HWY_RESTRICT vote) {
    forEachVector(rows, [&](auto d, std::size_t row) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const hn::Rebind<std::int16_t, decltype(d)> d16;
        const hn::Rebind<std::uint8_t, decltype(d)> d8;
        const auto x = hn::LoadU(d, x_m + row), y = hn::LoadU(d, y_m + row);
        const auto h_m = hn::LoadU(d, height_m + row), farthest_m = hn::Set(d, kFarthest_m);
        const auto has_value = hn::Eq(h_m, h_m);
        const auto horizontal_m = hn::IfThenElse(
            has_value, hn::Min(hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y))), farthest_m),
            farthest_m);
        const auto steps =
            hn::Add(hn::Mul(horizontal_m, hn::Set(d, kSteps_per_m)), hn::Set(d, 0.5f));
        hn::StoreU(hn::DemoteTo(d16, hn::ConvertTo(di, steps)), d16, distance + row);

        const auto beyond_m = hn::Sub(h_m, hn::LoadU(d, tolerance_m + row));
        const auto is_doubtful = hn::Lt(hn::Abs(beyond_m), hn::Set(d, kDoubt_m));
        hn::StoreU(hn::DemoteTo(d16, hn::VecFromMask(di, hn::RebindMask(di, is_doubtful))), d16,
                   doubt + row);

        const auto labels = hn::PromoteTo(di, hn::LoadU(d8, label + row));
        const auto is_roi = hn::Eq(labels, hn::Set(di, static_cast<std::int32_t>(Label::Roi)));
        const auto own = hn::IfThenElse(is_roi, hn::Set(di, kVoteForRoi), hn::Set(di, kVote));
        hn::StoreU(hn::DemoteTo(d16, hn::IfThenElseZero(hn::RebindMask(di, has_value), own)), d16,
                   vote + row);
    });
}

/// The new label per pixel, or 0 to keep the old one. Writes whole vectors, possibly past `end`.
void CountVotesIn(std::size_t first, std::size_t end, std::size_t stride,
                  const std::int16_t* HWY_RESTRICT distance, const std::int16_t* HWY_RESTRICT doubt,
                  const std::int16_t* HWY_RESTRICT vote, std::uint8_t* HWY_RESTRICT elected) {
    const hn::ScalableTag<std::int16_t> d;
    const hn::Rebind<std::uint8_t, decltype(d)> d8;
    const auto is = [&](Label what)
                        HAGEN_INLINE { return hn::Set(d, static_cast<std::int16_t>(what)); };
    for (std::size_t pixel = first; pixel < end; pixel += hn::Lanes(d)) {
        const auto own = hn::LoadU(d, distance + pixel);
        auto sum = hn::Zero(d);
        for (const std::size_t column : {pixel - stride, pixel, pixel + stride}) {
            for (const std::size_t voter : {column - 1, column, column + 1}) {
                const auto apart = hn::Abs(hn::Sub(hn::LoadU(d, distance + voter), own));
                const auto has_vote = hn::Lt(apart, hn::Set(d, kVoteReach + 1));
                sum = hn::Add(sum, hn::IfThenElseZero(has_vote, hn::LoadU(d, vote + voter)));
            }
        }
        const auto votes = hn::And(sum, hn::Set(d, 15));
        const auto for_roi = hn::ShiftRight<4>(sum), twice_for_roi = hn::Add(for_roi, for_roi);
        const auto is_decided =
            hn::And(hn::Gt(votes, hn::Set(d, kMinVotes - 1)), hn::Ne(twice_for_roi, votes));
        const auto winner =
            hn::IfThenElse(hn::Gt(twice_for_roi, votes), is(Label::Roi), is(Label::Rou));
        const auto change =
            hn::And(hn::LoadU(d, doubt + pixel), hn::IfThenElseZero(is_decided, winner));
        hn::StoreU(hn::DemoteTo(d8, change), d8, elected + pixel);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(EnterColumnIn);
HWY_EXPORT(CountVotesIn);

void resize(std::size_t size, SpeckWorkspace& work) {
    constexpr std::size_t kMaxWidth = 64;
    for (auto* image : {&work.distance, &work.doubt, &work.vote}) image->resize(size + kMaxWidth);
    work.elected.resize(size + kMaxWidth);
}

std::uint8_t* bytesOf(Image<Label>& labels) {
    static_assert(sizeof(Label) == 1);
    return reinterpret_cast<std::uint8_t*>(labels.data());
}

}  // namespace

void removeSpecks(const PixelPoints& pixels, const Image<float>& height_m,
                  const Image<float>& tolerance_m, Image<Label>& labels, SpeckWorkspace& work) {
    const int rows = static_cast<int>(labels.rows()), columns = static_cast<int>(labels.cols());
    const int stride = rows + 2;
    resize(static_cast<std::size_t>(stride) * (columns + 2), work);
    const auto placeOf = [&](int column) { return (column + 1) * stride + 1; };
    for (int column = -1; column <= columns; ++column) {
        const Eigen::Index from = static_cast<Eigen::Index>(rows) * wrapColumn(column, columns);
        const int to = placeOf(column);
        HWY_DYNAMIC_DISPATCH(EnterColumnIn)
        (rows, pixels.x_m.data() + from, pixels.y_m.data() + from, height_m.data() + from,
         tolerance_m.data() + from, bytesOf(labels) + from, work.distance.data() + to,
         work.doubt.data() + to, work.vote.data() + to);
        for (const int border : {to - 1, to + rows}) {
            work.distance[border] = work.doubt[border] = work.vote[border] = 0;
        }
    }
    HWY_DYNAMIC_DISPATCH(CountVotesIn)
    (placeOf(0), placeOf(columns - 1) + rows, stride, work.distance.data(), work.doubt.data(),
     work.vote.data(), work.elected.data());
    for (int column = 0; column < columns; ++column) {
        std::uint8_t* const label = bytesOf(labels) + static_cast<Eigen::Index>(rows) * column;
        const std::uint8_t* const elected = work.elected.data() + placeOf(column);
        for (int row = 0; row < rows; ++row) {
            label[row] = elected[row] != 0 ? elected[row] : label[row];
        }
    }
}

}  // namespace hagen
#endif
