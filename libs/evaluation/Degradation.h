#pragma once
#include <hagen/evaluation/ScanScores.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/simulation/Random.h>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// Degrades scans and their ground truth, as specified by `--degrade`:
///
///     dead_beams=R[,R...]   rows without returns; row 0 is the lowest beam
///     dropout=P             each return is lost with probability P [%]
///     noise_m=S             Gaussian noise of the range, with standard deviation S
///     rain=P                P [%] of the returns come from a drop instead, at a uniformly random
///                           range from 0.5 m to 12 m or the return's own range. Their ground truth
///                           is Unclassified
///     roll_deg=A, pitch_deg=A   the sensor is tilted (Attitude in Levelling.h) in the same
///                           surroundings. Rows are recomputed; returns more than half a beam
///                           step outside the field of view are removed. Methods get the attitude
///                           only if ",attitude" is appended
///     upside_down           the sensor is rolled by 180 degrees, and methods get the attitude. The
///                           returns are the same (y and z negated), so the sensor becomes
///                           mirrored(sensor)
///     fov_deg=A             only azimuths within A / 2 of forward
///     above_deg=E, below_deg=E   only beams above, or below, elevation E
///     dual_return           a ray whose neighbour in its row is more than 1 m farther has a second
///                           return there with probability 0.3
///     rate_hz=R             one of R / 10 azimuths of each row, as if a 10 Hz sensor turned at
///                           R Hz (20 or more)
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
