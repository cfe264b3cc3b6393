#pragma once
#include <string>
#include <vector>

#include "Summary.h"

namespace hagen::reports {

/// The verdict in plain words, a sentence or two each.
std::vector<std::string> verdictOf(const Summary& summary);

/// W-RoI against W-Full where wires were flown: first where no wires are, then among them. Nothing
/// for any other pairing, and where only wires were flown, or none.
std::vector<Pairing> wiresApart(const Summary& summary, const Pairing& overall);

/// Pairings in single scenarios in which the first has less success, largest loss first.
std::vector<Pairing> lossesOf(const Summary& summary);

/// By how much the first has more success, with interval and p, and what is open.
std::string differenceText(const Pairing& pairing);

}  // namespace hagen::reports
