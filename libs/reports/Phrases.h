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

}  // namespace hagen::reports
