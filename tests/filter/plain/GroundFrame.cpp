#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "filter/ground/StageRules.h"
#include "filter/plain/PlainStages.h"

namespace hagen::plain {
namespace {

using namespace frame_rules;

/// Returns the lowest point of each cell that has points, in a level frame.
std::vector<Eigen::Vector3d> lowestOfCells(const PixelPoints& pixels, const Eigen::Matrix3f& level,
                                           const std::vector<std::int32_t>& columns) {
    struct Lowest {
        Eigen::Index pixel = -1;
        float z_m = 0;
    };
    std::vector<Lowest> lowest(kCells * kCells);
    const Eigen::Index rows = pixels.x_m.rows();
    for (const std::int32_t column : columns) {
        for (Eigen::Index pixel = column * rows; pixel < (column + 1) * rows; ++pixel) {
            const auto along = [&, p = pixels.at(pixel)](int axis) {
                return level(axis, 0) * p.x() + level(axis, 1) * p.y() + level(axis, 2) * p.z();
            };
            const auto cells = [&](int axis) { return (along(axis) + kReach_m) * (1 / kCell_m); };
            const float u = cells(0), v = cells(1), z_m = along(2);
            if (!(u >= 0 && v >= 0 && u < kCells && v < kCells)) continue;  // skips NaN (empty) too
            Lowest& low = lowest[static_cast<int>(u) * kCells + static_cast<int>(v)];
            if (low.pixel < 0 || z_m < low.z_m) low = {pixel, z_m};
        }
    }
    std::vector<Eigen::Vector3d> points;
    for (const Lowest& low : lowest) {
        if (low.pixel >= 0) points.push_back((level * pixels.at(low.pixel)).cast<double>());
    }
    return points;
}

/// Fits the plane z = a x + b y + c to the points by weighted least squares.
template <class Weight>
Eigen::Vector3d planeThrough(const std::vector<Eigen::Vector3d>& points, Weight weight) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-9;  // for collinear points
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : points) {
        const Eigen::Vector3d row(p.x(), p.y(), 1);
        const double w = weight(p);
        normal += w * row * row.transpose();
        right += w * p.z() * row;
    }
    return normal.ldlt().solve(right);
}

Eigen::Vector3d fitPlane(const std::vector<Eigen::Vector3d>& points) {
    const auto nearness = [](const Eigen::Vector3d& p) {
        return 1.0 / (1.0 + p.head<2>().squaredNorm() / kRangeScale_m2);
    };
    Eigen::Vector3d plane = planeThrough(points, nearness);
    double scale_m = kFirstScale_m;
    for (int round = 0; round < kRounds; ++round) {
        plane.z() = std::min(plane.z(), 0.0);
        plane = planeThrough(points, [&](const Eigen::Vector3d& p) {
            const double residual_m = p.z() - plane.dot(Eigen::Vector3d(p.x(), p.y(), 1));
            const double step = residual_m / scale_m;
            const double doubt = 1.0 + (residual_m > 0 ? kAbove : kBelow) * step * step;
            return nearness(p) / (doubt * doubt);
        });
        scale_m = std::max(kMinScale_m, scale_m * kScaleStep);
    }
    return plane;
}

}  // namespace

Eigen::Isometry3f fitGroundFrame(const PixelPoints& pixels, const Attitude& attitude,
                                 const std::vector<std::int32_t>& columns) {
    const Eigen::Matrix3f level = levelFromSensor(attitude);
    const std::vector<Eigen::Vector3d> points = lowestOfCells(pixels, level, columns);
    Eigen::Vector3d plane = Eigen::Vector3d::Zero();
    if (points.size() >= 3) {
        plane = fitPlane(points);
    } else if (!points.empty()) {
        plane.z() = std::min(points.front().z(), points.back().z());
    }
    const Eigen::Vector3d normal = Eigen::Vector3d(-plane.x(), -plane.y(), 1).normalized();
    const auto upright = Eigen::Quaterniond::FromTwoVectors(normal, Eigen::Vector3d::UnitZ());
    Eigen::Isometry3f ground_from_sensor = Eigen::Isometry3f::Identity();
    ground_from_sensor.linear() = upright.toRotationMatrix().cast<float>() * level;
    ground_from_sensor.translation().z() = static_cast<float>(-plane.z() * normal.z());
    return ground_from_sensor;
}

}  // namespace hagen::plain
