#include <hagen/segmentation/FartherReturns.h>

namespace hagen {
namespace {

constexpr float kFarther_m = 0.3f;

}  // namespace

void judgeFartherReturns(const Scan& scan, const RangeImage& image, const Ground& ground,
                         std::vector<Label>& own_label) {
    own_label.assign(scan.size(), Label::Unclassified);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const std::int32_t pixel = image.depth_mapper[i];
        if (pixel == RangeImage::kNoPixel) continue;
        if (!(scan.range_m[i] > image.depth_m.data()[pixel] + kFarther_m)) continue;
        const Eigen::Vector3f point =
            ground.from_sensor * Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        const float height_m = point.z() - ground.surface.at(point.x(), point.y());
        own_label[i] = height_m > ground.tolerance_m.data()[pixel] ? Label::Roi : Label::Rou;
    }
}

}  // namespace hagen
