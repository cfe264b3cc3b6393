#include "avoidance/flights/CampaignPlan.h"
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/Guidance.h>
#include <hagen/avoidance/Planner.h>
#include <hagen/avoidance/WorldModel.h>
#include <stdexcept>
#include "base/Text.h"

namespace hagen::avoidance {
namespace {

template <class Value>
void checkGiven(const std::string& what, const std::vector<Value>& values) {
    if (values.empty()) throw std::invalid_argument("no " + what + " given");
}

void checkNames(const std::string& what, const std::vector<std::string>& names,
                const std::vector<std::string>& known, const std::string& list) {
    checkGiven(what, names);
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        throw std::invalid_argument("unknown " + what + " '" + name + "'; known: " + list);
    }
}

void checkPositive(const std::string& what, const std::vector<double>& values) {
    checkGiven(what, values);
    for (const double value : values) {
        if (!(value > 0 && value <= 100)) {
            throw std::invalid_argument("a " + what + " must be above 0 and at most 100");
        }
    }
}

/// Rejects models with motion for sectors, which have no obstacle numbers.
void checkUpdates(const CampaignPlan& plan) {
    checkGiven("update", plan.updates);
    if (std::count(plan.updates.begin(), plan.updates.end(), Updates::Sectors) == 0) return;
    for (const std::string& model : plan.models) {
        if (!predictsMotion(model) || needsTruth(model)) continue;
        throw std::invalid_argument("the world model '" + model +
                                    "' tracks the obstacles of whole scans and does not support "
                                    "sectors; fly it with --updates scans");
    }
}

constexpr double kMinSpeed_m_s = 0.1;

void checkNumberOfFlights(const CampaignPlan& plan) {
    double flights = static_cast<double>(plan.last_seed - plan.first_seed) + 1;
    for (const std::size_t values :
         {plan.scenarios.size(), plan.speeds_m_s.size(), plan.models.size(), plan.guidances.size(),
          plan.planners.size(), plan.pose_errors.size(), plan.latency_scales.size(),
          plan.airs.size(), plan.distances.size(), plan.updates.size()}) {
        flights *= static_cast<double>(values);
    }
    if (flights <= kMaxFlights) return;
    throw std::invalid_argument("the plan has more than " + std::to_string(kMaxFlights) +
                                " flights; split it over several folders");
}

void check(const CampaignPlan& plan, const Shard& shard) {
    checkNames("scenario", plan.scenarios, courseNames(), base::joined(courseNames()));
    checkNames("world model", plan.models, worldModelNames(), worldModelList());
    checkNames("guidance", plan.guidances, guidanceNames(), base::joined(guidanceNames()));
    checkNames("planner", plan.planners, plannerNames(), base::joined(plannerNames()));
    checkPositive("speed", plan.speeds_m_s);
    for (const double speed_m_s : plan.speeds_m_s) {
        if (speed_m_s < kMinSpeed_m_s) {  // a flight would not end
            throw std::invalid_argument("a speed must be at least 0.1 m/s");
        }
    }
    checkPositive("latency scale", plan.latency_scales);
    checkGiven("air", plan.airs);
    checkGiven("distance", plan.distances);
    checkUpdates(plan);
    checkGiven("pose error", plan.pose_errors);
    if (plan.last_seed < plan.first_seed) {
        throw std::invalid_argument("the last seed must not be less than the first");
    }
    checkNumberOfFlights(plan);
    if (shard.of < 1 || shard.number < 1 || shard.number > shard.of) {
        throw std::invalid_argument("a shard must be i/n with i from 1 to n");
    }
}

/// Combines each setup with each value.
template <class Value, class Field>
std::vector<TrialSetup> withEach(const std::vector<TrialSetup>& setups,
                                 const std::vector<Value>& values, Field field) {
    std::vector<TrialSetup> all;
    for (const TrialSetup& setup : setups) {
        for (const Value& value : values) {
            all.push_back(setup);
            all.back().*field = value;
        }
    }
    return all;
}

/// All setups of a plan; the last list varies fastest.
std::vector<TrialSetup> setupsOf(const CampaignPlan& plan) {
    std::vector<TrialSetup> setups(1);
    setups[0].brakes_in_known_space = plan.brakes_in_known_space;
    setups = withEach(setups, plan.speeds_m_s, &TrialSetup::speed_m_s);
    setups = withEach(setups, plan.airs, &TrialSetup::air);
    setups = withEach(setups, plan.distances, &TrialSetup::distance);
    setups = withEach(setups, plan.updates, &TrialSetup::updates);
    setups = withEach(setups, plan.latency_scales, &TrialSetup::latency_scale);
    setups = withEach(setups, plan.pose_errors, &TrialSetup::pose_error);
    setups = withEach(setups, plan.planners, &TrialSetup::planner);
    setups = withEach(setups, plan.guidances, &TrialSetup::guidance);
    return withEach(setups, plan.models, &TrialSetup::model);
}

}  // namespace

std::vector<CourseFlights> flightsOf(const CampaignPlan& plan, const Shard& shard) {
    check(plan, shard);
    const std::vector<TrialSetup> setups = setupsOf(plan);
    std::vector<CourseFlights> flights;
    int course = 0;
    for (std::uint64_t i = 0; i <= plan.last_seed - plan.first_seed; ++i) {
        for (const std::string& scenario : plan.scenarios) {
            if (course++ % shard.of != shard.number - 1) continue;
            flights.push_back({scenario, plan.first_seed + i, setups});
        }
    }
    return flights;
}

void checkProfile(const LatencyProfile& profile, const std::vector<CourseFlights>& flights) {
    if (flights.empty()) return;
    for (const TrialSetup& setup : flights.front().setups) {
        for (const std::string& stage : stagesOf(setup)) profile.median_ms(stage);
    }
}

}  // namespace hagen::avoidance
