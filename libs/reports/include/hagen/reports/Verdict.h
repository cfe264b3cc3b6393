#pragma once
#include <string>
#include <vector>

#include "Summary.h"

namespace hagen::reports {

/// The verdict as text, one entry per statement: single scenarios first, then all together, then
/// collisions. It depends on the runs of the summary alone, so it can be made for any part of them.
std::vector<std::string> verdictOf(const Summary& summary);

/// W-RoI against W-Full, first without wires, then on each kind of wires. Empty for any other
/// pairing, and if only wires or no wires were flown.
std::vector<Pairing> splitByWires(const Summary& summary, const Pairing& overall);

/// Pairings in single scenarios in which the first contender succeeds less often; largest loss
/// first.
std::vector<Pairing> lossesOf(const Summary& summary);

/// The difference in success with interval and p, what it means, and for a total how many of its
/// scenarios are without a difference.
std::string differenceText(const Pairing& pairing);

/// How many comparisons could not be significant and are left out of Holm's correction. `which`
/// follows the word, such as "in single scenarios".
std::string leftOutSentence(const std::vector<Pairing>& pairings, const std::string& which);

/// In how many of the scenarios W-RoI succeeds less often, and in how many of them that is
/// significant or may be chance.
std::string lossesSentence(const Summary& summary);

}  // namespace hagen::reports
