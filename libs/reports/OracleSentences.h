#pragma once
#include <string>
#include <vector>

#include <hagen/reports/Summary.h>

namespace hagen::reports {

/// Per scenario and guidance what the true scene reaches under a condition, which is the planner's
/// ceiling, and how far the models are from it. Scenarios without a gap share a sentence. Empty if
/// the true scene was not flown.
std::vector<std::string> oracleSentences(const Summary& summary,
                                         const trials::Condition& condition);

/// The same for each condition that differs from the reference by its speed only.
std::vector<std::string> oracleSentencesAtOtherSpeeds(const Summary& summary,
                                                      const trials::Condition& reference);

}  // namespace hagen::reports
