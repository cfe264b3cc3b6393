#pragma once
#include <hagen/evaluation/LabelMap.h>
#include <hagen/evaluation/Method.h>
#include <hagen/evaluation/Scores.h>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// A scan whose true labels are known.
struct TrueScan {
    ScanInput input;
    std::vector<Label> truth;          ///< a label a return; Unclassified ones are left out
    std::vector<std::uint16_t> kinds;  ///< the kind of each return, or empty: not known
    double altitude_m = NAN;           ///< of the sensor above the ground; NaN: not known
};

/// What the labels of one scan are worth, in all and in parts.
struct ScanScores {
    std::size_t folder = 0;  ///< which of the evaluated folders it is of
    double altitude_m = NAN;
    Scores all;
    std::vector<Scores> by_range;           ///< by band, from the nearest
    std::map<std::string, Scores> by_kind;  ///< by the kind's name; empty where kinds are not known
};

/// Up to which range returns are scored, and in what steps.
struct RangeBands {
    float max_range_m = 20;
    float width_m = 5;

    std::size_t count() const;
    /// The band of a range up to max_range_m; a range between two bands is of the farther one.
    std::size_t bandOf(float range_m) const;
    std::string nameOf(std::size_t band) const;  ///< "5-10 m"
};

/// Scores the labels `found` for a scan: of the returns `chosen` (or all, where there is none),
/// those within the bands' range whose true label is not Unclassified.
/// Throws std::invalid_argument where there is not a true label, a found label and (where there are
/// any) a kind for each return, or a kind that is scored has no name in `kinds`.
ScanScores scoreScan(const TrueScan& scan, const std::vector<Label>& found, const LabelMap& kinds,
                     const RangeBands& bands, const std::vector<std::size_t>* chosen = nullptr);

}  // namespace hagen::evaluation
