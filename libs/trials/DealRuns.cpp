#include <hagen/trials/DealRuns.h>
#include <algorithm>
#include <utility>

namespace hagen::trials {
namespace {

/// Runs of one share end within a few minutes, and their keys fit on a command line.
constexpr std::size_t kMostRuns = 200;

/// Courses of more runs than fit into a share come in parts.
std::vector<RunShare> runsByCourse(const std::vector<CourseFlights>& flights,
                                   const std::function<bool(const Run&)>& is_flown) {
    std::vector<RunShare> courses;
    for (const CourseFlights& course : flights) {
        RunShare keys;
        for (const TrialSetup& setup : course.setups) {
            Run run{};
            run.scenario = course.scenario;
            run.seed = course.seed;
            run.setup = setup;
            if (is_flown(run)) continue;
            if (keys.size() == kMostRuns) courses.push_back(std::exchange(keys, {}));
            keys.push_back(keyOf(run));
        }
        if (!keys.empty()) courses.push_back(keys);
    }
    return courses;
}

}  // namespace

std::vector<RunShare> dealRuns(const std::vector<CourseFlights>& flights, std::size_t jobs,
                               const std::function<bool(const Run&)>& is_flown) {
    const std::vector<RunShare> courses = runsByCourse(flights, is_flown);
    std::vector<RunShare> shares;
    for (std::size_t next = 0; next < courses.size();) {
        const std::size_t most = std::max<std::size_t>(1, (courses.size() - next) / (4 * jobs));
        RunShare share = courses[next++];
        for (std::size_t count = 1; count < most; ++count) {
            if (share.size() + courses[next].size() > kMostRuns) break;
            share.insert(share.end(), courses[next].begin(), courses[next].end());
            ++next;
        }
        shares.push_back(std::move(share));
    }
    return shares;
}

}  // namespace hagen::trials
