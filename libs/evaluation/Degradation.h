#pragma once
#include <hagen/evaluation/ScanScores.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/simulation/Random.h>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// Degrades scans and their ground truth, as specified by `--degrade` (docs/evaluation.md). With
/// `rain`, the ground truth of drops is Unclassified. Tilting (roll_deg, pitch_deg) recomputes rows
/// and removes returns more than half a beam step outside the field of view. With `upside_down`,
/// y and z of the returns are negated, so that the sensor becomes mirrored(sensor).
class Degradation {
 public:
    using Random = simulation::Random;
    using Function =
        std::function<GroundTruthScan(const GroundTruthScan&, const SensorModel&, Random&)>;

    /// Throws std::invalid_argument for values out of range and unknown names, listing known names.
    explicit Degradation(const std::string& text);

    const std::string& name() const { return name_; }  ///< as passed to the constructor
    /// True if the degraded scan is from mirrored(sensor).
    bool mirrorsSensor() const { return mirrors_sensor_; }
    /// Throws std::invalid_argument for rows that the sensor does not have.
    void checkSensor(const SensorModel& sensor) const;

    /// Degrades a located scan of this sensor. The result depends only on scan and seed, not on the
    /// machine.
    GroundTruthScan apply(const GroundTruthScan& scan, const SensorModel& sensor,
                          std::uint64_t seed) const;

 private:
    std::string name_;
    Function function_;
    int highest_row_ = 0;  ///< highest row in `name`
    bool mirrors_sensor_ = false;
};

/// The degradations of `--hard-sets` for scans of a sensor.
std::vector<Degradation> standardDegradations(const SensorModel& sensor);

/// The sensor turned upside down: in its own frame, its beams have the opposite elevations.
SensorModel mirrored(const SensorModel& sensor);

/// The returns of a scan for which `is_kept` is true.
GroundTruthScan partOf(const GroundTruthScan& scan, const std::vector<bool>& is_kept);

}  // namespace hagen::evaluation
