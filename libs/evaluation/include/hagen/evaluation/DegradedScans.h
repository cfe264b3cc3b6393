#pragma once
#include <hagen/evaluation/Degradation.h>
#include <hagen/evaluation/Evaluation.h>
#include <memory>

namespace hagen::evaluation {

/// The scans of a source, each degraded as it is pulled; scan i with seed i. Heights
/// above the true ground are those before, because a degraded scan may not show it. Everything
/// else, methods included, is the source's: for a degradation that mirrors the sensor, its methods
/// must be those for mirrored(sensor()). Throws std::invalid_argument if the degradation cannot be
/// applied to its sensor.
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
