#include <hagen/segmentation/HeightLabels.h>
#include <algorithm>
#include <cmath>
#include <vector>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "HeightLabels.cpp"
#include <hwy/foreach_target.h>
#include "GroundGrid-inl.h"
#include "MaskBits.h"

#ifndef HAGEN_HEIGHT_LABELS
#define HAGEN_HEIGHT_LABELS
namespace hagen {
namespace {

constexpr int kCells = GroundSurface::kCells;
constexpr float kLeastTolerance_m = 0.04f;
constexpr float kTallest_m = 1.1f;       // more than this is no reason to tolerate less
constexpr float kFootHeight_m = 0.015f;  // a foot is no lower than this
constexpr int kFootRows = 4;             // a pixel's angle is with the next of so many rows above
constexpr float kDoubt_m = 0.2f;         // a height so close to its tolerance is put to the vote
constexpr float kVoteSteps_per_m = 64;   // whole numbers are twice as many a vector
constexpr float kFarthest_m = 511.0f;    // in these
constexpr int kVoteReach = 64;           // 1 m, in distance from the sensor
constexpr int kLeastVotes = 3;
constexpr int kVote = 1, kVoteForRoi = 17;  // sums of 9 tell both numbers, the latter's in 16s

}  // namespace
}  // namespace hagen
#endif

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

/// The tallest of each cell and its eight neighbours, within 0 and kTallest_m. The border gets that
/// of the cells beside it.
void TallestAroundIn(const float* HWY_RESTRICT top_m, float* HWY_RESTRICT tallest_m) {
    const hn::ScalableTag<float> d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int j = 0; j < kCells; ++j) {
        float* HWY_RESTRICT result_m = tallest_m + gridColumn(j);
        for (int i = 0; i < kCells; i += lanes) {
            const float* HWY_RESTRICT cell = top_m + gridColumn(j) + i;
            auto highest_m = hn::Zero(d);
            for (const int column : {-kGridStride, 0, kGridStride}) {
                for (const int row : {-1, 0, 1}) {
                    highest_m = hn::Max(highest_m, hn::LoadU(d, cell + column + row));
                }
            }
            hn::StoreU(hn::Min(highest_m, hn::Set(d, kTallest_m)), d, result_m + i);
        }
        result_m[-1] = result_m[0];
        result_m[kCells] = result_m[kCells - 1];
    }
    const auto copyColumn = [&](int from, int to) {
        std::copy_n(tallest_m + gridColumn(from) - 1, kGridStride, tallest_m + gridColumn(to) - 1);
    };
    copyColumn(0, -1);
    copyColumn(kCells - 1, kCells);
}

void ToleratedHeightsIn(std::size_t pixels, const float* HWY_RESTRICT x_m,
                        const float* HWY_RESTRICT y_m, const std::int32_t* HWY_RESTRICT cell,
                        const float* HWY_RESTRICT tallest_m, const HeightTolerance& tolerance,
                        float* HWY_RESTRICT tolerance_m) {
    forEachVector(pixels, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const auto x = hn::LoadU(d, x_m + pixel), y = hn::LoadU(d, y_m + pixel);
        const auto distance_m = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
        const auto tall_m = hn::GatherIndex(d, tallest_m, hn::LoadU(di, cell + pixel));
        const auto tolerated_m = hn::Sub(
            hn::Add(hn::Set(d, tolerance.near_m), hn::Mul(hn::Set(d, tolerance.per_m), distance_m)),
            hn::Mul(hn::Set(d, tolerance.beside_tall), tall_m));
        const auto least_m = hn::Set(d, kLeastTolerance_m);
        const auto is_less = hn::Lt(tolerated_m, least_m);  // not where it is NaN
        hn::StoreU(hn::IfThenElse(is_less, least_m, tolerated_m), d, tolerance_m + pixel);
    });
}

void LabelByHeightIn(std::size_t pixels, const float* HWY_RESTRICT height_m,
                     const float* HWY_RESTRICT tolerance_m, std::uint8_t* HWY_RESTRICT label) {
    forEachVector(pixels, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const hn::Rebind<std::uint8_t, decltype(d)> d8;
        const auto h_m = hn::LoadU(d, height_m + pixel);
        const auto has_value = hn::RebindMask(di, hn::Eq(h_m, h_m));
        const auto is_high = hn::RebindMask(di, hn::Gt(h_m, hn::LoadU(d, tolerance_m + pixel)));
        const auto is = [&](Label what)
                            HAGEN_INLINE { return hn::Set(di, static_cast<std::int32_t>(what)); };
        const auto rou_or_roi = hn::IfThenElse(is_high, is(Label::Roi), is(Label::Rou));
        static_assert(static_cast<int>(Label::Unclassified) == 0);
        hn::StoreU(hn::DemoteTo(d8, hn::IfThenElseZero(has_value, rou_or_roi)), d8, label + pixel);
    });
}

/// Lists, in order, the pixels that may be a foot: ROU above kFootHeight_m with a RoI among the
/// next kFootRows, be it in the next column; and the last ones.
std::size_t ListFeetIn(std::size_t pixels, const float* HWY_RESTRICT height_m,
                       const std::uint8_t* HWY_RESTRICT label, std::int32_t* HWY_RESTRICT list) {
    std::int32_t* end = list;
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    const hn::Rebind<std::uint8_t, decltype(d)> d8;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t pixel = 0;
    for (; pixel + lanes + kFootRows <= pixels; pixel += lanes) {
        const auto labelsFrom = [&](std::size_t first) HAGEN_INLINE {
            return hn::PromoteTo(di, hn::LoadU(d8, label + first));
        };
        auto above = labelsFrom(pixel + 1);  // a bit for each label there is
        for (int rows = 2; rows <= kFootRows; ++rows)
            above = hn::Or(above, labelsFrom(pixel + rows));
        static_assert(static_cast<int>(Label::Rou) == 1 && static_cast<int>(Label::Roi) == 2);
        const auto is_below_roi = hn::Gt(above, hn::Set(di, 1));
        const auto is_rou = hn::Eq(labelsFrom(pixel), hn::Set(di, 1));
        const auto is_high = hn::Gt(hn::LoadU(d, height_m + pixel), hn::Set(d, kFootHeight_m));
        const auto may_be = hn::And(hn::RebindMask(d, hn::And(is_below_roi, is_rou)), is_high);
        end = AppendBits(BitsOf(d, may_be), static_cast<std::int32_t>(pixel), end);
    }
    for (; pixel < pixels; ++pixel) *end++ = static_cast<std::int32_t>(pixel);
    return static_cast<std::size_t>(end - list);
}

/// A column of the images of the vote; see Ballot.
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
            hn::Add(hn::Mul(horizontal_m, hn::Set(d, kVoteSteps_per_m)), hn::Set(d, 0.5f));
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

/// What the vote makes of each pixel: a label, or 0 where it stays as it is. Whole vectors, which
/// may go beyond `end`.
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
            hn::And(hn::Gt(votes, hn::Set(d, kLeastVotes - 1)), hn::Ne(twice_for_roi, votes));
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

HWY_EXPORT(TallestAroundIn);
HWY_EXPORT(ToleratedHeightsIn);
HWY_EXPORT(LabelByHeightIn);
HWY_EXPORT(ListFeetIn);
HWY_EXPORT(EnterColumnIn);
HWY_EXPORT(CountVotesIn);

/// The images of the vote, column by column with a border: empty pixels above and below, and beside
/// the first and the last column each other. So every pixel has its neighbours at the same steps.
struct Ballot {
    std::vector<std::int16_t> distance;  ///< from the sensor, along the ground, in steps
    std::vector<std::int16_t> doubt;     ///< all bits where it can change, none elsewhere
    std::vector<std::int16_t> vote;      ///< kVoteForRoi or kVote, 0 where it is empty
    std::vector<std::uint8_t> elected;

    /// Room for whole vectors, too.
    void resize(std::size_t size) {
        constexpr std::size_t kWidest = 64;
        for (auto* image : {&distance, &doubt, &vote}) image->resize(size + kWidest);
        elected.resize(size + kWidest);
    }
};

std::uint8_t* bytesOf(Image<Label>& labels) {
    static_assert(sizeof(Label) == 1);
    return reinterpret_cast<std::uint8_t*>(labels.data());
}

/// Whether a ROU pixel is the foot of the RoI pixel above it.
bool isFoot(const PixelPoints& pixels, const Image<float>& height_m, Eigen::Index pixel,
            Eigen::Index above) {
    const Eigen::Vector3f up_m = pixels.at(above) - pixels.at(pixel);
    const bool is_steep =
        up_m.z() * up_m.z() > up_m.x() * up_m.x() + up_m.y() * up_m.y();  // > 45 deg
    return is_steep && above - pixel <= kFootRows && height_m.data()[pixel] > kFootHeight_m;
}

/// From `pixel`, if it is a foot, down its column as far as there are feet.
void growDown(const PixelPoints& pixels, const Image<float>& height_m, Eigen::Index pixel,
              Image<Label>& labels) {
    const Eigen::Index rows = labels.rows(), first = pixel / rows * rows, end = first + rows;
    Label* const label = labels.data();
    Eigen::Index above = pixel + 1;
    while (above < end && label[above] == Label::Unclassified) ++above;
    if (above == end || label[above] != Label::Roi) return;
    while (label[pixel] == Label::Rou && isFoot(pixels, height_m, pixel, above)) {
        label[pixel] = Label::Roi;
        above = pixel;
        do {
            if (pixel == first) return;
            --pixel;
        } while (label[pixel] == Label::Unclassified);
    }
}

}  // namespace

void toleratedHeights(const PixelPoints& pixels, const CellTops& tops,
                      const HeightTolerance& tolerance, Image<float>& tolerance_m) {
    // Kept from scan to scan, so that none is allocated; holds nothing between them.
    thread_local std::vector<float> tallest_m(kGridSize);
    HWY_DYNAMIC_DISPATCH(TallestAroundIn)(tops.top_m.data(), tallest_m.data());
    tolerance_m.resize(tops.cell.rows(), tops.cell.cols());
    HWY_DYNAMIC_DISPATCH(ToleratedHeightsIn)
    (tolerance_m.size(), pixels.x_m.data(), pixels.y_m.data(), tops.cell.data(), tallest_m.data(),
     tolerance, tolerance_m.data());
}

void labelByHeight(const Image<float>& height_m, const Image<float>& tolerance_m,
                   Image<Label>& labels) {
    labels.resize(height_m.rows(), height_m.cols());
    HWY_DYNAMIC_DISPATCH(LabelByHeightIn)
    (height_m.size(), height_m.data(), tolerance_m.data(), bytesOf(labels));
}

void growFeet(const PixelPoints& pixels, const Image<float>& height_m, Image<Label>& labels) {
    // Kept from scan to scan, so that none is allocated; holds nothing between them.
    thread_local std::vector<std::int32_t> kept_list;
    const std::size_t size = static_cast<std::size_t>(labels.size());
    kept_list.resize(std::max(kept_list.size(), size));
    const std::int32_t* const list = kept_list.data();
    std::size_t n =
        HWY_DYNAMIC_DISPATCH(ListFeetIn)(size, height_m.data(), bytesOf(labels), kept_list.data());
    while (n > 0) growDown(pixels, height_m, list[--n], labels);  // from above
}

void removeSpecks(const PixelPoints& pixels, const Image<float>& height_m,
                  const Image<float>& tolerance_m, Image<Label>& labels) {
    const int rows = static_cast<int>(labels.rows()), columns = static_cast<int>(labels.cols());
    // Kept from scan to scan, so that none is allocated; holds nothing between them.
    thread_local Ballot kept_ballot;
    Ballot& ballot = kept_ballot;
    const int stride = rows + 2;
    ballot.resize(static_cast<std::size_t>(stride) * (columns + 2));
    const auto placeOf = [&](int column) { return (column + 1) * stride + 1; };
    for (int column = -1; column <= columns; ++column) {
        const Eigen::Index from = static_cast<Eigen::Index>(rows) * wrapColumn(column, columns);
        const int to = placeOf(column);
        HWY_DYNAMIC_DISPATCH(EnterColumnIn)
        (rows, pixels.x_m.data() + from, pixels.y_m.data() + from, height_m.data() + from,
         tolerance_m.data() + from, bytesOf(labels) + from, ballot.distance.data() + to,
         ballot.doubt.data() + to, ballot.vote.data() + to);
        for (const int border : {to - 1, to + rows}) {
            ballot.distance[border] = ballot.doubt[border] = ballot.vote[border] = 0;
        }
    }
    HWY_DYNAMIC_DISPATCH(CountVotesIn)
    (placeOf(0), placeOf(columns - 1) + rows, stride, ballot.distance.data(), ballot.doubt.data(),
     ballot.vote.data(), ballot.elected.data());
    for (int column = 0; column < columns; ++column) {
        std::uint8_t* const label = bytesOf(labels) + static_cast<Eigen::Index>(rows) * column;
        const std::uint8_t* const elected = ballot.elected.data() + placeOf(column);
        for (int row = 0; row < rows; ++row) {
            label[row] = elected[row] != 0 ? elected[row] : label[row];
        }
    }
}

}  // namespace hagen
#endif
