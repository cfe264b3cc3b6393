#include <hagen/segmentation/Extraction.h>

namespace hagen {

void extractReturns(const Scan& scan, const SensorModel& sensor, const RangeImage& image,
                    const Image<Label>& labels, const Image<std::int32_t>& components, float zone_m,
                    LabelledReturns& returns) {
    returns.label.resize(scan.size());
    returns.component.assign(scan.size(), 0);
    for (auto* indices : {&returns.roi, &returns.rou, &returns.unclassified}) indices->clear();

    for (std::size_t i = 0; i < scan.size(); ++i) {
        const float range_m = scan.range_m[i];
        const auto index = static_cast<std::uint32_t>(i);
        if (!(range_m >= sensor.min_range_m && range_m <= sensor.max_range_m)) {  // NaN too
            returns.label[i] = Label::Unclassified;
            returns.unclassified.push_back(index);
        } else if (range_m > zone_m || labels.data()[image.depth_mapper[i]] == Label::Rou) {
            returns.label[i] = Label::Rou;
            returns.rou.push_back(index);
        } else {
            returns.label[i] = Label::Roi;
            returns.component[i] = components.data()[image.depth_mapper[i]];
            returns.roi.push_back(index);
        }
    }
}

}  // namespace hagen
