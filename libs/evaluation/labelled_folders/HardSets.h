// Scores on degraded copies of the scans.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "evaluation/DegradedScans.h"

#include "evaluation/labelled_folders/LabelledFolders.h"

namespace hagen::evaluation {

/// Labelled scan folders, as opened by sourcesOf(). They are read once per degradation.
struct LabelledInputs {
    std::vector<std::string> folders;
    MethodSet rows;
    std::optional<LabelMap> label_map;
};

/// The scores with one degradation: one element per method, without --labels, which apply to
/// undegraded scans.
struct HardSet {
    std::string name;
    std::vector<MethodScores> methods;
};

/// Returns the standard degradations if requested, then those in `texts`, without duplicates.
/// Standard degradations are for the sensor with the fewest beams among the folders. Throws
/// SettingsError if a text cannot be parsed, or does not fit the sensor of a folder.
std::vector<Degradation> degradationsOf(const std::vector<std::string>& texts, bool with_standard,
                                        const LabelledInputs& inputs);

/// Called for each scan, method and degradation.
using HardSetListener =
    std::function<void(const std::string& degradation, const MethodOutput& output)>;

/// Scores all methods on each degradation in turn, over returns, not pixels. Throws like
/// evaluate().
std::vector<HardSet> scoreHardSets(const LabelledInputs& inputs,
                                   const std::vector<Degradation>& degradations,
                                   const RangeBands& range, const HardSetListener& listener = {});

}  // namespace hagen::evaluation
