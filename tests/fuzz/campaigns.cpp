// Campaign tables and latency profiles with arbitrary content.
#include <hagen/avoidance/LatencyProfile.h>
#include "avoidance/flights/RunTable.h"

#include "fuzz/Target.h"

namespace hagen::fuzz {
namespace {

/// Checks that a run's key round-trips.
void writeAndReadKey(const avoidance::Run& run) {
    const std::string key = avoidance::keyOf(run);
    require(avoidance::keyOf(avoidance::runOfKey(key)) == key, "a key changes by writing it");
}

void readCampaign(std::string_view input) {
    const InputFile file(input, "runs.csv");
    mayRefuse([&] {
        const auto profile = avoidance::latencyProfileFrom(std::string(input));
        const std::string text = avoidance::textOf(profile);
        require(avoidance::textOf(avoidance::latencyProfileFrom(text)) == text,
                "a profile changes by writing it");
    });
    mayRefuse([&] {
        auto runs = avoidance::readRuns(file.path());
        for (const avoidance::Run& run : runs) writeAndReadKey(run);
        avoidance::sortRuns(runs);
    });
    mayRefuse([&] { writeAndReadKey(avoidance::runOfKey(std::string(input))); });
}

Seeds campaignFiles() {
    avoidance::Run run{};
    run.scenario = "forest-0.10";
    run.seed = 7;
    run.oracle_path_m = 40.5;
    run.settings_hash = "0123456789abcdef";
    run.version = "1.0";
    avoidance::LatencyProfile profile = avoidance::standardLatencyProfile();
    for (auto& [stage, quantiles] : profile.quantiles_ms) quantiles.resize(3);
    return {avoidance::textOf(profile),
            avoidance::runHeader() + "\n" + avoidance::rowOf(run) + "\n", avoidance::keyOf(run)};
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
