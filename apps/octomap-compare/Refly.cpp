#include "Refly.h"

namespace hagen {

Reflown flyAgain(const Run& run, const LatencyProfile& profile, const TrialListener& listener) {
    Reflown again{makeCourse(run.scenario, run.seed), {}, false};
    again.result = runTrial(again.course, run.setup, profile, nullptr, listener);
    Run flown = run;
    flown.result = again.result;
    flown.oracle_path_m = again.course.oracle_path_m;
    again.is_same = rowOf(flown) == rowOf(run);
    return again;
}

}  // namespace hagen
