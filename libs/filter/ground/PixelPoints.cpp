#include <hagen/filter/PixelPoints.h>
#include <algorithm>
#include <cstdint>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/ground/PixelPoints.cpp"
#include <hwy/foreach_target.h>
#include "filter/simd/GroundGrid-inl.h"
#include "filter/simd/MaskBits.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

/// Locates the pixels from `first` to `end` at their closest returns; NaN without one. Lists the
/// other pixels that have a depth; returns their number.
std::size_t LocateReturnsIn(std::size_t first, std::size_t end, const float* scan_x_m,
                            const float* scan_y_m, const float* scan_z_m,
                            const std::int32_t* HWY_RESTRICT closest,
                            const float* HWY_RESTRICT depth_m, PixelPoints& pixels,
                            std::int32_t* HWY_RESTRICT repaired) {
    static_assert(RangeImage::kNoReturn == -1);
    std::int32_t* last = repaired;
    float* const x_m = pixels.x_m.data() + first;
    float* const y_m = pixels.y_m.data() + first;
    float* const z_m = pixels.z_m.data() + first;
    forEachVector(end - first, [&](auto d, std::size_t k) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const auto i = hn::LoadU(di, closest + first + k);
        const auto has_return = hn::RebindMask(d, hn::Gt(i, hn::Set(di, RangeImage::kNoReturn)));
        const auto place = hn::Max(i, hn::Zero(di));
        const auto copy = [&](const float* from_m, float* to_m) HAGEN_INLINE {
            const auto value = hn::GatherIndex(d, from_m, place);
            hn::StoreU(hn::IfThenElse(has_return, value, hn::Set(d, kNoValue)), d, to_m + k);
        };
        copy(scan_x_m, x_m);
        copy(scan_y_m, y_m);
        copy(scan_z_m, z_m);
        const auto depth = hn::LoadU(d, depth_m + first + k);
        const auto is_repaired = hn::AndNot(has_return, hn::Eq(depth, depth));
        last = AppendBits(BitsOf(d, is_repaired), static_cast<std::int32_t>(first + k), last);
    });
    return static_cast<std::size_t>(last - repaired);
}

void MovePixelsIn(std::size_t size, const Eigen::Matrix3f& turn, const Eigen::Vector3f& shift_m,
                  PixelPoints& pixels) {
    float* const x_m = pixels.x_m.data();
    float* const y_m = pixels.y_m.data();
    float* const z_m = pixels.z_m.data();
    forEachVector(size, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const auto x = hn::LoadU(d, x_m + pixel), y = hn::LoadU(d, y_m + pixel);
        const auto z = hn::LoadU(d, z_m + pixel);
        const auto moved = [&](int axis)
                               HAGEN_INLINE { return movedAlong(d, axis, turn, shift_m, x, y, z); };
        hn::StoreU(moved(0), d, x_m + pixel);
        hn::StoreU(moved(1), d, y_m + pixel);
        hn::StoreU(moved(2), d, z_m + pixel);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(LocateReturnsIn);
HWY_EXPORT(MovePixelsIn);

}  // namespace

void locatePixels(const Scan& scan, const PixelDirections& directions, const RangeImage& image,
                  const Image<float>& depth_m, PixelPoints& pixels) {
    constexpr std::size_t kPart = 1024;  // pixels
    static constexpr float kEmptyScan = kNoValue;
    const Eigen::Index rows = depth_m.rows(), columns = depth_m.cols();
    for (auto* coordinate : {&pixels.x_m, &pixels.y_m, &pixels.z_m}) {
        coordinate->resize(rows, columns);
    }
    const auto from = [&](const std::vector<float>& values) {
        return values.empty() ? &kEmptyScan : values.data();
    };
    std::int32_t repaired[kPart];
    const auto size = static_cast<std::size_t>(depth_m.size());
    for (std::size_t first = 0; first < size; first += kPart) {
        const std::size_t n = HWY_DYNAMIC_DISPATCH(LocateReturnsIn)(
            first, std::min(first + kPart, size), from(scan.x_m), from(scan.y_m), from(scan.z_m),
            image.closest_return.data(), depth_m.data(), pixels, repaired);
        for (std::size_t k = 0; k < n; ++k) {
            const Eigen::Index pixel = repaired[k], row = pixel % rows, column = pixel / rows;
            const float depth = depth_m.data()[pixel];
            const float level_m = depth * directions.row_cosine[row];
            pixels.set(pixel, {level_m * directions.column_cosine[column],
                               level_m * directions.column_sine[column],
                               depth * directions.row_sine[row]});
        }
    }
}

void movePixels(const Eigen::Isometry3f& to_from_here, PixelPoints& pixels) {
    HWY_DYNAMIC_DISPATCH(MovePixelsIn)
    (static_cast<std::size_t>(pixels.x_m.size()), to_from_here.linear(), to_from_here.translation(),
     pixels);
}

}  // namespace hagen
#endif
