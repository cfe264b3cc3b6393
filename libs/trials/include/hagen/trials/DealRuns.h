#pragma once
#include <hagen/trials/CampaignPlan.h>
#include <hagen/trials/RunTable.h>
#include <functional>
#include <string>
#include <vector>

namespace hagen::trials {

/// Keys of runs that one worker process flies, course by course.
using RunShare = std::vector<std::string>;

/// Deals runs out to `jobs` processes that take one share after the other, in this order. Shares
/// are whole courses, or parts of one with more than 200 runs, and shrink from a quarter of a job's
/// part of what is left down to one course (guided self-scheduling, Polychronopoulos and Kuck
/// 1987): few processes are started, and all jobs end at about the same time. Runs that were flown
/// are left out.
std::vector<RunShare> dealRuns(const std::vector<CourseFlights>& flights, std::size_t jobs,
                               const std::function<bool(const Run&)>& is_flown);

}  // namespace hagen::trials
