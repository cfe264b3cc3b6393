#include <hagen/range_image/Angle.h>
#include <hagen/segmentation/Labelling.h>
#include <hagen/segmentation/SeedGate.h>
#include <cmath>
#include <vector>

namespace hagen {
namespace {

/// A pixel in the queue; its row goes along, for it takes a division to find it again.
struct Pixel {
    int index, row;
};

constexpr float kNoGate_rad = static_cast<float>(radians(90));

/// What is made of one image. Kept from scan to scan, so that none is allocated; holds nothing
/// between them.
struct Workspace {
    std::vector<int> seeds;
    std::vector<Pixel> queue;
};

/// The lowest pixel of each column, where it carries an angle.
void lowestPixels(const Image<float>& depth_m, const Image<float>& angle_rad,
                  std::vector<int>& pixels) {
    pixels.clear();
    const int rows = static_cast<int>(depth_m.rows());
    for (int column = 0; column < depth_m.cols(); ++column) {
        for (int row = 0; row < rows; ++row) {
            if (!hasValue(depth_m(row, column))) continue;
            if (hasValue(angle_rad(row, column))) pixels.push_back(column * rows + row);
            break;
        }
    }
}

/// The highest and the nearest pixel of each column, of those that carry an angle.
void topAndNearestPixels(const Image<float>& depth_m, const Image<float>& angle_rad,
                         std::vector<int>& pixels) {
    pixels.clear();
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
}

/// Gives `label` to the seeds and to all that can be reached from them.
void growRegions(const Image<float>& angle_rad, float beta_rad, Label label,
                 const std::vector<int>& seeds, std::vector<Pixel>& queue, Image<Label>& labels) {
    const int rows = static_cast<int>(angle_rad.rows()), pixels = static_cast<int>(labels.size());
    const float* const angle = angle_rad.data();
    Label* const label_of = labels.data();
    queue.resize(static_cast<std::size_t>(pixels));  // each comes once
    Pixel* const first = queue.data();
    Pixel* end = first;
    for (const int seed : seeds) {
        label_of[seed] = label;
        *end++ = {seed, seed % rows};
    }
    for (const Pixel* next = first; next != end; ++next) {
        const auto [from, row] = *next;
        const float from_rad = angle[from];
        const auto growTo = [&](int to, int to_row) {
            const float difference_rad = std::abs(angle[to] - from_rad);
            // too far apart, or no angle, or there already
            if (!(difference_rad < beta_rad) || label_of[to] == label) return;
            label_of[to] = label;
            *end++ = {to, to_row};
        };
        if (row > 0) growTo(from - 1, row - 1);
        if (row + 1 < rows) growTo(from + 1, row + 1);
        growTo(from >= rows ? from - rows : from - rows + pixels, row);
        growTo(from + rows < pixels ? from + rows : from + rows - pixels, row);
    }
}

/// Labels as they are before regions grow.
void labelUngrown(const Image<float>& depth_m, const Image<float>& angle_rad, Label rest,
                  Image<Label>& labels) {
    labels.resize(depth_m.rows(), depth_m.cols());
    const float *const depth = depth_m.data(), *const angle = angle_rad.data();
    Label* const label = labels.data();
    for (Eigen::Index pixel = 0; pixel < depth_m.size(); ++pixel) {
        const bool is_there = depth[pixel] == depth[pixel];
        const bool has_angle = angle[pixel] == angle[pixel];
        const Label present = has_angle ? rest : Label::Roi;
        label[pixel] = is_there ? present : Label::Unclassified;
    }
}

}  // namespace

void labelRegions(const Image<float>& depth_m, const Image<float>& pixel_angle_rad, float beta_rad,
                  Seeds seeds, float seed_gate_rad, Image<Label>& labels) {
    const bool from_ground = seeds == Seeds::Lowest;
    const Label grown = from_ground ? Label::Rou : Label::Roi;
    const Label rest = from_ground ? Label::Roi : Label::Rou;
    thread_local Workspace workspace;
    Workspace& w = workspace;
    labelUngrown(depth_m, pixel_angle_rad, rest, labels);
    if (from_ground) {
        lowestPixels(depth_m, pixel_angle_rad, w.seeds);
        if (seed_gate_rad < kNoGate_rad)
            gateSeeds(depth_m, pixel_angle_rad, seed_gate_rad, w.seeds);
    } else {
        topAndNearestPixels(depth_m, pixel_angle_rad, w.seeds);
    }
    growRegions(pixel_angle_rad, beta_rad, grown, w.seeds, w.queue, labels);
}

void limitToZone(const Image<float>& depth_m, float zone_m, Image<Label>& labels) {
    const float* const depth = depth_m.data();
    Label* const label = labels.data();
    for (Eigen::Index pixel = 0; pixel < depth_m.size(); ++pixel) {
        label[pixel] = depth[pixel] > zone_m ? Label::Rou : label[pixel];
    }
}

}  // namespace hagen
