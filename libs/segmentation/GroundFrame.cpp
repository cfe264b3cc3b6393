#include <hagen/segmentation/GroundFrame.h>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace hagen {
namespace {

constexpr float kCell_m = 0.75f;
constexpr float kReach_m = 40.0f;
constexpr int kCells = 107;  // 2 kReach_m / kCell_m, rounded up

constexpr int kRounds = 6;
constexpr double kFirstScale_m = 1.0;  // of residuals, in the first round
constexpr double kScaleStep = 0.8;
constexpr double kLeastScale_m = 0.3;
constexpr double kAbove = 2.0, kBelow = 1.0;  // what is above the ground counts less, sooner
constexpr double kRangeScale_m2 = 400.0;      // 20 m, squared

// What can be ground.
constexpr float kLeastHeight_m = 0.1f;   // of the sensor above it
constexpr float kLeastCosine = 0.7071f;  // of the tilt against it, 45 degrees
constexpr Eigen::Index kLeastPixels = 50;

/// The lowest point of each cell that has one.
std::vector<Eigen::Vector3d> lowestOfCells(const PixelPoints& pixels,
                                           const Eigen::Matrix3f& rotation) {
    std::vector<Eigen::Vector3f> lowest(kCells * kCells, Eigen::Vector3f::Constant(kNoValue));
    for (Eigen::Index pixel = 0; pixel < pixels.x_m.size(); ++pixel) {
        if (!hasValue(pixels.x_m.data()[pixel])) continue;
        const Eigen::Vector3f point = rotation * pixels.at(pixel);
        const float u = (point.x() + kReach_m) / kCell_m, v = (point.y() + kReach_m) / kCell_m;
        if (!(u >= 0 && v >= 0 && u < kCells && v < kCells)) continue;
        Eigen::Vector3f& low = lowest[static_cast<int>(u) * kCells + static_cast<int>(v)];
        if (!(low.z() <= point.z())) low = point;
    }
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector3f& point : lowest) {
        if (hasValue(point.z())) points.push_back(point.cast<double>());
    }
    return points;
}

/// The plane z = a x + b y + c through the points, by weighted least squares.
template <class Weight>
Eigen::Vector3d planeThrough(const std::vector<Eigen::Vector3d>& points, Weight weight) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-9;  // points on a line are no error
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
        plane = planeThrough(points, [&](const Eigen::Vector3d& p) {
            const double residual_m = p.z() - plane.dot(Eigen::Vector3d(p.x(), p.y(), 1));
            const double step = residual_m / scale_m;
            const double doubt = 1.0 + (residual_m > 0 ? kAbove : kBelow) * step * step;
            return nearness(p) / (doubt * doubt);
        });
        scale_m = std::max(kLeastScale_m, scale_m * kScaleStep);
    }
    return plane;
}

}  // namespace

Eigen::Isometry3f fitGroundFrame(const PixelPoints& pixels, const Attitude& attitude) {
    const Eigen::Matrix3f level = levelFromSensor(attitude);
    const std::vector<Eigen::Vector3d> points = lowestOfCells(pixels, level);

    Eigen::Vector3d plane = Eigen::Vector3d::Zero();
    if (points.size() >= 3) {
        plane = fitPlane(points);
    } else if (!points.empty()) {
        plane.z() = std::min(points.front().z(), points.back().z());
    }
    const Eigen::Vector3d normal = Eigen::Vector3d(-plane.x(), -plane.y(), 1).normalized();
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(normal, Eigen::Vector3d::UnitZ());

    Eigen::Isometry3f ground_from_sensor = Eigen::Isometry3f::Identity();
    ground_from_sensor.linear() = turn.toRotationMatrix().cast<float>() * level;
    ground_from_sensor.translation().z() = static_cast<float>(-plane.z() * normal.z());
    return ground_from_sensor;
}

bool canBeGround(const Eigen::Isometry3f& ground_from_sensor,
                 const std::optional<Attitude>& attitude, const Image<Label>& labels) {
    const float sensor_height_m = ground_from_sensor.translation().z();
    const float cosine_of_tilt = upwards(ground_from_sensor, attitude.value_or(Attitude{})).z();
    return sensor_height_m > kLeastHeight_m && cosine_of_tilt > kLeastCosine &&
           (labels == Label::Rou).count() >= kLeastPixels;
}

Eigen::Vector3f upwards(const Eigen::Isometry3f& ground_from_sensor,
                        const std::optional<Attitude>& attitude) {
    if (!attitude) return Eigen::Vector3f::UnitZ();
    return ground_from_sensor.linear() * levelFromSensor(*attitude).transpose() *
           Eigen::Vector3f::UnitZ();
}

}  // namespace hagen
