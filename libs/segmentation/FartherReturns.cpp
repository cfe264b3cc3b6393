#include <hagen/segmentation/FartherReturns.h>

namespace hagen {
namespace {

constexpr float kFarther_m = 0.3f;

/// The returns to judge, in the ground's frame.
struct Farther {
    std::vector<std::int32_t> index;  ///< in the scan
    std::vector<float> x_m, y_m, z_m, height_m;

    void reserve(std::size_t size) {
        if (index.size() >= size) return;
        index.resize(size);
        for (auto* values : {&x_m, &y_m, &z_m, &height_m}) values->resize(size);
    }
};

}  // namespace

void judgeFartherReturns(const Scan& scan, const RangeImage& image, const Ground& ground,
                         std::vector<Label>& own_label) {
    own_label.assign(scan.size(), Label::Unclassified);
    if (image.depth_m.size() == 0) return;
    // Kept from scan to scan, so that none is allocated; holds nothing between them.
    thread_local Farther kept_farther;
    Farther& farther = kept_farther;
    farther.reserve(scan.size() + 1);

    // Few are farther, here and there: they are listed without a branch.
    const std::int32_t* const pixels = image.depth_mapper.data();
    const float* const depth_m = image.depth_m.data();
    const float* const range_m = scan.range_m.data();
    std::int32_t* const list = farther.index.data();
    const std::int32_t size = static_cast<std::int32_t>(scan.size());
    std::size_t n = 0;
    for (std::int32_t i = 0; i < size; ++i) {
        static_assert(RangeImage::kNoPixel == -1);
        const std::int32_t pixel = pixels[i], has_pixel = ~(pixel >> 31);  // 0 or all bits
        const std::int32_t is_farther = range_m[i] > depth_m[pixel & has_pixel] + kFarther_m;
        list[n] = i;
        n += is_farther & has_pixel;
    }
    for (std::size_t k = 0; k < n; ++k) {
        const std::int32_t i = list[k];
        const Eigen::Vector3f point =
            ground.from_sensor * Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        farther.x_m[k] = point.x();
        farther.y_m[k] = point.y();
        farther.z_m[k] = point.z();
    }
    heightsAbove(ground.surface, n, farther.x_m.data(), farther.y_m.data(), farther.z_m.data(),
                 farther.height_m.data());
    for (std::size_t k = 0; k < n; ++k) {
        const float tolerance_m = ground.tolerance_m.data()[pixels[list[k]]];
        own_label[list[k]] = farther.height_m[k] > tolerance_m ? Label::Roi : Label::Rou;
    }
}

}  // namespace hagen
