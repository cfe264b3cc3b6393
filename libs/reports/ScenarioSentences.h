#pragma once
#include <string>
#include <vector>

#include <hagen/reports/Summary.h>

namespace hagen::reports {

/// Comparisons within single scenarios: for each guidance of the reference condition first the
/// scenarios that are not saturated, then a sentence on those that are, then these at the lowest
/// speed at which they are not. Last, what guidance changes. One entry per scenario.
std::vector<std::string> scenarioSentences(const Summary& summary,
                                           const trials::Condition& reference);

/// Which scenarios are saturated under a condition, for each guidance: "With A*, ... ".
std::vector<std::string> saturationSentences(const Summary& summary,
                                             const trials::Condition& condition);

}  // namespace hagen::reports
