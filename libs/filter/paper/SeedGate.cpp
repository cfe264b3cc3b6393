#include "filter/paper/SeedGate.h"
#include <algorithm>

namespace hagen {

void gateSeeds(const Image<float>& depth_m, const Image<float>& pixel_angle_rad, float gate_rad,
               std::vector<int>& seeds) {
    const int rows = static_cast<int>(depth_m.rows());
    const auto cannotBeGround = [&](int pixel) {
        if (!(pixel_angle_rad.data()[pixel] < gate_rad)) return true;
        const int end = (pixel / rows + 1) * rows;
        for (int above = pixel + 1; above < end; ++above) {
            if (hasValue(depth_m.data()[above])) {
                return !(depth_m.data()[above] > depth_m.data()[pixel]);
            }
        }
        return true;
    };
    seeds.erase(std::remove_if(seeds.begin(), seeds.end(), cannotBeGround), seeds.end());
}

}  // namespace hagen
