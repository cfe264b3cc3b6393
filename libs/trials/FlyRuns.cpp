#include <hagen/trials/FlyRuns.h>
#include <hagen/trials/Journal.h>
#include <hagen/trials/SettingsHash.h>
#include <hagen/trials/Trial.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <optional>

namespace hagen::trials {
namespace {

struct Stopped {};

}  // namespace

void flyRuns(const std::vector<std::string>& keys, const LatencyProfile& profile,
             const std::filesystem::path& journal_file, const std::function<bool()>& keep_going) {
    Journal journal(journal_file);
    const std::string settings_hash = hashOfSettings(profile);
    const auto stopIfTold = [&] {
        if (!keep_going()) throw Stopped();
    };
    TrialListener listener;
    listener.moved = [&](double, const avoidance::VehicleState&) { stopIfTold(); };
    std::optional<Course> course;
    try {
        for (const std::string& key : keys) {
            stopIfTold();
            Run run = runOfKey(key);
            if (!course || course->scenario != run.scenario || course->seed != run.seed) {
                course = makeCourse(run.scenario, run.seed);
            }
            run.oracle_path_m = course->oracle_path_m;
            run.settings_hash = settings_hash;
            run.version = HAGEN_VERSION;
            TrialMeasurement measurement;
            run.result = runTrial(*course, run.setup, profile, &measurement, listener);
            journal.append(run, measurement);
        }
    } catch (const Stopped&) {
    }
}

void endWithParent(int parent_pid) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent_pid) raise(SIGKILL);
}

}  // namespace hagen::trials
