#include <hagen/segmentation/FartherReturns.h>

namespace hagen {
namespace {

constexpr float kFarther_m = 0.3f;

}  // namespace

void judgeFartherReturns(const Scan& scan, const RangeImage& image, const Ground& ground,
                         std::vector<Label>& own_label) {
    own_label.assign(scan.size(), Label::Unclassified);
    if (image.depth_m.size() == 0) return;
    // Kept from scan to scan, so that none is allocated; holds nothing between them.
    thread_local std::vector<std::int32_t> kept_farther;
    if (kept_farther.size() < scan.size() + 1) kept_farther.resize(scan.size() + 1);

    // Few are farther, here and there: they are listed without a branch.
    std::int32_t* const farther = kept_farther.data();
    const std::int32_t* const pixels = image.depth_mapper.data();
    const float* const depth_m = image.depth_m.data();
    const float* const range_m = scan.range_m.data();
    const std::int32_t size = static_cast<std::int32_t>(scan.size());
    std::int32_t n = 0;
    for (std::int32_t i = 0; i < size; ++i) {
        static_assert(RangeImage::kNoPixel == -1);
        const std::int32_t pixel = pixels[i], has_pixel = ~(pixel >> 31);  // 0 or all bits
        const std::int32_t is_farther = range_m[i] > depth_m[pixel & has_pixel] + kFarther_m;
        farther[n] = i;
        n += is_farther & has_pixel;
    }
    for (std::int32_t k = 0; k < n; ++k) {
        const std::int32_t i = farther[k], pixel = pixels[i];
        const Eigen::Vector3f point =
            ground.from_sensor * Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        const float height_m = point.z() - ground.surface.at(point.x(), point.y());
        own_label[i] = height_m > ground.tolerance_m.data()[pixel] ? Label::Roi : Label::Rou;
    }
}

}  // namespace hagen
