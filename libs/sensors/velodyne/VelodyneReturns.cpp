#include "sensors/velodyne/VelodyneReturns.h"

#include "scan/SetBits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sensors/velodyne/VelodyneReturns.cpp"
#include <hwy/foreach_target.h>
// Must follow foreach_target.h.
#include <hwy/highway.h>

#ifndef HAGEN_PACKETS_VELODYNE_RETURNS_ONCE
#define HAGEN_PACKETS_VELODYNE_RETURNS_ONCE
namespace hagen::sensors {
namespace {

/// True if readings of the block may pass 0 (behind the sensor).
bool crossesZeroAzimuth(const VelodyneBlock& block, const BlockOffsets& places) {
    return block.reading_from_behind + places.max_turn_reading >= kReadingsOfTurn - 0.5f ||
           block.reading_from_behind + places.min_turn_reading < -0.5f;
}

}  // namespace
}  // namespace hagen::sensors
#endif

HWY_BEFORE_NAMESPACE();
namespace hagen::sensors {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kPaddingReturns>;
using Ints = hn::RebindToSigned<Floats>;
using Bytes = hn::Rebind<std::uint8_t, Floats>;

/// Distances and intensities as stored in the packet.
struct RawReturns {
    hn::Vec<Ints> distance, intensity;
};

HWY_INLINE RawReturns load(const std::uint8_t* returns) {
    const Ints d;
    hn::Vec<Bytes> low, high, intensity;
    hn::LoadInterleaved3(Bytes(), returns, low, high, intensity);
    return {hn::Or(hn::PromoteTo(d, low), hn::ShiftLeft<8>(hn::PromoteTo(d, high))),
            hn::PromoteTo(d, intensity)};
}

std::size_t count(const VelodyneBlock* blocks, std::size_t block_count) {
    const hn::CappedTag<std::uint8_t, 16> d;
    std::size_t returns = 0;
    for (const VelodyneBlock* block = blocks; block != blocks + block_count; ++block) {
        for (std::size_t i = 0; i < kReturnsOfBlock; i += hn::Lanes(d)) {
            hn::Vec<decltype(d)> low, high, intensity;
            hn::LoadInterleaved3(d, block->returns + 3 * i, low, high, intensity);
            returns += hn::CountTrue(d, hn::Ne(hn::Or(low, high), hn::Zero(d)));
        }
    }
    return returns;
}

/// Equals the slower division by 255 for integers up to 255, because the first product is exact.
HWY_INLINE hn::Vec<Floats> share(hn::Vec<Floats> of_255) {
    const Floats d;
    constexpr float kUpper = 257.0f / 65536.0f;
    constexpr float kRest = static_cast<float>(1.0 / 255.0 - 257.0 / 65536.0);
    return hn::Add(hn::Mul(of_255, hn::Set(d, kUpper)), hn::Mul(of_255, hn::Set(d, kRest)));
}

struct Direction {
    hn::Vec<Floats> sine, cosine;  ///< clockwise from x
    hn::Vec<Floats> azimuth_rad;   ///< counter-clockwise
};

/// The directions of a block's returns from `i` on: the block's direction, rotated by the offsets.
HWY_INLINE Direction rotateBy(const VelodyneBlock& block, const BlockOffsets& places,
                              std::size_t i) {
    const Floats d;
    const auto sine = hn::Set(d, block.sine), cosine = hn::Set(d, block.cosine);
    const auto turn_sine = hn::LoadU(d, places.turn_sine + i);
    const auto turn_cosine = hn::LoadU(d, places.turn_cosine + i);
    return {hn::Add(hn::Mul(sine, turn_cosine), hn::Mul(cosine, turn_sine)),
            hn::Sub(hn::Mul(cosine, turn_cosine), hn::Mul(sine, turn_sine)),
            hn::Sub(hn::Set(d, block.azimuth_rad), hn::LoadU(d, places.turn_rad + i))};
}

/// Wraps readings at the end of a turn, which has one reading more than a full circle: returns past
/// the end continue at the start, and vice versa.
HWY_INLINE void wrap(const VelodyneBlock& block, const BlockOffsets& places, std::size_t i,
                     Direction& direction) {
    const Floats d;
    const auto reading =
        hn::Add(hn::Set(d, block.reading_from_behind), hn::LoadU(d, places.turn_reading + i));
    const auto is_past = hn::Ge(reading, hn::Set(d, kReadingsOfTurn - 0.5f));
    const auto is_before = hn::Lt(reading, hn::Set(d, -0.5f));
    const auto turns = hn::Sub(hn::IfThenElseZero(is_before, hn::Set(d, 1.0f)),
                               hn::IfThenElseZero(is_past, hn::Set(d, 1.0f)));
    const auto rest_rad = hn::Mul(turns, hn::Set(d, static_cast<float>(kRadiansPerReading)));
    const auto turned_rad =
        hn::Mul(turns, hn::Set(d, static_cast<float>(kReadingsOfTurn * kRadiansPerReading)));
    direction = {hn::Add(direction.sine, hn::Mul(direction.cosine, rest_rad)),
                 hn::Sub(direction.cosine, hn::Mul(direction.sine, rest_rad)),
                 hn::Sub(direction.azimuth_rad, turned_rad)};
}

/// The lanes of a vector that have a return, lowest first.
HWY_INLINE hn::Vec<Bytes> lanesOf(hn::Mask<Ints> came_back) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Ints(), came_back, bits);
    return hn::LoadU(Bytes(), kSetBits.place[bits[0]].data());
}

void locate(const VelodyneBlock* blocks, std::size_t block_count, const BlockOffsets& places,
            const ReturnArrays& arrays) {
    const ReturnArrays to = arrays;  // no aliasing with other writes
    const Floats d;
    const Ints d_int;
    std::size_t n = 0;
    for (const VelodyneBlock* block = blocks; block != blocks + block_count; ++block) {
        const bool passes_behind = crossesZeroAzimuth(*block, places);
        for (std::size_t i = 0; i < kReturnsOfBlock; i += hn::Lanes(d)) {
            const RawReturns raw = load(block->returns + 3 * i);
            Direction direction = rotateBy(*block, places, i);
            if (HWY_UNLIKELY(passes_behind)) wrap(*block, places, i, direction);
            const auto range_m =
                hn::Add(hn::Mul(hn::ConvertTo(d, raw.distance), hn::Set(d, places.distance_unit_m)),
                        hn::LoadU(d, places.distance_m + i));
            const auto horizontal_m =
                hn::Add(hn::Mul(range_m, hn::LoadU(d, places.elevation_cosine + i)),
                        hn::LoadU(d, places.forward_m + i));
            const auto sideways_m = hn::LoadU(d, places.sideways_m + i);
            const auto x_m = hn::Add(hn::Mul(horizontal_m, direction.cosine),
                                     hn::Mul(sideways_m, direction.sine));
            const auto y_m = hn::Sub(hn::Mul(sideways_m, direction.cosine),
                                     hn::Mul(horizontal_m, direction.sine));
            const auto z_m = hn::Add(hn::Mul(range_m, hn::LoadU(d, places.elevation_sine + i)),
                                     hn::LoadU(d, places.up_m + i));
            const auto intensity = share(hn::ConvertTo(d, raw.intensity));
            const auto time_s = hn::Add(hn::Set(d, block->time_s), hn::LoadU(d, places.time_s + i));

            // Compacts returns; later returns overwrite excess lanes.
            const auto came_back = hn::Ne(raw.distance, hn::Zero(d_int));
            const auto byte_lanes = lanesOf(came_back);
            const auto lanes = hn::IndicesFromVec(d, hn::PromoteTo(d_int, byte_lanes));
            hn::StoreU(hn::TableLookupLanes(x_m, lanes), d, to.x_m + n);
            hn::StoreU(hn::TableLookupLanes(y_m, lanes), d, to.y_m + n);
            hn::StoreU(hn::TableLookupLanes(z_m, lanes), d, to.z_m + n);
            hn::StoreU(hn::TableLookupLanes(intensity, lanes), d, to.intensity + n);
            hn::StoreU(hn::TableLookupLanes(range_m, lanes), d, to.range_m + n);
            hn::StoreU(hn::TableLookupLanes(direction.azimuth_rad, lanes), d, to.azimuth_rad + n);
            hn::StoreU(hn::TableLookupLanes(time_s, lanes), d, to.time_s + n);
            const auto row = hn::LoadU(Bytes(), places.row + i);
            hn::StoreU(hn::TableLookupBytes(row, byte_lanes), Bytes(), to.row + n);
            n += hn::CountTrue(d_int, came_back);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen::sensors
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen::sensors {
namespace {

HWY_EXPORT(count);
HWY_EXPORT(locate);

}  // namespace

std::size_t countReturns(const std::vector<VelodyneBlock>& blocks) {
    return HWY_DYNAMIC_DISPATCH(count)(blocks.data(), blocks.size());
}

void locateReturns(const std::vector<VelodyneBlock>& blocks, const BlockOffsets& places,
                   const ReturnArrays& returns) {
    HWY_DYNAMIC_DISPATCH(locate)(blocks.data(), blocks.size(), places, returns);
}

}  // namespace hagen::sensors
#endif
