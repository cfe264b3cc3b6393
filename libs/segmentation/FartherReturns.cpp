#include <hagen/segmentation/FartherReturns.h>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "FartherReturns.cpp"
#include <hwy/foreach_target.h>
#include "GroundGrid-inl.h"
#include "MaskBits.h"

#ifndef HAGEN_FARTHER_RETURNS
#define HAGEN_FARTHER_RETURNS
namespace hagen {
namespace {

constexpr float kFarther_m = 0.3f;

}  // namespace
}  // namespace hagen
#endif

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

/// Lists the returns that are farther than their pixel's depth, in order; gives how many. Few are,
/// so that most vectors end with a look at their mask.
std::size_t ListFartherIn(std::size_t returns, const float* HWY_RESTRICT range_m,
                          const std::int32_t* HWY_RESTRICT pixel, const float* HWY_RESTRICT depth_m,
                          std::int32_t* HWY_RESTRICT list) {
    std::int32_t* end = list;
    forEachVector(returns, [&](auto d, std::size_t i) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        static_assert(RangeImage::kNoPixel < 0);
        const auto pixels = hn::LoadU(di, pixel + i), zero = hn::Zero(di);
        const auto has_pixel = hn::RebindMask(d, hn::Gt(pixels, hn::Set(di, -1)));
        const auto depths_m = hn::GatherIndex(d, depth_m, hn::Max(pixels, zero));
        const auto is_farther =
            hn::Gt(hn::LoadU(d, range_m + i), hn::Add(depths_m, hn::Set(d, kFarther_m)));
        end = AppendBits(BitsOf(d, hn::And(has_pixel, is_farther)), static_cast<std::int32_t>(i),
                         end);
    });
    return static_cast<std::size_t>(end - list);
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(ListFartherIn);

/// The returns to judge, in the ground's frame.
struct Farther {
    std::vector<std::int32_t> index;  ///< in the scan
    std::vector<float> x_m, y_m, z_m, height_m;

    void reserve(std::size_t size) {
        if (index.size() >= size) return;
        index.resize(size);
        for (auto* values : {&x_m, &y_m, &z_m, &height_m}) values->resize(size);
    }
};

}  // namespace

void judgeFartherReturns(const Scan& scan, const RangeImage& image, const Ground& ground,
                         std::vector<Label>& own_label) {
    own_label.assign(scan.size(), Label::Unclassified);
    if (image.depth_m.size() == 0) return;
    // Kept from scan to scan, so that none is allocated; holds nothing between them.
    thread_local Farther kept_farther;
    Farther& farther = kept_farther;
    farther.reserve(scan.size());

    const std::int32_t* const pixels = image.depth_mapper.data();
    const std::int32_t* const list = farther.index.data();
    const std::size_t n = HWY_DYNAMIC_DISPATCH(ListFartherIn)(
        scan.size(), scan.range_m.data(), pixels, image.depth_m.data(), farther.index.data());
    for (std::size_t k = 0; k < n; ++k) {
        const std::int32_t i = list[k];
        const Eigen::Vector3f point =
            ground.from_sensor * Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        farther.x_m[k] = point.x();
        farther.y_m[k] = point.y();
        farther.z_m[k] = point.z();
    }
    heightsAbove(ground.surface, n, farther.x_m.data(), farther.y_m.data(), farther.z_m.data(),
                 farther.height_m.data());
    for (std::size_t k = 0; k < n; ++k) {
        const float tolerance_m = ground.tolerance_m.data()[pixels[list[k]]];
        own_label[list[k]] = farther.height_m[k] > tolerance_m ? Label::Roi : Label::Rou;
    }
}

}  // namespace hagen
#endif
