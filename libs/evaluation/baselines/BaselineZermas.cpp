#include "evaluation/baselines/BaselineZermas.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

namespace hagen::evaluation {
namespace {

using Indices = std::vector<std::int32_t>;

Eigen::Vector3f point(const Scan& scan, std::int32_t i) {
    return {scan.x_m[i], scan.y_m[i], scan.z_m[i]};
}

void requirePositive(int value, const char* name) {
    if (value < 1) {
        throw std::invalid_argument(std::string("zermas: ") + name + " is " +
                                    std::to_string(value) + "; it must be at least 1");
    }
}

/// A plane: its points satisfy normal . p = offset_m; the normal points upwards.
struct Plane {
    Eigen::Vector3f normal;
    float offset_m;
    float heightOf(const Eigen::Vector3f& p) const { return normal.dot(p) - offset_m; }
};

/// EstimatePlane: through the mean of the points, normal to the direction of least spread.
std::optional<Plane> estimatePlane(const Scan& scan, const Indices& points) {
    if (points.size() < 3) return std::nullopt;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const std::int32_t i : points) mean += point(scan, i).cast<double>();
    mean /= static_cast<double>(points.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const std::int32_t i : points) {
        const Eigen::Vector3d from_mean = point(scan, i).cast<double>() - mean;
        covariance += from_mean * from_mean.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(covariance);
    if (spread.eigenvalues()[1] < 1e-9 * spread.eigenvalues()[2]) return std::nullopt;  // a line
    Eigen::Vector3d normal = spread.eigenvectors().col(0);
    if (normal.z() < 0.0) normal = -normal;
    return Plane{normal.cast<float>(), static_cast<float>(normal.dot(mean))};
}

/// Whether a return is used at all.
bool isInZone(const Scan& scan, const SensorModel& sensor, std::size_t i, float zone_m) {
    return sensor.sees(scan.range_m[i]) && scan.range_m[i] <= zone_m;
}

/// The returns in the zone, in stretches of equal length along the x axis, rearmost first.
std::vector<Indices> alongX(const Scan& scan, const SensorModel& sensor,
                            const ZermasOptions& options) {
    Indices in_zone;
    float min_m = std::numeric_limits<float>::infinity(), max_m = -min_m;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (!isInZone(scan, sensor, i, options.zone_m)) continue;
        in_zone.push_back(static_cast<std::int32_t>(i));
        min_m = std::min(min_m, scan.x_m[i]);
        max_m = std::max(max_m, scan.x_m[i]);
    }
    std::vector<Indices> stretches(options.segments);
    for (const std::int32_t i : in_zone) {
        const float share = max_m > min_m ? (scan.x_m[i] - min_m) / (max_m - min_m) : 0.0f;
        const int stretch = static_cast<int>(share * static_cast<float>(options.segments));
        stretches[std::min(stretch, options.segments - 1)].push_back(
            i);  // the foremost return belongs to the last stretch
    }
    return stretches;
}

/// ExtractInitialSeeds of algorithm 1.
Indices initialSeeds(const Scan& scan, const Indices& points, const ZermasOptions& options) {
    Indices seeds;
    if (points.empty()) return seeds;
    std::vector<float> heights_m;
    for (const std::int32_t i : points) heights_m.push_back(scan.z_m[i]);
    const auto lowest = static_cast<std::ptrdiff_t>(
        std::min(heights_m.size(), static_cast<std::size_t>(options.lowest_points)));
    const auto lowest_end = heights_m.begin() + lowest;
    std::partial_sort(heights_m.begin(), lowest_end, heights_m.end());
    const float representative_m =
        std::accumulate(heights_m.begin(), lowest_end, 0.0f) / static_cast<float>(lowest);
    for (const std::int32_t i : points) {
        if (scan.z_m[i] < representative_m + options.seed_height_m) seeds.push_back(i);
    }
    return seeds;
}

}  // namespace

std::vector<Label> zermasGroundFit(const Scan& scan, const SensorModel& sensor,
                                   const ZermasOptions& options) {
    requirePositive(options.segments, "segments");
    requirePositive(options.iterations, "iterations");
    requirePositive(options.lowest_points, "lowest_points");
    std::vector<Label> labels(scan.size(), Label::Unclassified);
    for (const Indices& stretch : alongX(scan, sensor, options)) {
        Indices ground = initialSeeds(scan, stretch, options);
        for (int iteration = 0; iteration < options.iterations; ++iteration) {
            const std::optional<Plane> plane = estimatePlane(scan, ground);
            ground.clear();
            if (!plane) break;
            for (const std::int32_t i : stretch) {
                // The height is signed: points below the plane are ground, too.
                if (plane->heightOf(point(scan, i)) < options.ground_distance_m) {
                    ground.push_back(i);
                }
            }
        }
        for (const std::int32_t i : stretch) labels[i] = Label::Roi;
        for (const std::int32_t i : ground) labels[i] = Label::Rou;
    }
    return labels;
}

std::vector<Label> zermasLabels(const Scan& scan, const SensorModel& sensor,
                                const ZermasOptions& options) {
    std::vector<Label> labels = zermasGroundFit(scan, sensor, options);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const bool is_far = sensor.sees(scan.range_m[i]) && scan.range_m[i] > options.zone_m;
        if (is_far) labels[i] = Label::Rou;
    }
    return labels;
}

}  // namespace hagen::evaluation
