#include <hagen/range_image/Angle.h>
#include <hagen/segmentation/Labelling.h>
#include <hagen/segmentation/SeedGate.h>
#include <cmath>
#include <vector>

namespace hagen {
namespace {

constexpr float kNoGate_rad = static_cast<float>(radians(90));

/// The lowest pixel of each column, where it carries an angle.
std::vector<int> lowestPixels(const Image<float>& depth_m, const Image<float>& angle_rad) {
    std::vector<int> pixels;
    const int rows = static_cast<int>(depth_m.rows());
    for (int column = 0; column < depth_m.cols(); ++column) {
        for (int row = 0; row < rows; ++row) {
            if (!hasValue(depth_m(row, column))) continue;
            if (hasValue(angle_rad(row, column))) pixels.push_back(column * rows + row);
            break;
        }
    }
    return pixels;
}

/// The highest and the nearest pixel of each column, of those that carry an angle.
std::vector<int> topAndNearestPixels(const Image<float>& depth_m, const Image<float>& angle_rad) {
    std::vector<int> pixels;
    const int rows = static_cast<int>(angle_rad.rows());
    for (int column = 0; column < angle_rad.cols(); ++column) {
        int highest = -1, nearest = -1;
        for (int row = 0; row < rows; ++row) {
            if (!hasValue(angle_rad(row, column))) continue;
            highest = row;
            if (nearest < 0 || depth_m(row, column) < depth_m(nearest, column)) nearest = row;
        }
        if (highest < 0) continue;
        pixels.push_back(column * rows + highest);
        if (nearest != highest) pixels.push_back(column * rows + nearest);
    }
    return pixels;
}

/// Gives `label` to the seeds and to all that can be reached from them.
void growRegions(const Image<float>& angle_rad, float beta_rad, Label label,
                 const std::vector<int>& seeds, Image<Label>& labels) {
    const int rows = static_cast<int>(angle_rad.rows());
    const int columns = static_cast<int>(angle_rad.cols());
    std::vector<int> queue = seeds;
    for (const int seed : seeds) labels.data()[seed] = label;

    for (std::size_t next = 0; next < queue.size(); ++next) {
        const int row = queue[next] % rows, column = queue[next] / rows;
        forEachOf4Neighbours(row, column, rows, columns, [&](int to_row, int to_column) {
            if (labels(to_row, to_column) == label) return;
            const float difference_rad =
                std::abs(angle_rad(to_row, to_column) - angle_rad(row, column));
            if (!(difference_rad < beta_rad)) return;  // too far apart, or no angle
            labels(to_row, to_column) = label;
            queue.push_back(to_column * rows + to_row);
        });
    }
}

}  // namespace

void labelRegions(const Image<float>& depth_m, const Image<float>& pixel_angle_rad, float beta_rad,
                  Seeds seeds, float seed_gate_rad, Image<Label>& labels) {
    const bool from_ground = seeds == Seeds::Lowest;
    const Label grown = from_ground ? Label::Rou : Label::Roi;
    const Label rest = from_ground ? Label::Roi : Label::Rou;
    labels.resize(depth_m.rows(), depth_m.cols());
    for (Eigen::Index pixel = 0; pixel < depth_m.size(); ++pixel) {
        labels.data()[pixel] = !hasValue(depth_m.data()[pixel])           ? Label::Unclassified
                               : !hasValue(pixel_angle_rad.data()[pixel]) ? Label::Roi
                                                                          : rest;
    }
    std::vector<int> pixels = from_ground ? lowestPixels(depth_m, pixel_angle_rad)
                                          : topAndNearestPixels(depth_m, pixel_angle_rad);
    if (from_ground && seed_gate_rad < kNoGate_rad) {
        gateSeeds(depth_m, pixel_angle_rad, seed_gate_rad, pixels);
    }
    growRegions(pixel_angle_rad, beta_rad, grown, pixels, labels);
}

void limitToZone(const Image<float>& depth_m, float zone_m, Image<Label>& labels) {
    labels = (depth_m > zone_m).select(Label::Rou, labels);
}

}  // namespace hagen
