#pragma once
#include <hagen/pages/Table.h>
#include <hagen/trials/Statistics.h>
#include <string>

namespace hagen::reports {

/// "3.2 to 4.1".
std::string intervalText(const trials::Bounds& bounds, int decimals);
/// A share (0 to 1) as "97.5".
std::string percent(double share);
/// "97.5 (94.3 to 98.9)" with Wilson's 95 % interval; "-" without trials.
std::string percentOf(int successes, int trials);
/// The same with the number of runs: "96.0 (92.3 to 98.0; 200)".
std::string percentOfRuns(int successes, int runs);
/// "<0.001", "0.023".
std::string pText(double p);

}  // namespace hagen::reports
