#include "filter/ground/FartherReturns.h"
#include <cmath>
#include "filter/ground/BlockSums.h"
#include "filter/simd/HeightLabels.h"

namespace hagen {
namespace {

constexpr float kFarther_m = 0.3f;

void reserve(std::size_t size, FartherReturnsWorkspace& work) {
    if (work.index.size() >= size) return;
    work.index.resize(size);
    for (auto* values : {&work.x_m, &work.y_m, &work.z_m, &work.height_m}) values->resize(size);
}

/// Lists the returns in the zone that lie behind the pixel's depth, or in front of it (returns of a
/// window that do not count); returns their number. Branch-free, because these returns are few and
/// scattered.
std::size_t listFarther(const Scan& scan, const RangeImage& image, float zone_m,
                        std::int32_t* list) {
    static_assert(RangeImage::kNoPixel == -1);
    const std::int32_t* const pixels = image.depth_mapper.data();
    const float* const depth_m = image.depth_m.data();
    const float* const range_m = scan.range_m.data();
    const std::int32_t size = static_cast<std::int32_t>(scan.size());
    std::size_t n = 0;
    for (std::int32_t i = 0; i < size; ++i) {
        const std::int32_t pixel = pixels[i], has_pixel = ~(pixel >> 31);  // 0, or all bits set
        const float near_m = depth_m[pixel & has_pixel];
        const std::int32_t is_farther =
            (range_m[i] > near_m + kFarther_m) | (range_m[i] < near_m - kFarther_m);
        const std::int32_t is_in_zone = range_m[i] <= zone_m;
        list[n] = i;
        n += is_farther & is_in_zone & has_pixel;
    }
    return n;
}

/// Transforms the listed returns to the ground frame.
void locate(const Scan& scan, const Eigen::Isometry3f& ground_from_sensor, std::size_t n,
            FartherReturnsWorkspace& work) {
    const Eigen::Matrix3f turn = ground_from_sensor.linear();
    const Eigen::Vector3f shift_m = ground_from_sensor.translation();
    for (std::size_t k = 0; k < n; ++k) {
        const std::int32_t i = work.index[k];
        const float x = scan.x_m[i], y = scan.y_m[i], z = scan.z_m[i];
        work.x_m[k] = turn(0, 0) * x + turn(0, 1) * y + turn(0, 2) * z + shift_m.x();
        work.y_m[k] = turn(1, 0) * x + turn(1, 1) * y + turn(1, 2) * z + shift_m.y();
        work.z_m[k] = turn(2, 0) * x + turn(2, 1) * y + turn(2, 2) * z + shift_m.z();
    }
}

/// Whether the surface at a position is ground; true if evidence is not required.
bool hasEvidence(const std::vector<std::uint8_t>& of_block, float x_m, float y_m) {
    if (of_block.empty()) return true;
    constexpr float kBlock_m = kBlockCells * GroundSurface::kCell_m, kMiddle = 0.5f * kBlocks;
    const float i = std::floor(x_m / kBlock_m + kMiddle);
    const float j = std::floor(y_m / kBlock_m + kMiddle);
    const bool is_on_grid = i >= 0 && i < kBlocks && j >= 0 && j < kBlocks;
    return is_on_grid && of_block[static_cast<std::size_t>(j * kBlocks + i)] != 0;
}

}  // namespace

void judgeFartherReturns(const Scan& scan, const RangeImage& image, const Ground& ground,
                         const Clearance& clearance, float zone_m, OwnLabels& own_labels,
                         FartherReturnsWorkspace& work) {
    std::vector<Label>& own_label = own_labels.label;
    own_label.assign(ground.has_surface ? scan.size() : 0, Label::Unclassified);
    own_labels.returns.clear();
    if (own_label.empty() || image.depth_m.size() == 0) return;
    reserve(scan.size() + 1, work);
    std::int32_t* const list = work.index.data();
    const std::size_t n = listFarther(scan, image, zone_m, list);
    own_labels.returns.assign(list, list + n);
    locate(scan, ground.from_sensor, n, work);
    heightsAbove(ground.surface, n, work.x_m.data(), work.y_m.data(), work.z_m.data(),
                 work.height_m.data());
    const bool needs_clearance = clearance.min_m > 0;
    for (std::size_t k = 0; k < n; ++k) {
        const float tolerance_m = ground.tolerance_m.data()[image.depth_mapper[list[k]]];
        const bool is_high = work.height_m[k] > tolerance_m;
        const bool is_ground = work.height_m[k] >= kMinGround_m &&
                               hasEvidence(ground.has_evidence, work.x_m[k], work.y_m[k]);
        const bool is_close =
            needs_clearance &&
            clearance.isViolatedBy(ground, {work.x_m[k], work.y_m[k], work.z_m[k]});
        own_label[list[k]] = is_high || !is_ground || is_close ? Label::Roi : Label::Rou;
    }
}

}  // namespace hagen
