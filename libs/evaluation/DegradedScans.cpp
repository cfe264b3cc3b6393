#include <hagen/evaluation/DegradedScans.h>
#include <utility>

namespace hagen::evaluation {

DegradedScans::DegradedScans(std::unique_ptr<LabelledScanSource> source, Degradation degradation)
    : source_(std::move(source)), degradation_(std::move(degradation)), sensor_(source_->sensor()) {
    degradation_.checkSensor(sensor_);
}

std::optional<GroundTruthScan> DegradedScans::next() {
    const auto scan = source_->next();
    if (!scan) return std::nullopt;
    return degradation_.apply(*scan, sensor_, scans_++);
}

}  // namespace hagen::evaluation
