#include "SharedCourses.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace hagen {
namespace {

using CourseKey = std::pair<std::string, std::uint64_t>;
using ByContender = std::map<Contender, const Run*>;

template <class Holds>
bool allOf(const ByContender& flights, Holds holds) {
    return std::all_of(flights.begin(), flights.end(),
                       [&](const auto& flight) { return holds(flight.second->result); });
}

SharedCourses sharedBy(const std::vector<Contender>& contenders,
                       const std::map<CourseKey, ByContender>& courses,
                       const Condition& condition) {
    SharedCourses shared;
    shared.condition = condition;
    shared.guidance = contenders.front().guidance;
    shared.contenders = contenders;
    shared.min_clearances_m.resize(contenders.size());
    std::vector<std::vector<const Run*>> arrived(contenders.size()), reacted(contenders.size());
    for (const auto& [course, flights] : courses) {
        if (flights.size() < contenders.size()) continue;
        const bool all_arrived =
            allOf(flights, [](const TrialResult& r) { return r.outcome == Outcome::Success; });
        const bool all_reacted = all_arrived && allOf(flights, [](const TrialResult& r) {
                                     return !std::isnan(r.first_reaction_m);
                                 });
        ++shared.flown;
        shared.arrived += all_arrived ? 1 : 0;
        shared.reacted += all_reacted ? 1 : 0;
        for (std::size_t c = 0; c < contenders.size(); ++c) {
            const Run* run = flights.at(contenders[c]);
            shared.min_clearances_m[c].push_back(run->result.min_clearance_m);
            if (all_arrived) arrived[c].push_back(run);
            if (all_reacted) reacted[c].push_back(run);
        }
    }
    if (shared.arrived == 0) return shared;
    for (std::size_t c = 0; c < contenders.size(); ++c) {
        Cell cell = cellOf("", arrived[c]);
        cell.first_reaction_m =
            reacted[c].empty() ? Spread{} : cellOf("", reacted[c]).first_reaction_m;
        shared.cells.push_back(cell);
    }
    return shared;
}

}  // namespace

std::vector<SharedCourses> sharedCourses(const std::vector<Run>& runs, const Summary& summary,
                                         const Condition& condition) {
    std::map<std::string, std::map<CourseKey, ByContender>> by_guidance;
    for (const Run& run : runs) {
        if (!(conditionOf(run) == condition)) continue;
        by_guidance[run.setup.guidance][{run.scenario, run.seed}][contenderOf(run)] = &run;
    }
    std::vector<SharedCourses> all;
    for (const auto& [guidance, courses] : by_guidance) {
        std::vector<Contender> contenders;
        for (const Contender& contender : summary.contenders) {
            const bool is_there = std::any_of(courses.begin(), courses.end(), [&](const auto& c) {
                return c.second.count(contender) > 0;
            });
            if (is_there) contenders.push_back(contender);
        }
        all.push_back(sharedBy(contenders, courses, condition));
    }
    return all;
}

}  // namespace hagen
