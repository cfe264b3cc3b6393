#include <hagen/avoidance/Refly.h>

namespace hagen::avoidance {

Reflown flyAgain(const avoidance::Run& run, const avoidance::LatencyProfile& profile,
                 const avoidance::TrialListener& listener) {
    Reflown again{avoidance::makeCourse(run.scenario, run.seed), {}, false};
    again.result = avoidance::runTrial(again.course, run.setup, profile, nullptr, listener);
    avoidance::Run flown = run;
    flown.result = again.result;
    flown.oracle_path_m = again.course.oracle_path_m;
    again.is_same = avoidance::rowOf(flown) == avoidance::rowOf(run);
    return again;
}

}  // namespace hagen::avoidance
