#include "evaluation/DegradedScans.h"
#include <limits>
#include <utility>
#include "evaluation/TrueHeights.h"

namespace hagen::evaluation {

DegradedScans::DegradedScans(std::unique_ptr<LabelledScanSource> source, Degradation degradation)
    : source_(std::move(source)), degradation_(std::move(degradation)), sensor_(source_->sensor()) {
    degradation_.checkSensor(sensor_);
}

std::optional<GroundTruthScan> DegradedScans::next() {
    auto scan = source_->next();
    if (!scan) return std::nullopt;
    if (scan->heights_m.empty()) {
        constexpr float kAnyRange_m = std::numeric_limits<float>::infinity();
        scan->heights_m = heightsAboveTrueGround(*scan, levelPoints(*scan), kAnyRange_m);
    }
    return degradation_.apply(*scan, sensor_, scans_++);
}

}  // namespace hagen::evaluation
