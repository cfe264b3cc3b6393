#pragma once
#include <hagen/trials/Trial.h>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::trials {

/// What is to be flown: every combination of what the lists hold.
struct CampaignPlan {
    std::vector<std::string> scenarios;
    std::uint64_t first_seed = 0, last_seed = 0;  ///< both flown
    std::vector<double> speeds_m_s{4};
    std::vector<std::string> models{"W-RoI"}, guidances{"astar"}, planners{"primitives"};
    std::vector<PoseError> pose_errors{PoseError::None};
    std::vector<double> latency_scales{1};
    bool brakes_in_known_space = false;
};

/// Part `number` of `of`, from 1 on: every of-th course.
struct Shard {
    int number = 1, of = 1;
};

/// All flights through one course, which is made once for them.
struct CourseFlights {
    std::string scenario;
    std::uint64_t seed;
    std::vector<TrialSetup> setups;
};

/// The flights of a plan, courses seed by seed, so that a campaign that is stopped has some of
/// every scenario. Throws std::invalid_argument, naming the known ones, for unknown names, for no
/// seed, a speed or latency scale that is not more than 0, and a shard that is none.
std::vector<CourseFlights> flightsOf(const CampaignPlan& plan, const Shard& shard = {});

/// Throws std::runtime_error, naming it, where the profile has no stage that these flights need.
void checkProfile(const LatencyProfile& profile, const std::vector<CourseFlights>& flights);

}  // namespace hagen::trials
