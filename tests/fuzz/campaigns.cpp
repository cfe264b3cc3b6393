// The files of a campaign: its table and latency profile, with any content.
#include <hagen/trials/LatencyProfile.h>
#include <hagen/trials/RunTable.h>

#include "fuzz/Target.h"

namespace hagen::fuzz {
namespace {

/// The key of a run reads as the same.
void writeAndReadKey(const trials::Run& run) {
    const std::string key = trials::keyOf(run);
    require(trials::keyOf(trials::runOfKey(key)) == key, "a key changes by writing it");
}

void readCampaign(std::string_view input) {
    const InputFile file(input, "runs.csv");
    mayRefuse([&] {
        const auto profile = trials::latencyProfileFrom(std::string(input));
        const std::string text = trials::textOf(profile);
        require(trials::textOf(trials::latencyProfileFrom(text)) == text,
                "a profile changes by writing it");
    });
    mayRefuse([&] {
        auto runs = trials::readRuns(file.path());
        for (const trials::Run& run : runs) writeAndReadKey(run);
        trials::sortRuns(runs);
    });
    mayRefuse([&] { writeAndReadKey(trials::runOfKey(std::string(input))); });
}

Seeds campaignFiles() {
    trials::Run run{"forest-0.10", 7, {}, {}, 40.5, "0123456789abcdef", "1.0"};
    trials::LatencyProfile profile = trials::standardLatencyProfile();
    for (auto& [stage, quantiles] : profile.quantiles_ms) quantiles.resize(3);
    return {trials::textOf(profile), trials::runHeader() + "\n" + trials::rowOf(run) + "\n",
            trials::fullRunHeader() + "\n" + trials::fullRowOf(run) + "\n", trials::keyOf(run)};
}

const bool kAdded = add({"campaigns",
                         readCampaign,
                         campaignFiles,
                         {"scenario", "seed", "model", "guidance", "success", "collision",
                          "timeout", "none", "noise", "drift", "optimistic", "brake_known", "dusty",
                          "clear", "unbiased", "as-stored", "sectors", "scans", "quantiles_ms"},
                         8000});

}  // namespace
}  // namespace hagen::fuzz
