#pragma once
#include <optional>
#include <string>
#include <vector>

#include "Summary.h"

namespace hagen::reports {

/// Whether a scenario tells a contender from other models under one condition.
struct Saturation {
    std::string scenario;
    trials::Condition condition;
    trials::Contender first;
    int comparisons = 0;        ///< with other models
    int alike = 0;              ///< of these, comparisons without a course on which the two differ
    bool is_saturated = false;  ///< the answer of every comparison
};

/// One per scenario, condition and first contender of `summary.pairings`, in the order of
/// conditions, guidance and scenarios. Comparisons of a model with itself do not count.
std::vector<Saturation> saturationsOf(const Summary& summary);

/// The same scenario and contender at the lowest speed flown at which they are not saturated,
/// under otherwise equal conditions. nullopt: they are at every speed flown.
std::optional<Saturation> unsaturated(const std::vector<Saturation>& saturations,
                                      const Saturation& one);

}  // namespace hagen::reports
