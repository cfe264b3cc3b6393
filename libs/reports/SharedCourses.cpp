#include <hagen/reports/SharedCourses.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "RepeatedCourse.h"

namespace hagen::reports {
namespace {

using ByContender = std::map<trials::Contender, const trials::Run*>;
using Courses = std::map<CourseKey, ByContender>;

template <class Holds>
bool allOf(const std::vector<const trials::Run*>& flights, Holds holds) {
    return std::all_of(flights.begin(), flights.end(),
                       [&](const trials::Run* run) { return holds(run->result); });
}

/// The flights of a course in the order of the contenders; empty if one of them did not fly it.
std::vector<const trials::Run*> flightsOf(const std::vector<trials::Contender>& contenders,
                                          const Courses& courses, const CourseKey& course) {
    const auto flights = courses.find(course);
    if (flights == courses.end()) return {};
    std::vector<const trials::Run*> of;
    for (const trials::Contender& contender : contenders) {
        const auto flight = flights->second.find(contender);
        if (flight == flights->second.end()) return {};
        of.push_back(flight->second);
    }
    return of;
}

/// Whether all of them flew another course of the same layout, which is counted.
bool isRepeated(const std::vector<trials::Contender>& contenders, const Courses& courses,
                const CourseKey& course) {
    const CourseKey first = firstOfLayout(course);
    return first != course && !flightsOf(contenders, courses, first).empty();
}

SharedCourses sharedBy(const std::vector<trials::Contender>& contenders, const Courses& courses,
                       const trials::Condition& condition) {
    SharedCourses shared;
    shared.condition = condition;
    shared.guidance = contenders.front().guidance;
    shared.contenders = contenders;
    shared.min_clearances_m.resize(contenders.size());
    std::vector<std::vector<const trials::Run*>> flown(contenders.size()),
        arrived(contenders.size()), reacted(contenders.size());
    for (const auto& entry : courses) {
        const CourseKey& course = entry.first;
        const std::vector<const trials::Run*> flights = flightsOf(contenders, courses, course);
        if (flights.empty() || isRepeated(contenders, courses, course)) continue;
        const bool all_arrived = allOf(flights, [](const trials::TrialResult& r) {
            return r.outcome == trials::Outcome::Success;
        });
        const bool all_reacted = all_arrived && allOf(flights, [](const trials::TrialResult& r) {
                                     return !std::isnan(r.first_reaction_m);
                                 });
        ++shared.flown;
        shared.arrived += all_arrived ? 1 : 0;
        shared.reacted += all_reacted ? 1 : 0;
        for (std::size_t c = 0; c < contenders.size(); ++c) {
            const trials::Run* run = flights[c];
            shared.min_clearances_m[c].push_back(run->result.min_clearance_m);
            flown[c].push_back(run);
            if (all_arrived) arrived[c].push_back(run);
            if (all_reacted) reacted[c].push_back(run);
        }
    }
    if (shared.flown == 0) return shared;
    for (const auto& runs : flown) shared.flown_cells.push_back(cellOf("", runs));
    if (shared.arrived == 0) return shared;
    for (std::size_t c = 0; c < contenders.size(); ++c) {
        Cell cell = cellOf("", arrived[c]);
        cell.first_reaction_m =
            reacted[c].empty() ? Spread{} : cellOf("", reacted[c]).first_reaction_m;
        shared.cells.push_back(cell);
    }
    return shared;
}

std::map<trials::Contender, int> flownBy(const Courses& courses) {
    std::map<trials::Contender, int> counts;
    for (const auto& [course, flights] : courses) {
        for (const auto& [contender, run] : flights) {
            if (!isRepeated({contender}, courses, course)) ++counts[contender];
        }
    }
    return counts;
}

/// Distinct numbers of courses flown, the largest first; those that differ by less than a tenth are
/// merged.
std::vector<int> levelsOf(const std::map<trials::Contender, int>& counts) {
    std::vector<int> sorted;
    for (const auto& [contender, count] : counts) sorted.push_back(count);
    std::sort(sorted.rbegin(), sorted.rend());
    std::vector<int> levels;
    int most = 0;
    for (const int count : sorted) {
        if (10 * count > 9 * most && !levels.empty()) {
            levels.back() = count;
        } else {
            levels.push_back(count);
            most = count;
        }
    }
    return levels;
}

}  // namespace

std::vector<SharedCourses> sharedCourses(const std::vector<trials::Run>& runs,
                                         const Summary& summary,
                                         const trials::Condition& condition) {
    std::map<std::string, Courses> by_guidance;
    for (const trials::Run& run : runs) {
        if (!(trials::conditionOf(run) == condition)) continue;
        by_guidance[run.setup.guidance][{run.scenario, run.seed}][trials::contenderOf(run)] = &run;
    }
    std::vector<SharedCourses> all;
    for (const auto& [guidance, courses] : by_guidance) {
        const std::map<trials::Contender, int> counts = flownBy(courses);
        for (const int least : levelsOf(counts)) {
            std::vector<trials::Contender> contenders;
            for (const trials::Contender& contender : summary.contenders) {
                const auto count = counts.find(contender);
                if (count != counts.end() && count->second >= least) {
                    contenders.push_back(contender);
                }
            }
            all.push_back(sharedBy(contenders, courses, condition));
        }
    }
    return all;
}

}  // namespace hagen::reports
