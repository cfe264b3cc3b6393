#include "filter/simd/GroundFrame.h"
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/simd/GroundFrame.cpp"
#include <hwy/foreach_target.h>
#include "filter/simd/GroundGrid-inl.h"

#ifndef HAGEN_GROUND_FRAME
#define HAGEN_GROUND_FRAME
namespace hagen {
namespace {

using namespace frame_rules;
using Points = GroundFrameWorkspace::Points;

/// Sums over points are split into this many parts on every machine, so points are padded.
constexpr std::size_t kParts = 4;
std::size_t paddedSize(std::size_t points) { return (points + kParts - 1) / kParts * kParts; }

/// Weight as a function of the residual from the plane z = a x + b y + c.
struct RobustWeight {
    double a = 0, b = 0, c = 0;
    double above_per_m2 = 0, below_per_m2 = 0;
};

/// The partial sums of w, w x, w y, w x x, w x y, w y y, w z, w x z, w y z.
constexpr int kSums = 9;
using PartialSums = double[kSums][kParts];

}  // namespace
}  // namespace hagen
#endif

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

/// Computes the cell and height of each pixel in a level frame, as integers; which preserve the
/// order of heights. Pixels outside the grid or higher than `max_m` get the cell kCells * kCells.
void LevelPixelsIn(std::size_t pixels, const float* HWY_RESTRICT x_m, const float* HWY_RESTRICT y_m,
                   const float* HWY_RESTRICT z_m, const Eigen::Matrix3f& level, float max_m,
                   std::int32_t* HWY_RESTRICT cell, std::int32_t* HWY_RESTRICT height) {
    forEachVector(pixels, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const auto x = hn::LoadU(d, x_m + pixel), y = hn::LoadU(d, y_m + pixel);
        const auto z = hn::LoadU(d, z_m + pixel);
        const auto along = [&](int row) HAGEN_INLINE {
            return hn::Add(hn::Add(hn::Mul(hn::Set(d, level(row, 0)), x),
                                   hn::Mul(hn::Set(d, level(row, 1)), y)),
                           hn::Mul(hn::Set(d, level(row, 2)), z));
        };
        const auto cells = [&](int row) HAGEN_INLINE {
            return hn::Mul(hn::Add(along(row), hn::Set(d, kReach_m)), hn::Set(d, 1 / kCell_m));
        };
        const auto u = cells(0), v = cells(1), end = hn::Set(d, kCells), zero = hn::Zero(d);
        const auto up = along(2);
        const auto is_within = hn::And(hn::And(hn::And(hn::Ge(u, zero), hn::Lt(u, end)),
                                               hn::And(hn::Ge(v, zero), hn::Lt(v, end))),
                                       hn::Le(up, hn::Set(d, max_m)));
        const auto whole = [&](auto value) HAGEN_INLINE {
            return hn::ConvertTo(di, hn::IfThenElseZero(is_within, value));
        };
        const auto j = hn::Mul(hn::ConvertTo(d, whole(u)), end);
        const auto place = hn::Add(hn::ConvertTo(di, j), whole(v));
        hn::StoreU(
            hn::IfThenElse(hn::RebindMask(di, is_within), place, hn::Set(di, kCells * kCells)), di,
            cell + pixel);
        const auto bits = hn::BitCast(di, up);
        const auto magnitude = hn::And(hn::ShiftRight<31>(bits), hn::Set(di, 0x7fffffff));
        hn::StoreU(hn::Xor(bits, magnitude), di, height + pixel);
    });
}

void SumUpIn(const Points& points, const RobustWeight& weight, PartialSums& sums) {
    const hn::CappedTag<double, kParts> d;
    using V = hn::Vec<decltype(d)>;
    const V one = hn::Set(d, 1.0), a = hn::Set(d, weight.a), b = hn::Set(d, weight.b);
    const V c = hn::Set(d, weight.c);
    const V above_per_m2 = hn::Set(d, weight.above_per_m2);
    const V below_per_m2 = hn::Set(d, weight.below_per_m2);
    const std::size_t size = paddedSize(points.size);
    for (std::size_t part = 0; part < kParts; part += hn::Lanes(d)) {
        V w_ = hn::Zero(d), wx = w_, wy = w_, wxx = w_, wxy = w_, wyy = w_, wz = w_, wxz = w_,
          wyz = w_;
        for (std::size_t k = part; k < size; k += kParts) {
            const V x = hn::LoadU(d, points.x_m.data() + k),
                    y = hn::LoadU(d, points.y_m.data() + k);
            const V z = hn::LoadU(d, points.z_m.data() + k);
            const V residual_m = hn::Sub(z, hn::Add(hn::Add(hn::Mul(a, x), hn::Mul(b, y)), c));
            const V per_m2 =
                hn::IfThenElse(hn::Gt(residual_m, hn::Zero(d)), above_per_m2, below_per_m2);
            const V doubt = hn::Add(one, hn::Mul(per_m2, hn::Mul(residual_m, residual_m)));
            const V w = hn::Div(hn::LoadU(d, points.nearness.data() + k), hn::Mul(doubt, doubt));
            const V x_w = hn::Mul(w, x), y_w = hn::Mul(w, y);
            w_ = hn::Add(w_, w);
            wx = hn::Add(wx, x_w);
            wy = hn::Add(wy, y_w);
            wxx = hn::Add(wxx, hn::Mul(x_w, x));
            wxy = hn::Add(wxy, hn::Mul(x_w, y));
            wyy = hn::Add(wyy, hn::Mul(y_w, y));
            wz = hn::Add(wz, hn::Mul(w, z));
            wxz = hn::Add(wxz, hn::Mul(x_w, z));
            wyz = hn::Add(wyz, hn::Mul(y_w, z));
        }
        const V all[kSums] = {w_, wx, wy, wxx, wxy, wyy, wz, wxz, wyz};
        for (int k = 0; k < kSums; ++k) hn::StoreU(all[k], d, sums[k] + part);
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "filter/SampleColumns.h"

namespace hagen {
namespace {

HWY_EXPORT(LevelPixelsIn);
HWY_EXPORT(SumUpIn);

void resize(std::size_t size, Points& points) {
    const std::size_t padded = paddedSize(size);
    points.size = size;
    for (auto* values : {&points.x_m, &points.y_m, &points.z_m, &points.nearness}) {
        values->resize(std::max(values->size(), padded));
        std::fill(values->begin() + size, values->begin() + padded, 0.0);
    }
}

void weighByDistance(Points& points) {
    for (std::size_t k = 0; k < points.size; ++k) {
        const double x_m = points.x_m[k], y_m = points.y_m[k];
        points.nearness[k] = 1 / (1 + (x_m * x_m + y_m * y_m) / kRangeScale_m2);
    }
}

/// Finds the lowest point of each cell that has points, in work.points.
void findLowestOfCells(const PixelPoints& pixels, const Eigen::Matrix3f& level,
                       const std::vector<std::int32_t>& columns, float max_m,
                       GroundFrameWorkspace& work) {
    const Eigen::Index rows = pixels.x_m.rows();
    const std::size_t size = columns.size() * static_cast<std::size_t>(rows);
    work.cell.resize(std::max(work.cell.size(), size));
    work.height.resize(std::max(work.height.size(), size));
    std::int32_t *const cell = work.cell.data(), *const height = work.height.data();
    Eigen::Index n_level = 0;
    for (const std::int32_t column : columns) {
        const Eigen::Index first = column * rows;
        HWY_DYNAMIC_DISPATCH(LevelPixelsIn)
        (static_cast<std::size_t>(rows), pixels.x_m.data() + first, pixels.y_m.data() + first,
         pixels.z_m.data() + first, level, max_m, cell + n_level, height + n_level);
        n_level += rows;
    }

    // Keys contain the height, then the pixel index, so the minimum is the first of the lowest
    // pixels.
    constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();
    work.lowest.assign(kCells * kCells + 1, kNone);
    work.occupied.resize(kCells * kCells + 1);
    std::int64_t* const lowest = work.lowest.data();
    std::int32_t* const occupied = work.occupied.data();
    std::size_t n = 0;
    visitByTurns(
        size, [&, cell, height, lowest, occupied ](std::size_t k) __attribute__((always_inline)) {
            const std::int64_t own =
                std::int64_t{height[k]} * (std::int64_t{1} << 32) + static_cast<std::int64_t>(k);
            std::int64_t& low = lowest[cell[k]];
            occupied[n] = cell[k];
            n += (low == kNone) & (cell[k] != kCells * kCells);
            low = std::min(low, own);
        });
    Points& points = work.points;
    resize(n, points);
    for (std::size_t k = 0; k < n; ++k) {
        const Eigen::Index listed = lowest[occupied[k]] & 0xffffffff;
        const Eigen::Index pixel = columns[listed / rows] * rows + listed % rows;
        const Eigen::Vector3d point_m = (level * pixels.at(pixel)).cast<double>();
        points.x_m[k] = point_m.x();
        points.y_m[k] = point_m.y();
        points.z_m[k] = point_m.z();
    }
    weighByDistance(points);
}

/// Fits the plane z = a x + b y + c to the points by weighted least squares.
Eigen::Vector3d planeThrough(const Points& points, const RobustWeight& weight) {
    PartialSums parts;
    HWY_DYNAMIC_DISPATCH(SumUpIn)(points, weight, parts);
    double sum[kSums];
    for (int k = 0; k < kSums; ++k)
        sum[k] = (parts[k][0] + parts[k][1]) + (parts[k][2] + parts[k][3]);
    const auto& [w, wx, wy, wxx, wxy, wyy, wz, wxz, wyz] = sum;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-9;  // for collinear points
    normal += (Eigen::Matrix3d() << wxx, wxy, wx, wxy, wyy, wy, wx, wy, w).finished();
    return normal.ldlt().solve(Eigen::Vector3d(wxz, wyz, wz));
}

Eigen::Vector3d fitPlane(const Points& points) {
    Eigen::Vector3d plane = planeThrough(points, RobustWeight{});
    double scale_m = kFirstScale_m;
    for (int round = 0; round < kRounds; ++round) {
        plane.z() = std::min(plane.z(), 0.0);  // even if most cells are above the sensor
        const double per_m2 = 1 / (scale_m * scale_m);
        plane = planeThrough(points,
                             {plane.x(), plane.y(), plane.z(), kAbove * per_m2, kBelow * per_m2});
        scale_m = std::max(kMinScale_m, scale_m * kScaleStep);
    }
    return plane;
}

/// The shortest rotation that turns a vector upwards, unless it points straight down. Equals
/// Eigen's FromTwoVectors, whose decomposition for opposite vectors is slow to compile.
Eigen::Quaterniond turnUpwards(const Eigen::Vector3d& vector) {
    const Eigen::Vector3d from = vector.normalized(), up = Eigen::Vector3d::UnitZ();
    const double s = std::sqrt((1 + up.dot(from)) * 2);
    Eigen::Quaterniond turn;
    turn.vec() = from.cross(up) * (1 / s);
    turn.w() = s * 0.5;
    return turn;
}

/// The ground frame for the plane z = a x + b y + c in the level frame.
Eigen::Isometry3f groundFrame(const Eigen::Vector3d& plane, const Eigen::Matrix3f& level) {
    const Eigen::Vector3d normal = Eigen::Vector3d(-plane.x(), -plane.y(), 1).normalized();
    Eigen::Isometry3f ground_from_sensor = Eigen::Isometry3f::Identity();
    ground_from_sensor.linear() = turnUpwards(normal).toRotationMatrix().cast<float>() * level;
    ground_from_sensor.translation().z() = static_cast<float>(-plane.z() * normal.z());
    return ground_from_sensor;
}

}  // namespace

Eigen::Isometry3f fitGroundFrame(const PixelPoints& pixels, const Attitude& attitude,
                                 GroundFrameWorkspace& work,
                                 const std::vector<std::int32_t>* columns, float max_m) {
    const Eigen::Matrix3f level = levelFromSensor(attitude);
    if (columns == nullptr) {
        sampleColumns(pixels.x_m.cols(), kEnoughColumns, work.columns);
        columns = &work.columns;
    }
    findLowestOfCells(pixels, level, *columns, max_m, work);
    const Points& points = work.points;

    Eigen::Vector3d plane = Eigen::Vector3d::Zero();
    if (points.size >= 3) {
        plane = fitPlane(points);
    } else if (points.size > 0) {
        plane.z() = std::min(points.z_m.front(), points.z_m[points.size - 1]);
    }
    return groundFrame(plane, level);
}

}  // namespace hagen
#endif
