#include <hagen/segmentation/Clearance.h>

namespace hagen {

void alarmLowGround(const PixelPoints& pixels, const Eigen::Vector3f& sensor_m,
                    const Eigen::Vector3f& up, float least_clearance_m, Image<Label>& labels) {
    if (least_clearance_m <= 0) return;
    for (Eigen::Index pixel = 0; pixel < labels.size(); ++pixel) {
        if (labels.data()[pixel] != Label::Rou) continue;
        const float clearance_m = up.dot(sensor_m - pixels.at(pixel));
        if (clearance_m < least_clearance_m) labels.data()[pixel] = Label::Roi;
    }
}

}  // namespace hagen
