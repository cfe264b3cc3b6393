#pragma once
#include <hagen/evaluation/Evaluation.h>
#include <memory>
#include "evaluation/Degradation.h"

namespace hagen::evaluation {

/// Degrades each scan of a source when it is pulled; scan i with seed i. Heights above the true
/// ground are computed first, because a degraded scan may not show the ground. If the degradation
/// mirrors the sensor, the source's methods must be for mirrored(sensor()). Throws
/// std::invalid_argument if the degradation cannot be applied to the source's sensor.
class DegradedScans : public LabelledScanSource {
 public:
    DegradedScans(std::unique_ptr<LabelledScanSource> source, Degradation degradation);

    std::optional<GroundTruthScan> next() override;
    const std::string& name() const override { return source_->name(); }
    std::size_t size() const override { return source_->size(); }
    const LabelMap& kinds() const override { return source_->kinds(); }
    SensorModel sensor() const override { return source_->sensor(); }
    std::vector<Method> makeMethods() const override { return source_->makeMethods(); }

 private:
    std::unique_ptr<LabelledScanSource> source_;
    Degradation degradation_;
    SensorModel sensor_;
    std::uint64_t scans_ = 0;
};

}  // namespace hagen::evaluation
