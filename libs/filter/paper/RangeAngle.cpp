// Vectors run along columns, including empty pixels: a branch per pixel would cost more than the
// arithmetic.
#include "filter/paper/RangeAngle.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/paper/RangeAngle.cpp"
#include <hwy/foreach_target.h>  // once per instruction set
#include <hwy/highway.h>

#include "filter/paper/SlopeAngle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

/// Computes the I_h - 1 angles of a column from its I_h depths.
void columnAngles(const float* depth_m, const float* sine, const float* cosine, int angles,
                  float* angle_rad) {
    coverRows(angles, [=](auto d, int row) HWY_ATTR {
        const auto [out_m, up_m] = stepToBeamAbove(d, depth_m + row, sine + row, cosine + row);
        hn::StoreU(slopeAngle(d, hn::Abs(up_m), hn::Abs(out_m)), d, angle_rad + row);
    });
}

/// Selects the first angle of each pixel if present, otherwise the second.
void columnCarried(const float* first_rad, const float* second_rad, int pixels,
                   float* pixel_angle_rad) {
    coverRows(pixels, [=](auto d, int row) HWY_ATTR {
        const auto first = hn::LoadU(d, first_rad + row), second = hn::LoadU(d, second_rad + row);
        hn::StoreU(hn::IfThenElse(hn::IsNaN(first), second, first), d, pixel_angle_rad + row);
    });
}

}  // namespace

void allAngles(const Image<float>& depth_m, const PixelDirections& directions,
               Image<float>& range_angle_rad) {
    const int angles = static_cast<int>(range_angle_rad.rows());
    for (Eigen::Index column = 0; column < depth_m.cols(); ++column) {
        columnAngles(depth_m.data() + column * (angles + 1), directions.row_sine.data(),
                     directions.row_cosine.data(), angles,
                     range_angle_rad.data() + column * angles);
    }
}

void allCarried(const Image<float>& range_angle_rad, bool to_beam_above,
                Image<float>& pixel_angle_rad) {
    const Eigen::Index angles = range_angle_rad.rows();
    for (Eigen::Index column = 0; column < range_angle_rad.cols(); ++column) {
        const float* from = range_angle_rad.data() + column * angles;
        float* to = pixel_angle_rad.data() + column * (angles + 1);
        to[0] = from[0];
        // The pixels in between have a beam above and a beam below.
        const float *const below = from, *const above = from + 1;
        columnCarried(to_beam_above ? above : below, to_beam_above ? below : above,
                      static_cast<int>(angles) - 1, to + 1);
        to[angles] = from[angles - 1];
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {

HWY_EXPORT(allAngles);
HWY_EXPORT(allCarried);

void rangeAngles(const Image<float>& depth_m, const PixelDirections& directions,
                 Image<float>& range_angle_rad) {
    range_angle_rad.resize(depth_m.rows() - 1, depth_m.cols());
    HWY_DYNAMIC_DISPATCH(allAngles)(depth_m, directions, range_angle_rad);
}

void levelGaps(Image<float>& range_angle_rad) {
    range_angle_rad = range_angle_rad.isNaN().select(0.0f, range_angle_rad);
}

void carryAngles(const Image<float>& range_angle_rad, Image<float>& pixel_angle_rad,
                 bool to_beam_above) {
    pixel_angle_rad.resize(range_angle_rad.rows() + 1, range_angle_rad.cols());
    if (range_angle_rad.rows() == 0) {
        pixel_angle_rad.setConstant(kNoValue);
        return;
    }
    HWY_DYNAMIC_DISPATCH(allCarried)(range_angle_rad, to_beam_above, pixel_angle_rad);
}

}  // namespace hagen
#endif
