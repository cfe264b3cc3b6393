#include "filter/RoiBoxes.h"
#include <algorithm>
#include <limits>

namespace hagen {
namespace {

constexpr std::uint32_t kMinDrawn = 30;  // minimum number of returns

}  // namespace

std::vector<RoiBox> boxRoiComponents(const Scan& scan, const LabelledReturns& returns) {
    std::int32_t components = 0;
    for (const std::int32_t component : returns.component) {
        components = std::max(components, component);
    }
    std::vector<RoiBox> boxes;
    for (std::int32_t component = 1; component <= components; ++component) {
        boxes.push_back({component, 0, std::numeric_limits<float>::infinity(), {}});
    }
    for (std::size_t i = 0; i < returns.component.size(); ++i) {
        if (returns.component[i] == 0) continue;
        RoiBox& box = boxes[returns.component[i] - 1];
        ++box.returns;
        box.nearest_m = std::min(box.nearest_m, scan.range_m[i]);
        box.extents_m.extend(Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]));
    }
    return boxes;
}

std::vector<RoiBox> boxesToDraw(const std::vector<RoiBox>& boxes) {
    std::vector<RoiBox> drawn;
    for (const RoiBox& box : boxes) {
        if (box.returns < kMinDrawn) continue;
        const auto holds = [&](const RoiBox& other) {
            return other.extents_m.contains(box.extents_m);
        };
        if (std::any_of(drawn.begin(), drawn.end(), holds)) continue;
        drawn.erase(std::remove_if(drawn.begin(), drawn.end(),
                                   [&](const RoiBox& other) {
                                       return box.extents_m.contains(other.extents_m);
                                   }),
                    drawn.end());
        drawn.push_back(box);
    }
    return drawn;
}

}  // namespace hagen
