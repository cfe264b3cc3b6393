#include <hagen/replays/Refly.h>

namespace hagen::replays {

Reflown flyAgain(const trials::Run& run, const trials::LatencyProfile& profile,
                 const trials::TrialListener& listener) {
    Reflown again{trials::makeCourse(run.scenario, run.seed), {}, false};
    again.result = trials::runTrial(again.course, run.setup, profile, nullptr, listener);
    trials::Run flown = run;
    flown.result = again.result;
    flown.oracle_path_m = again.course.oracle_path_m;
    again.is_same = trials::rowOf(flown) == trials::rowOf(run);
    return again;
}

}  // namespace hagen::replays
