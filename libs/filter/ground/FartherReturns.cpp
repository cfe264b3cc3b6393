#include "filter/ground/FartherReturns.h"
#include "filter/ground/BlockSums.h"
#include "filter/simd/HeightLabels.h"

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/ground/FartherReturns.cpp"
#include <hwy/foreach_target.h>
#include "filter/simd/GroundGrid-inl.h"
#include "filter/simd/MaskBits.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

constexpr float kFarther_m = 0.3f;

/// Lists the returns in the zone that lie behind the pixel's depth, or in front of it (returns of a
/// window that do not count); returns their number.
std::size_t ListFartherIn(std::size_t size, const float* HWY_RESTRICT range_m,
                          const std::int32_t* HWY_RESTRICT pixel, const float* HWY_RESTRICT depth_m,
                          float zone_m, std::int32_t* HWY_RESTRICT list) {
    static_assert(RangeImage::kNoPixel == -1);
    std::int32_t* end = list;
    forEachVector(size, [&](auto d, std::size_t i) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const auto own = hn::LoadU(di, pixel + i), none = hn::Zero(di);
        const auto range = hn::LoadU(d, range_m + i), margin = hn::Set(d, kFarther_m);
        const auto near = hn::GatherIndex(d, depth_m, hn::Max(own, none));
        const auto is_farther =
            hn::Or(hn::Gt(range, hn::Add(near, margin)), hn::Lt(range, hn::Sub(near, margin)));
        const auto is_in_zone = hn::Le(range, hn::Set(d, zone_m));
        const auto has_pixel = hn::RebindMask(d, hn::Gt(own, hn::Set(di, RangeImage::kNoPixel)));
        const auto is_listed = hn::And(hn::And(is_farther, is_in_zone), has_pixel);
        end = AppendBits(BitsOf(d, is_listed), static_cast<std::int32_t>(i), end);
    });
    return static_cast<std::size_t>(end - list);
}

/// The places of the listed returns in the ground frame, and their blocks (PixelCells::block).
void LocateIn(std::size_t n, const Scan& scan, const Eigen::Matrix3f& turn,
              const Eigen::Vector3f& shift_m, FartherReturnsWorkspace& work) {
    constexpr float kBlock_m = kBlockCells * GroundSurface::kCell_m;
    forEachVector(n, [&](auto d, std::size_t k) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const auto i = hn::LoadU(di, work.index.data() + k);
        const auto x = hn::GatherIndex(d, scan.x_m.data(), i);
        const auto y = hn::GatherIndex(d, scan.y_m.data(), i);
        const auto z = hn::GatherIndex(d, scan.z_m.data(), i);
        const auto along = [&](int axis)
                               HAGEN_INLINE { return movedAlong(d, axis, turn, shift_m, x, y, z); };
        const auto x_m = along(0), y_m = along(1);
        hn::StoreU(x_m, d, work.x_m.data() + k);
        hn::StoreU(y_m, d, work.y_m.data() + k);
        hn::StoreU(along(2), d, work.z_m.data() + k);
        const auto blockAlong = [&](auto place_m) HAGEN_INLINE {
            return hn::Floor(
                hn::Add(hn::Div(place_m, hn::Set(d, kBlock_m)), hn::Set(d, 0.5f * kBlocks)));
        };
        const auto isOnGrid = [&](auto block) HAGEN_INLINE {
            return hn::And(hn::Ge(block, hn::Zero(d)), hn::Lt(block, hn::Set(d, kBlocks)));
        };
        const auto row = blockAlong(x_m), column = blockAlong(y_m);
        const auto block = hn::Add(hn::Mul(column, hn::Set(d, kBlocks)), row);
        const auto is_on_grid = hn::And(isOnGrid(row), isOnGrid(column));
        const auto or_none = hn::IfThenElse(is_on_grid, block, hn::Set(d, PixelCells::kNoBlock));
        hn::StoreU(hn::ConvertTo(di, or_none), di, work.block.data() + k);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(ListFartherIn);
HWY_EXPORT(LocateIn);

void reserve(std::size_t size, FartherReturnsWorkspace& work) {
    if (work.index.size() >= size) return;
    for (auto* values : {&work.index, &work.block}) values->resize(size);
    for (auto* values : {&work.x_m, &work.y_m, &work.z_m, &work.height_m}) values->resize(size);
}

}  // namespace

void judgeFartherReturns(const Scan& scan, const RangeImage& image, const Ground& ground,
                         const Clearance& clearance, float zone_m, OwnLabels& own_labels,
                         FartherReturnsWorkspace& work) {
    std::vector<Label>& own_label = own_labels.label;
    own_label.assign(ground.has_surface ? scan.size() : 0, Label::Unclassified);
    own_labels.returns.clear();
    if (own_label.empty() || image.depth_m.size() == 0) return;
    reserve(scan.size() + 1, work);
    std::int32_t* const list = work.index.data();
    const std::size_t n = HWY_DYNAMIC_DISPATCH(ListFartherIn)(scan.size(), scan.range_m.data(),
                                                              image.depth_mapper.data(),
                                                              image.depth_m.data(), zone_m, list);
    own_labels.returns.assign(list, list + n);
    HWY_DYNAMIC_DISPATCH(LocateIn)
    (n, scan, ground.from_sensor.linear(), ground.from_sensor.translation(), work);
    heightsAbove(ground.surface, n, work.x_m.data(), work.y_m.data(), work.z_m.data(),
                 work.height_m.data());
    const bool needs_evidence = !ground.has_evidence.empty();
    for (std::size_t k = 0; k < n; ++k) {
        const float tolerance_m = ground.tolerance_m.data()[image.depth_mapper[list[k]]];
        const bool is_high = work.height_m[k] > tolerance_m;
        const bool is_low = !(work.height_m[k] >= kMinGround_m);
        const bool lacks_evidence = needs_evidence && ground.has_evidence[work.block[k]] == 0;
        const bool is_close =
            clearance.isViolatedBy(ground, {work.x_m[k], work.y_m[k], work.z_m[k]});
        own_label[list[k]] = is_high | is_low | lacks_evidence | is_close ? Label::Roi : Label::Rou;
    }
}

}  // namespace hagen
#endif
