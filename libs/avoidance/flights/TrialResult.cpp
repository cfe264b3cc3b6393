#include <hagen/avoidance/TrialResult.h>

#include "avoidance/flights/Words.h"

namespace hagen::avoidance {

std::string nameOf(Outcome outcome) { return kOutcomes[static_cast<std::size_t>(outcome)]; }

}  // namespace hagen::avoidance
