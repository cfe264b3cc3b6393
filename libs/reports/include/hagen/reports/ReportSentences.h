#pragma once
#include <string>
#include <vector>

#include "Report.h"
#include "SharedCourses.h"

namespace hagen::reports {

/// How many of the planned runs are done. Empty if all are done or no plan is known.
std::string unfinishedSentence(const trials::FlownRuns& flown);

/// Runs, contenders, conditions, settings, seeds and latency profile.
std::vector<std::string> flightSentences(const Report& report);

/// How many courses the contenders have in common, and on how many all reached the goal.
std::string sharedCoursesSentence(const SharedCourses& shared);

/// The same without how many arrived.
std::string flownTogetherSentence(const SharedCourses& shared);

}  // namespace hagen::reports
