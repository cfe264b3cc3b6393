#include <hagen/avoidance/WindowSize.h>
#include <hagen/base/Json.h>
#include <hagen/base/ReadFile.h>
#include <hagen/settings/Settings.h>
#include <hagen/trials/CampaignFile.h>
#include <hagen/trials/SettingsHash.h>
#include <hagen/trials/TrialSensor.h>

#include <set>
#include <stdexcept>

#include "Words.h"

namespace hagen::trials {
namespace {

namespace fs = std::filesystem;
using base::Json;

const char kFileName[] = "campaign.json";

CampaignPlan planFrom(const Json& noted) {
    CampaignPlan plan;
    plan.scenarios = noted.at("scenarios").texts();
    plan.first_seed = noted.at("seeds").at(0).count();
    plan.last_seed = noted.at("seeds").at(1).count();
    plan.speeds_m_s = noted.at("speeds_m_s").numbers();
    plan.models = noted.at("models").texts();
    plan.guidances = noted.at("guidances").texts();
    plan.planners = noted.at("planners").texts();
    plan.pose_errors.clear();
    for (const std::string& error : noted.at("pose_errors").texts()) {
        plan.pose_errors.push_back(poseErrorFrom(error));
    }
    plan.latency_scales = noted.at("latency_scales").numbers();
    plan.brakes_in_known_space = wordFrom<int>(noted.at("unknown").text(), kUnknowns) == 1;
    // Plans without these entries are older.
    plan.airs = {Air::Clear};
    if (const Json* airs = noted.find("airs")) {
        plan.airs.clear();
        for (const std::string& air : airs->texts()) plan.airs.push_back(airFrom(air));
    }
    plan.distances = {ModelDistance::AsStored};
    if (const Json* distances = noted.find("distances")) {
        plan.distances.clear();
        for (const std::string& name : distances->texts()) {
            plan.distances.push_back(distanceFrom(name));
        }
    }
    if (const Json* updates = noted.find("updates")) {
        plan.updates.clear();
        for (const std::string& name : updates->texts()) plan.updates.push_back(updatesFrom(name));
    }
    return plan;
}

template <class Value>
std::vector<std::string> namesOf(const std::vector<Value>& values) {
    std::vector<std::string> names;
    for (const Value value : values) names.push_back(nameOf(value));
    return names;
}

/// The filter's zone by speed; `filter` has that of the presets.
Json zonesOf(const std::vector<std::string>& plans) {
    std::set<double> speeds_m_s;
    for (const std::string& plan : plans) {
        for (const double speed_m_s : planFrom(Json::parse(plan)).speeds_m_s) {
            speeds_m_s.insert(speed_m_s);
        }
    }
    Json zones = Json::array();
    for (const double speed_m_s : speeds_m_s) {
        const double zone_m = static_cast<double>(
            avoidance::perceptionRangeFor_m({speed_m_s, TrialSensor::kTurn_s, {}}));
        zones.push_back(Json{{"speed_m_s", speed_m_s}, {"zone_m", zone_m}});
    }
    return zones;
}

}  // namespace

std::string textOf(const CampaignPlan& plan) {
    Json text{{"scenarios", plan.scenarios},
              {"seeds", {plan.first_seed, plan.last_seed}},
              {"speeds_m_s", plan.speeds_m_s},
              {"models", plan.models},
              {"guidances", plan.guidances},
              {"planners", plan.planners},
              {"pose_errors", namesOf(plan.pose_errors)},
              {"latency_scales", plan.latency_scales},
              {"unknown", plan.brakes_in_known_space ? "brake_known" : "optimistic"},
              {"airs", namesOf(plan.airs)},
              {"distances", namesOf(plan.distances)}};
    // Plans of whole scans only are those of before.
    if (plan.updates != std::vector<Updates>{Updates::Scans}) {
        text["updates"] = namesOf(plan.updates);
    }
    return text.dump();
}

CampaignFile readCampaignFile(const fs::path& folder) {
    const fs::path file = folder / kFileName;
    CampaignFile campaign;
    const std::string text = base::readText(file);
    try {
        const Json root = Json::parse(text);
        campaign.settings_hash = root.at("settings").text();
        for (const Json& plan : root.at("flown").items()) campaign.plans.push_back(plan.dump());
    } catch (const std::exception& e) {
        throw std::runtime_error(file.string() + ": " + e.what());
    }
    return campaign;
}

std::string textOf(const CampaignFile& campaign, const LatencyProfile& profile) {
    Json root;
    root["program"] = "octomap-compare";
    root["version"] = HAGEN_VERSION;
    root["settings"] = campaign.settings_hash;
    root["profile"] = {
        {"machine", profile.machine}, {"made_by", profile.made_by}, {"date", profile.date}};
    root["vehicle"] = Json::parse(vehicleText());
    root["sensor"] = Json::parse(sensorText());
    root["filter"] = dumpSettings(Settings{});
    root["zones"] = zonesOf(campaign.plans);
    root["flown"] = Json::array();
    for (const std::string& plan : campaign.plans) {
        root["flown"].push_back(Json::parse(plan));
    }
    return root.dump(2) + "\n";
}

std::vector<CampaignPlan> readPlans(const fs::path& folder) {
    const fs::path file = folder / kFileName;
    const std::string text = base::readText(file);
    std::vector<CampaignPlan> plans;
    try {
        const Json root = Json::parse(text);
        for (const Json& noted : root.at("flown").items()) plans.push_back(planFrom(noted));
    } catch (const std::exception& e) {
        throw std::runtime_error(file.string() + ": " + e.what());
    }
    return plans;
}

}  // namespace hagen::trials
