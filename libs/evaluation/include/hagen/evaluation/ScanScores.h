#pragma once
#include <hagen/evaluation/LabelMap.h>
#include <hagen/evaluation/Method.h>
#include <hagen/evaluation/Scores.h>
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// A scan with ground-truth labels.
struct GroundTruthScan {
    std::string name;  ///< file or entry, for messages
    ScanInput input;
    std::vector<Label> truth;  ///< one label per return; Unclassified returns are not scored
    std::vector<std::uint16_t> kinds;    ///< class of each return; empty if unknown
    std::vector<std::uint32_t> objects;  ///< obstacle number of each return, or 0; empty if unknown
    double altitude_m = NAN;             ///< altitude of the sensor above the ground
    /// The true attitude, like ScanInput::map_from_sensor, if it is withheld from the methods.
    std::optional<Eigen::Matrix3f> true_level_from_sensor;
    /// Heights of obstacle returns above the true ground; empty: heightsAboveTrueGround().
    std::vector<float> heights_m = {};

    /// Rotates to a frame with z up: by the true attitude, else the input's, else not at all.
    Eigen::Matrix3f levelFromSensor() const;
};

/// The scores of one scan, in total and by part.
struct ScanScores {
    std::size_t folder = 0;  ///< index of the evaluated folder
    double altitude_m = NAN;
    Scores all;
    std::vector<Scores> by_range;           ///< one entry per band, nearest first
    std::map<std::string, Scores> by_kind;  ///< by class name; empty if classes are unknown
};

/// Range bands: maximum range of scored returns, and width of a band.
struct RangeBands {
    float max_range_m = 20;
    float width_m = 5;

    /// Throws std::invalid_argument for more than a million bands.
    std::size_t count() const;
    /// Returns the band of a range up to max_range_m. Lower bounds are inclusive.
    std::size_t bandOf(float range_m) const;
    std::string nameOf(std::size_t band) const;  ///< "5-10 m"
};

/// Throws std::invalid_argument unless the numbers of labels (named `what`) and returns agree.
void checkSizes(std::size_t returns, std::size_t labels, const std::string& what);

/// Scores the labels `found` of the returns `chosen` (default: all) within the maximum range whose
/// ground truth is not Unclassified. Throws std::invalid_argument if the sizes differ
/// (checkSizes()), if a scored class has no name in `kinds`, or like RangeBands::count().
ScanScores scoreScan(const GroundTruthScan& scan, const std::vector<Label>& found,
                     const LabelMap& kinds, const RangeBands& bands,
                     const std::vector<std::size_t>* chosen = nullptr);

}  // namespace hagen::evaluation
