// Slopes of many pixels at a time, for RangeAngle.cpp and Levelling.cpp; compiled once per
// instruction set.
#if defined(HAGEN_SLOPE_ANGLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HAGEN_SLOPE_ANGLE_INL_H
#undef HAGEN_SLOPE_ANGLE_INL_H
#else
#define HAGEN_SLOPE_ANGLE_INL_H
#endif

#include <hwy/highway.h>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Branch-free atan2(rise, run) of non-negative numbers; 0 if both are 0, NaN if both are NaN. Uses
/// the minimax polynomial (Remez) for the arctangent in [0, 1]; maximum error 2.5e-7 rad.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V slopeAngle(D d, V rise, V run) {
    const V tiny = hn::Set(d, std::numeric_limits<float>::min());
    const V t = hn::Div(hn::Min(rise, run), hn::Max(hn::Max(rise, run), tiny));
    const V t2 = hn::Mul(t, t);
    V sum = hn::Set(d, 0.006811797663f);
    for (const float coefficient : {-0.03360423382f, 0.0796236875f, -0.132333429f, 0.1980781577f,
                                    -0.3331736808f, 0.9999961116f}) {
        sum = hn::Add(hn::Mul(sum, t2), hn::Set(d, coefficient));
    }
    const V angle = hn::Mul(sum, t);
    const auto is_steep = hn::Gt(rise, run);
    return hn::IfThenElse(is_steep, hn::Sub(hn::Set(d, 1.57079632679f), angle), angle);
}

/// The vector from a return to the return of the beam above it: outwards and upwards from the
/// sensor.
template <class V>
struct Step {
    V out_m, up_m;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE Step<V> stepToBeamAbove(D d, const float* depth_m, const float* sine,
                                   const float* cosine) {
    const V below = hn::LoadU(d, depth_m), above = hn::LoadU(d, depth_m + 1);
    return {hn::Sub(hn::Mul(above, hn::LoadU(d, cosine + 1)), hn::Mul(below, hn::LoadU(d, cosine))),
            hn::Sub(hn::Mul(above, hn::LoadU(d, sine + 1)), hn::Mul(below, hn::LoadU(d, sine)))};
}

/// Calls visit(d, row) so that vectors with tag d starting at these rows cover [0, rows). The last
/// vector may overlap the previous one, so a row's result must depend only on its inputs.
template <class Visit>
HWY_INLINE void coverRows(int rows, const Visit& visit) {
    const hn::CappedTag<float, 8> d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    if (rows < lanes) {
        for (int row = 0; row < rows; ++row) visit(hn::CappedTag<float, 1>(), row);
        return;
    }
    for (int row = 0; row + lanes <= rows; row += lanes) visit(d, row);
    if (rows % lanes != 0) visit(d, rows - lanes);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#endif
