// The files of a campaign: its plans, journals, tables and latency profiles, with any content.
#include <hagen/trials/CampaignFile.h>
#include <hagen/trials/CampaignPlan.h>
#include <hagen/trials/HeapCurves.h>
#include <hagen/trials/Journal.h>
#include <hagen/trials/LatencyProfile.h>
#include <hagen/trials/Measured.h>
#include <hagen/trials/RunTable.h>

#include "fuzz/Target.h"

namespace hagen::fuzz {
namespace {

/// What a run is written as reads as the same.
void writeAndRead(const trials::Run& run) {
    const std::string row = trials::fullRowOf(run), key = trials::keyOf(run);
    require(trials::fullRowOf(trials::runOf(row)) == row, "a run changes by writing it");
    require(trials::keyOf(trials::runOfKey(key)) == key, "a key changes by writing it");
}

void readCampaign(std::string_view input) {
    const InputFile file(input, "campaign.json");
    const std::filesystem::path folder = file.path().parent_path();
    mayRefuse([&] { trials::readCampaignFile(folder); });
    mayRefuse([&] {
        for (const trials::CampaignPlan& plan : trials::readPlans(folder)) trials::textOf(plan);
    });
    mayRefuse([&] {
        const auto profile = trials::latencyProfileFrom(std::string(input));
        const std::string text = trials::textOf(profile);
        require(trials::textOf(trials::latencyProfileFrom(text)) == text,
                "a profile changes by writing it");
    });
    mayRefuse([&] {
        for (const trials::JournalLine& line : trials::readJournal(file.path())) {
            writeAndRead(trials::runOf(line.run));
        }
    });
    mayRefuse([&] {
        auto runs = trials::readRuns(file.path());
        for (const trials::Run& run : runs) writeAndRead(run);
        trials::sortRuns(runs);
    });
    mayRefuse([&] { writeAndRead(trials::runOfKey(std::string(input))); });
    mayRefuse([&] { trials::readMeasured(file.path()); });
    mayRefuse([&] { trials::readHeapCurves(file.path()); });
}

Seeds campaignFiles() {
    trials::Run run{"forest-0.10", 7, {}, {}, 40.5, "0123456789abcdef", "1.0"};
    trials::LatencyProfile profile = trials::standardLatencyProfile();
    for (auto& [stage, quantiles] : profile.quantiles_ms) quantiles.resize(3);
    trials::CampaignPlan plan;
    const std::string measured =
        "scenario,seed,model,guidance,speed,planner,pose_error,latency_scale,unknown,air,distance,"
        "peak_model_bytes,filter_p50_ms\nforest-0.10,7,W-RoI,straight,10,primitives,none,1,"
        "optimistic,dusty,unbiased,1000,0.5\n";
    return {textOf({"0123456789abcdef", {trials::textOf(plan)}}, profile),
            trials::textOf(profile),
            trials::runHeader() + "\n" + trials::rowOf(run) + "\n",
            trials::fullRunHeader() + "\n" + trials::fullRowOf(run) + "\n",
            trials::rowOf(run) + "\t1,2,3\n" + trials::rowOf(run) + "\t4,5,6\n",
            trials::keyOf(run),
            measured,
            "model,path_m,bytes\nW-RoI,0,100\nW-RoI,10.5,200\n"};
}

const bool kAdded = add(
    {"campaigns",
     readCampaign,
     campaignFiles,
     {"scenario", "seed",      "model",   "guidance",   "success",      "collision", "timeout",
      "none",     "noise",     "drift",   "optimistic", "brake_known",  "dusty",     "clear",
      "unbiased", "as-stored", "sectors", "scans",      "quantiles_ms", "flown",     "settings"},
     8000});

}  // namespace
}  // namespace hagen::fuzz
