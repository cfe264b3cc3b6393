// octomap-compare fly-runs: one process of `closedloop`, which starts as many as it needs.
#include <hagen/trials/FlyRuns.h>
#include <iostream>
#include <memory>

#include <hagen/command_line/Interrupt.h>
#include "Commands.h"

namespace hagen {
namespace {

struct Flags {
    int parent_pid = 0;
    std::string profile, journal;
    std::vector<std::string> keys;
};

int run(const Flags& flags) {
    trials::endWithParent(flags.parent_pid);
    try {
        trials::flyRuns(flags.keys, trials::readLatencyProfile(flags.profile), flags.journal,
                        [] { return !isInterrupted(); });
        return 0;
    } catch (const std::exception& e) {  // for the message of `closedloop`
        std::cerr << e.what() << "\n";
        return 1;
    }
}

}  // namespace

void addFlyRuns(Program& program) {
    const auto flags = std::make_shared<Flags>();
    Command sub = program.subcommand("fly-runs", "fly runs for a campaign");
    sub.hide();  // not in the help: closedloop alone uses it
    sub.option("--parent", flags->parent_pid, "process that this one ends with").required();
    sub.option("--profile", flags->profile, "latencies to draw from").required();
    sub.option("--journal", flags->journal, "file that finished runs are appended to").required();
    sub.option("runs", flags->keys, "keys of runs").required();
    sub.does([flags] { return run(*flags); });
}

}  // namespace hagen
