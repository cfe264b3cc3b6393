#pragma once
#include <string>
#include <vector>

#include "Summary.h"

namespace hagen::reports {

/// The verdict as text: entries of one or two sentences each.
std::vector<std::string> verdictOf(const Summary& summary);

/// W-RoI against W-Full, first without wires, then on wires only. Empty for any other pairing, and
/// if only wires or no wires were flown.
std::vector<Pairing> splitByWires(const Summary& summary, const Pairing& overall);

/// Pairings in single scenarios in which the first contender succeeds less often; largest loss
/// first.
std::vector<Pairing> lossesOf(const Summary& summary);

/// The difference in success with interval and p, and whether it is decided.
std::string differenceText(const Pairing& pairing);

}  // namespace hagen::reports
