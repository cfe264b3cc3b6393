#pragma once
#include <string>
#include <vector>

#include "Report.h"
#include "SharedCourses.h"

namespace hagen::reports {

/// How many of the planned runs are there; empty where all are, or nothing is known of a plan.
std::string unfinishedWords(const trials::FlownRuns& flown);

/// What was flown, in sentences.
std::vector<std::string> flownWords(const Report& report);

/// How many courses contenders have in common, and on how many all arrived.
std::string sharedWords(const SharedCourses& shared);

}  // namespace hagen::reports
