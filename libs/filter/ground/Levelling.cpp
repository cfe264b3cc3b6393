#include <hagen/filter/Levelling.h>
#include <Eigen/Geometry>
#include "filter/paper/RangeAngle.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/ground/Levelling.cpp"
#include <hwy/foreach_target.h>  // compiled once per instruction set
#include <hwy/highway.h>

#include "filter/paper/SlopeAngle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

/// Computes one column, which lies in the plane of two unit vectors `outwards` and `upwards` given
/// in the level frame.
void columnLevelAngles(const float* depth_m, const float* sine, const float* cosine,
                       const float* outwards, const float* upwards, int angles, float* angle_rad) {
    coverRows(angles, [=](auto d, int row) HWY_ATTR {
        const auto [out_m, up_m] = stepToBeamAbove(d, depth_m + row, sine + row, cosine + row);
        const auto along = [=, out = out_m, up = up_m](int axis) HWY_ATTR {
            return hn::Add(hn::Mul(out, hn::Set(d, outwards[axis])),
                           hn::Mul(up, hn::Set(d, upwards[axis])));
        };
        const auto dx = along(0), dy = along(1), dz = along(2);
        const auto run_m = hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)));
        hn::StoreU(slopeAngle(d, hn::Abs(dz), run_m), d, angle_rad + row);
    });
}

}  // namespace

void allLevelAngles(const Image<float>& depth_m, const PixelDirections& directions,
                    const float* level, Image<float>& range_angle_rad) {
    const float *forward = level, *left = level + 3, *upwards = level + 6;
    const int angles = static_cast<int>(range_angle_rad.rows());
    for (Eigen::Index column = 0; column < depth_m.cols(); ++column) {
        float outwards[3];
        for (int axis = 0; axis < 3; ++axis) {
            outwards[axis] = directions.column_cosine[column] * forward[axis] +
                             directions.column_sine[column] * left[axis];
        }
        columnLevelAngles(depth_m.data() + column * (angles + 1), directions.row_sine.data(),
                          directions.row_cosine.data(), outwards, upwards, angles,
                          range_angle_rad.data() + column * angles);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {

HWY_EXPORT(allLevelAngles);

Eigen::Matrix3f levelFromSensor(const Attitude& attitude) {
    return (Eigen::AngleAxisf(attitude.pitch_rad, Eigen::Vector3f::UnitY()) *
            Eigen::AngleAxisf(attitude.roll_rad, Eigen::Vector3f::UnitX()))
        .toRotationMatrix();
}

void rangeAngles(const Image<float>& depth_m, const PixelDirections& directions,
                 const std::optional<Attitude>& attitude, Image<float>& range_angle_rad) {
    if (!attitude) return rangeAngles(depth_m, directions, range_angle_rad);
    const Eigen::Matrix3f level = levelFromSensor(*attitude);
    range_angle_rad.resize(depth_m.rows() - 1, depth_m.cols());
    HWY_DYNAMIC_DISPATCH(allLevelAngles)(depth_m, directions, level.data(), range_angle_rad);
}

}  // namespace hagen
#endif
