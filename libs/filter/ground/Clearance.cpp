#include "filter/ground/Clearance.h"
#include "filter/simd/GroundFrame.h"

namespace hagen {
Eigen::Vector3f upwards(const Ground& ground, const std::optional<Attitude>& attitude) {
    const bool knows_neither = !attitude && !ground.is_seen;
    return upwards(ground.from_sensor, knows_neither ? Attitude{} : attitude);
}

void alarmLowGround(const Ground& ground, const Clearance& clearance, Image<Label>& labels) {
    if (clearance.min_m <= 0) return;
    for (Eigen::Index pixel = 0; pixel < labels.size(); ++pixel) {
        if (labels.data()[pixel] == Label::Rou &&
            clearance.isViolatedBy(ground, ground.pixels.at(pixel))) {
            labels.data()[pixel] = Label::Roi;
        }
    }
}

}  // namespace hagen
