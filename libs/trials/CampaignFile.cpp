#include <hagen/base/Json.h>
#include <hagen/observations/Settings.h>
#include <hagen/trials/CampaignFile.h>
#include <hagen/trials/SettingsHash.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "TextFile.h"

namespace hagen::trials {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

const char kFileName[] = "campaign.json";

CampaignPlan planFrom(const ordered_json& noted) {
    CampaignPlan plan;
    plan.scenarios = noted.at("scenarios").get<std::vector<std::string>>();
    plan.first_seed = noted.at("seeds").at(0).get<std::uint64_t>();
    plan.last_seed = noted.at("seeds").at(1).get<std::uint64_t>();
    plan.speeds_m_s = noted.at("speeds_m_s").get<std::vector<double>>();
    plan.models = noted.at("models").get<std::vector<std::string>>();
    plan.guidances = noted.at("guidances").get<std::vector<std::string>>();
    plan.planners = noted.at("planners").get<std::vector<std::string>>();
    plan.pose_errors.clear();
    for (const auto& error : noted.at("pose_errors")) {
        plan.pose_errors.push_back(poseErrorFrom(error.get<std::string>()));
    }
    plan.latency_scales = noted.at("latency_scales").get<std::vector<double>>();
    plan.brakes_in_known_space = noted.at("unknown") == "brake_known";
    return plan;
}

}  // namespace

std::string textOf(const CampaignPlan& plan) {
    std::vector<std::string> errors;
    for (const PoseError error : plan.pose_errors) errors.push_back(nameOf(error));
    return base::Json{{"scenarios", plan.scenarios},
                      {"seeds", {plan.first_seed, plan.last_seed}},
                      {"speeds_m_s", plan.speeds_m_s},
                      {"models", plan.models},
                      {"guidances", plan.guidances},
                      {"planners", plan.planners},
                      {"pose_errors", errors},
                      {"latency_scales", plan.latency_scales},
                      {"unknown", plan.brakes_in_known_space ? "brake_known" : "optimistic"}}
        .dump();
}

CampaignFile readCampaignFile(const fs::path& folder) {
    const fs::path file = folder / kFileName;
    CampaignFile campaign;
    try {
        std::ifstream in(file, std::ios::binary);
        const ordered_json root = ordered_json::parse(in);
        campaign.settings_hash = root.at("settings").get<std::string>();
        for (const auto& plan : root.at("flown")) campaign.plans.push_back(plan.dump());
    } catch (const nlohmann::json::exception& e) {
        throw std::runtime_error(file.string() + ": " + e.what());
    }
    return campaign;
}

void writeCampaignFile(const CampaignFile& campaign, const LatencyProfile& profile,
                       const fs::path& folder) {
    base::Json root;
    root["program"] = "octomap-compare";
    root["version"] = HAGEN_VERSION;
    root["settings"] = campaign.settings_hash;
    root["profile"] = {
        {"machine", profile.machine}, {"made_by", profile.made_by}, {"date", profile.date}};
    root["vehicle"] = base::Json::parse(vehicleText());
    root["filter"] = observations::dumpSettings(observations::Settings{});
    root["flown"] = base::Json::array();
    for (const std::string& plan : campaign.plans) {
        root["flown"].push_back(base::Json::parse(plan));
    }
    writeWhole(folder / kFileName, root.dump(2) + "\n");
}

std::vector<CampaignPlan> readPlans(const fs::path& folder) {
    const fs::path file = folder / kFileName;
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file.string() + ": cannot be opened");
    std::vector<CampaignPlan> plans;
    try {
        const ordered_json root = ordered_json::parse(in);
        for (const auto& noted : root.at("flown")) plans.push_back(planFrom(noted));
    } catch (const std::exception& e) {
        throw std::runtime_error(file.string() + ": " + e.what());
    }
    return plans;
}

}  // namespace hagen::trials
