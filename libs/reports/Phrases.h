#pragma once
#include <string>
#include <vector>

#include <hagen/reports/Summary.h>

namespace hagen::reports {

/// A difference of shares (0 to 1) in percentage points, with its sign: "+1.2", "-0.4", "0.0".
std::string points(double share);

/// "-0.7 to +0.9".
std::string pointsOf(const trials::Bounds& bounds);

std::string join(const std::vector<std::string>& words, const std::string& between);

/// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& words);

/// "3 runs", "1 run".
std::string counted(int count, const std::string& what);

/// With a capital first letter.
std::string capital(std::string text);

/// "RoI window with A*".
std::string withGuidance(const trials::Contender& contender);

/// The second contender of a pairing, with its guidance if that differs: "OctoMap 0.4 m".
std::string rivalOf(const Pairing& pairing);

/// "in gap", "on wires", "without wires"; empty for all scenarios.
std::string placeOf(const std::string& scenario);

/// "3 points", the margin of non-inferiority.
std::string marginText();

/// "p 0.004" as corrected, or that the test could not be significant: "2 courses differ, too few
/// for a test".
std::string testText(const Pairing& pairing);

/// Where the interval and the corrected test disagree about a difference of zero; else empty.
std::string disagreementText(const Pairing& pairing);

/// "98.3 % vs. 78.3 % of 60 courses; +20.0 points, +9.6 to +31.9; p 0.004".
std::string figuresOf(const Pairing& pairing);

}  // namespace hagen::reports
