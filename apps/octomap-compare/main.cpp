// Compares obstacle avoidance with and without a map.
#include "Commands.h"

namespace {

int command(int argc, char** argv) {
    hagen::Program program("octomap-compare",
                           "Compares obstacle avoidance based on RoI points of the filter with "
                           "avoidance based on maps.");
    program.footer(
        "Examples:\n"
        "  octomap-compare closedloop --scenario gap --seeds 1000-1019 --models all -o runs\n"
        "  octomap-compare openloop -i flight.rawlog --poses flight.tum -o models\n"
        "  octomap-compare COMMAND --help\n"
        "Exit codes: 0 success, 1 runtime error, 2 wrong usage.");
    program.version(HAGEN_VERSION);
    hagen::addClosedLoop(program);
    hagen::addCalibrate(program);
    hagen::addOpenLoop(program);
    hagen::addReplay(program);
    return program.run(argc, argv);
}

}  // namespace

int main(int argc, char** argv) { return hagen::base::guarded(argc, argv, command); }
