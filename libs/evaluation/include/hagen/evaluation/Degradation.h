#pragma once
#include <hagen/evaluation/ScanScores.h>
#include <hagen/scan/SensorModel.h>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// A scan as a worse sensor would have recorded it, or the same sensor in a worse place, with its
/// ground truth. What is done to it is written as in `--degrade`:
///
///     dead_beams=R[,R...]   rows without returns; row 0 is the lowest beam
///     dropout=P             each return is lost with probability P [%]
///     noise_m=S             Gaussian noise of the range, with standard deviation S
///     rain=P                P [%] of the returns are from a drop or dust instead: at a range drawn
///                           evenly between 0.5 m and 12 m, or the return's own range. Their ground
///                           truth is Unclassified
///     roll_deg=A, pitch_deg=A   the sensor is tilted (as Attitude says in Levelling.h) and sees
///                           the same surroundings: rows are computed anew, and returns more than
///                           half a beam step outside its field of view are removed. Methods are
///                           not told, unless ",attitude" is appended
///     upside_down           the sensor is rolled by 180 degrees and methods are told. It has the
///                           same returns in its own frame (y and z with opposite signs), so that
///                           its lowest row looks at the sky: it is mirrored(sensor)
///     fov_deg=A             only azimuths within A / 2 of forward
///     above_deg=E, below_deg=E   only beams whose elevation is higher, or lower
///     dual_return           a ray whose neighbour in its row is more than 1 m farther has a second
///                           return there with probability 0.3: part of the beam passed by the edge
///     rate_hz=R             one of R / 10 azimuths of each row, as if a sensor that was recorded
///                           at 10 Hz turned at R Hz, 20 or more
class Degradation {
 public:
    using Random = std::mt19937_64;
    using Function =
        std::function<GroundTruthScan(const GroundTruthScan&, const SensorModel&, Random&)>;

    /// Parses a text as above. Throws std::invalid_argument for others, listing what is known, and
    /// for values out of range.
    explicit Degradation(const std::string& text);

    const std::string& name() const { return name_; }  ///< the text
    /// True if the degraded scan is one of mirrored(sensor).
    bool mirrorsSensor() const { return mirrors_sensor_; }
    /// Throws std::invalid_argument if it cannot be applied to scans of this sensor: a row that the
    /// sensor does not have.
    void checkSensor(const SensorModel& sensor) const;

    /// Degrades a located scan of this sensor; the same for the same seed, on every machine. Ranges
    /// and azimuths of the result are located, too, and its rows are those of the sensor.
    GroundTruthScan apply(const GroundTruthScan& scan, const SensorModel& sensor,
                          std::uint64_t seed) const;

 private:
    std::string name_;
    Function function_;
    int highest_row_ = 0;  ///< that it mentions
    bool mirrors_sensor_ = false;
};

/// The degradations of `--hard-sets` for scans of a sensor.
std::vector<Degradation> standardDegradations(const SensorModel& sensor);

/// The sensor turned upside down: its beams, seen in its own frame, have the opposite elevations.
SensorModel mirrored(const SensorModel& sensor);

/// The part of a scan whose returns have a true element in `is_kept`.
GroundTruthScan partOf(const GroundTruthScan& scan, const std::vector<bool>& is_kept);

}  // namespace hagen::evaluation
