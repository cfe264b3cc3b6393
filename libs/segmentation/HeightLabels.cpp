#include <hagen/segmentation/HeightLabels.h>
#include <algorithm>
#include <cmath>
#include <vector>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "HeightLabels.cpp"
#include <hwy/foreach_target.h>
#include "GroundGrid-inl.h"

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
constexpr float kVoteReach_m = 1.0f;     // in distance from the sensor
constexpr int kLeastVotes = 3;
constexpr float kVote = 1, kVoteForRoi = 17;  // sums of 9 tell both numbers, the latter's in 16s

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

/// A column of the images of the vote; see Ballot.
void EnterColumnIn(std::size_t rows, const float* HWY_RESTRICT x_m, const float* HWY_RESTRICT y_m,
                   const float* HWY_RESTRICT height_m, const float* HWY_RESTRICT tolerance_m,
                   const std::uint8_t* HWY_RESTRICT label, float* HWY_RESTRICT distance_m,
                   float* HWY_RESTRICT beyond_m, float* HWY_RESTRICT vote) {
    forEachVector(rows, [&](auto d, std::size_t row) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const hn::Rebind<std::uint8_t, decltype(d)> d8;
        const auto x = hn::LoadU(d, x_m + row), y = hn::LoadU(d, y_m + row);
        const auto h_m = hn::LoadU(d, height_m + row);
        const auto horizontal_m = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
        hn::StoreU(hn::IfThenElse(hn::Eq(h_m, h_m), horizontal_m, h_m), d, distance_m + row);
        hn::StoreU(hn::Sub(h_m, hn::LoadU(d, tolerance_m + row)), d, beyond_m + row);
        const auto labels = hn::PromoteTo(di, hn::LoadU(d8, label + row));
        const auto is_roi = hn::Eq(labels, hn::Set(di, static_cast<std::int32_t>(Label::Roi)));
        hn::StoreU(
            hn::IfThenElse(hn::RebindMask(d, is_roi), hn::Set(d, kVoteForRoi), hn::Set(d, kVote)),
            d, vote + row);
    });
}

/// What the vote makes of each pixel: a label, or 0 where it stays as it is.
void CountVotesIn(std::size_t first, std::size_t end, int stride,
                  const float* HWY_RESTRICT distance_m, const float* HWY_RESTRICT beyond_m,
                  const float* HWY_RESTRICT vote, std::uint8_t* HWY_RESTRICT elected) {
    forEachVector(end - first, [&](auto d, std::size_t i) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const hn::Rebind<std::uint8_t, decltype(d)> d8;
        const std::size_t pixel = first + i;
        const auto own_m = hn::LoadU(d, distance_m + pixel);
        const auto reach_m = hn::Set(d, kVoteReach_m);
        auto sum = hn::Zero(d);
        for (int column = -1; column <= 1; ++column) {
            for (int row = -1; row <= 1; ++row) {
                const std::size_t voter = pixel + column * stride + row;
                const auto apart_m = hn::Abs(hn::Sub(hn::LoadU(d, distance_m + voter), own_m));
                const auto has_vote = hn::Le(apart_m, reach_m);  // not where it is NaN
                sum = hn::Add(sum, hn::IfThenElseZero(has_vote, hn::LoadU(d, vote + voter)));
            }
        }
        const auto counted = hn::ConvertTo(di, sum);
        const auto votes = hn::And(counted, hn::Set(di, 15));
        const auto twice_for_roi = hn::ShiftLeft<1>(hn::ShiftRight<4>(counted));
        const auto is_doubtful = hn::RebindMask(
            di, hn::Lt(hn::Abs(hn::LoadU(d, beyond_m + pixel)), hn::Set(d, kDoubt_m)));
        const auto is_decided =
            hn::And(hn::Gt(votes, hn::Set(di, kLeastVotes - 1)), hn::Ne(twice_for_roi, votes));
        const auto is = [&](Label what)
                            HAGEN_INLINE { return hn::Set(di, static_cast<std::int32_t>(what)); };
        const auto winner =
            hn::IfThenElse(hn::Gt(twice_for_roi, votes), is(Label::Roi), is(Label::Rou));
        const auto changes = hn::And(is_doubtful, is_decided);
        hn::StoreU(hn::DemoteTo(d8, hn::IfThenElseZero(changes, winner)), d8, elected + pixel);
    });
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
HWY_EXPORT(EnterColumnIn);
HWY_EXPORT(CountVotesIn);

/// The images of the vote, column by column with a border: empty pixels above and below, and beside
/// the first and the last column each other. So every pixel has its neighbours at the same steps.
struct Ballot {
    std::vector<float> distance_m;  ///< from the sensor, along the ground; NaN: empty
    std::vector<float> beyond_m;    ///< the tolerance
    std::vector<float> vote;        ///< kVoteForRoi or kVote
    std::vector<std::uint8_t> elected;

    void resize(std::size_t size) {
        for (auto* image : {&distance_m, &beyond_m, &vote}) image->resize(size);
        elected.resize(size);
    }
};

std::uint8_t* bytesOf(Image<Label>& labels) {
    static_assert(sizeof(Label) == 1);
    return reinterpret_cast<std::uint8_t*>(labels.data());
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
    const int rows = static_cast<int>(labels.rows());
    for (int column = 0; column < labels.cols(); ++column) {
        Label* const label = labels.col(column).data();
        int above = rows + kFootRows;  // out of reach
        Label label_above = Label::Unclassified;
        for (int row = rows - 1; row >= 0; --row) {
            if ((label[row] == Label::Rou) & (label_above == Label::Roi)) {  // few are
                const float dx_m = pixels.x_m(above, column) - pixels.x_m(row, column);
                const float dy_m = pixels.y_m(above, column) - pixels.y_m(row, column);
                const float dz_m = pixels.z_m(above, column) - pixels.z_m(row, column);
                const bool is_steep = dz_m * dz_m > dx_m * dx_m + dy_m * dy_m;  // than 45 degrees
                const bool is_foot =
                    is_steep && above - row <= kFootRows && height_m(row, column) > kFootHeight_m;
                if (is_foot) label[row] = Label::Roi;
            }
            const bool is_empty = label[row] == Label::Unclassified;
            above = is_empty ? above : row;
            label_above = is_empty ? label_above : label[row];
        }
    }
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
         tolerance_m.data() + from, bytesOf(labels) + from, ballot.distance_m.data() + to,
         ballot.beyond_m.data() + to, ballot.vote.data() + to);
        for (const int border : {to - 1, to + rows}) {
            ballot.distance_m[border] = ballot.beyond_m[border] = kNoValue;
            ballot.vote[border] = 0;
        }
    }
    HWY_DYNAMIC_DISPATCH(CountVotesIn)
    (placeOf(0), placeOf(columns - 1) + rows, stride, ballot.distance_m.data(),
     ballot.beyond_m.data(), ballot.vote.data(), ballot.elected.data());
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
