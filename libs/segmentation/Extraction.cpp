#include <hagen/segmentation/Extraction.h>
#include <algorithm>

namespace hagen {
namespace {

/// Numbers components 1, 2, ... in their order, without those that no return is in: they are of
/// repaired pixels alone.
void renumber(std::vector<std::int32_t>& component) {
    const auto most = std::max_element(component.begin(), component.end());
    if (most == component.end()) return;
    std::vector<std::int32_t> number(static_cast<std::size_t>(*most) + 1, 0);
    for (const std::int32_t c : component) number[c] = c > 0;
    for (std::size_t c = 1; c < number.size(); ++c) number[c] += number[c - 1];
    for (std::int32_t& c : component) c = c > 0 ? number[c] : 0;
}

}  // namespace

void extractReturns(const Scan& scan, const SensorModel& sensor, const RangeImage& image,
                    const Image<Label>& labels, const Image<std::int32_t>& components,
                    const std::vector<Label>& own_label, float zone_m, float component_gap_m,
                    LabelledReturns& returns) {
    returns.label.resize(scan.size());
    returns.component.assign(scan.size(), 0);
    for (auto* indices : {&returns.roi, &returns.rou, &returns.unclassified}) indices->clear();

    for (std::size_t i = 0; i < scan.size(); ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        const std::int32_t pixel = image.depth_mapper[i];
        const bool is_far = scan.range_m[i] > zone_m || pixel == RangeImage::kNoPixel;
        const Label own = own_label.empty() ? Label::Unclassified : own_label[i];
        const Label label = is_far                       ? Label::Rou
                            : own != Label::Unclassified ? own
                                                         : labels.data()[pixel];
        if (!sensor.sees(scan.range_m[i])) {
            returns.label[i] = Label::Unclassified;
            returns.unclassified.push_back(index);
        } else if (label == Label::Rou) {
            returns.label[i] = Label::Rou;
            returns.rou.push_back(index);
        } else {
            returns.label[i] = Label::Roi;
            const bool is_apart =
                own != Label::Unclassified &&
                !(scan.range_m[i] - image.depth_m.data()[pixel] < component_gap_m);
            returns.component[i] = is_apart ? 0 : components.data()[pixel];
            returns.roi.push_back(index);
        }
    }
    renumber(returns.component);
}

}  // namespace hagen
