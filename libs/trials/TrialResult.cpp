#include <hagen/trials/TrialResult.h>

#include "Words.h"

namespace hagen::trials {

std::string nameOf(Outcome outcome) { return kOutcomes[static_cast<std::size_t>(outcome)]; }

}  // namespace hagen::trials
