#pragma once
#include <string>
#include <vector>

#include <hagen/reports/Summary.h>

namespace hagen::reports {

/// Whether answers depend on conditions that a reader may doubt: unbiased distances or distances as
/// stored, dusty or clear air. Comparisons that were flown both ways, with everything else equal:
/// one sentence for each whose answer is the opposite, and one with the counts. Empty if nothing
/// was flown both ways.
std::vector<std::string> sensitivitySentences(const Summary& summary);

}  // namespace hagen::reports
