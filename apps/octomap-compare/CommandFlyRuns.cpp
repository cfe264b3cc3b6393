// octomap-compare fly-runs: a worker process of `closedloop`.
#include <hagen/base/MemoryLimit.h>
#include <hagen/trials/FlyRuns.h>
#include <iostream>
#include <memory>
#include <new>

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
    } catch (const std::bad_alloc&) {
        std::cerr << base::outOfMemory() << "\n";
        return 1;
    } catch (const std::exception& e) {  // closedloop prints it
        std::cerr << e.what() << "\n";
        return 1;
    }
}

}  // namespace

void addFlyRuns(Program& program) {
    const auto flags = std::make_shared<Flags>();
    Command sub = program.subcommand("fly-runs", "fly runs for a campaign");
    sub.hide();  // only closedloop uses it
    sub.option("--parent", flags->parent_pid, "process to end with").required();
    sub.option("--profile", flags->profile, "latency profile").required();
    sub.option("--journal", flags->journal, "file to append finished runs to").required();
    sub.option("runs", flags->keys, "keys of runs").required();
    sub.does([flags] { return run(*flags); });
}

}  // namespace hagen
