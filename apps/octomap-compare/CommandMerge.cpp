// octomap-compare merge: joins folders of a campaign that was flown in parts.
#include <hagen/trials/MergeCampaigns.h>
#include <iostream>
#include <memory>

#include "Commands.h"

namespace hagen {
namespace {

struct Flags {
    std::vector<std::string> folders;
    std::string into;
    bool overwrites = false;
};

int run(const Flags& flags) {
    const std::size_t runs = trials::mergeCampaigns({flags.folders.begin(), flags.folders.end()},
                                                    flags.into, flags.overwrites);
    std::cout << runs << " runs in " << flags.into << "/runs.csv\n";
    return 0;
}

}  // namespace

void addMerge(Program& program) {
    const auto flags = std::make_shared<Flags>();
    Command sub = program.subcommand("merge", "join folders of one campaign, such as its shards");
    sub.option("folders", flags->folders, "folders of `closedloop`").required();
    sub.option("-o,--output", flags->into, "folder for all runs").required();
    sub.flag("--overwrite", flags->overwrites, "start that folder from scratch");
    sub.does([flags] { return run(*flags); });
}

}  // namespace hagen
