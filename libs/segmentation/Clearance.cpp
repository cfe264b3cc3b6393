#include <hagen/segmentation/Clearance.h>
#include <hagen/segmentation/GroundFrame.h>

namespace hagen {
namespace {

float clearance_m(const Ground& ground, const Eigen::Vector3f& up, const Eigen::Vector3f& point) {
    return up.dot(ground.from_sensor.translation() - point);
}

}  // namespace

Eigen::Vector3f upwards(const Ground& ground, const std::optional<Attitude>& attitude) {
    const bool knows_neither = !attitude && !ground.is_seen;
    return upwards(ground.from_sensor, knows_neither ? Attitude{} : attitude);
}

void alarmLowGround(const Ground& ground, const Eigen::Vector3f& up, float least_clearance_m,
                    Image<Label>& labels) {
    if (least_clearance_m <= 0) return;
    for (Eigen::Index pixel = 0; pixel < labels.size(); ++pixel) {
        if (labels.data()[pixel] == Label::Rou &&
            clearance_m(ground, up, ground.pixels.at(pixel)) < least_clearance_m) {
            labels.data()[pixel] = Label::Roi;
        }
    }
}

void alarmLowGround(const Scan& scan, const Ground& ground, const Eigen::Vector3f& up,
                    float least_clearance_m, std::vector<Label>& own_label) {
    if (least_clearance_m <= 0) return;
    for (std::size_t i = 0; i < own_label.size(); ++i) {
        if (own_label[i] != Label::Rou) continue;
        const Eigen::Vector3f point(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        if (clearance_m(ground, up, ground.from_sensor * point) < least_clearance_m) {
            own_label[i] = Label::Roi;
        }
    }
}

}  // namespace hagen
