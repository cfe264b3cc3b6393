#pragma once
#include <hagen/avoidance/LatencyProfile.h>
#include <hagen/avoidance/Trial.h>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// Limit for a plan, and for all plans of a folder, because they are listed in memory.
constexpr int kMaxFlights = 1'000'000;

/// The flights of a campaign: every combination of the lists' entries.
struct CampaignPlan {
    std::vector<std::string> scenarios;
    std::uint64_t first_seed = 0, last_seed = 0;  ///< inclusive
    std::vector<double> speeds_m_s{4};
    std::vector<std::string> models{"W-RoI"}, guidances{"astar"}, planners{"primitives"};
    std::vector<PoseError> pose_errors{PoseError::None};
    std::vector<double> latency_scales{1};
    bool brakes_in_known_space = false;
    std::vector<Air> airs{Air::Dusty};
    std::vector<ModelDistance> distances{ModelDistance::Unbiased};
    std::vector<Updates> updates{Updates::Scans};
};

/// Part `number` of `of` parts, counted from 1: every `of`-th course.
struct Shard {
    int number = 1, of = 1;
};

/// All flights through one course, which is generated only once.
struct CourseFlights {
    std::string scenario;
    std::uint64_t seed;
    std::vector<TrialSetup> setups;
};

/// The flights of a plan, ordered by seed, so that an interrupted campaign covers every scenario.
/// Throws std::invalid_argument for unknown names (listing known names), an empty list, a last
/// seed before the first, a speed or latency scale outside (0, 100], an invalid shard, more than
/// kMaxFlights, and models with motion combined with sectors, because they track the obstacles of
/// whole scans.
std::vector<CourseFlights> flightsOf(const CampaignPlan& plan, const Shard& shard = {});

/// Throws std::runtime_error naming a stage that these flights need and the profile lacks.
void checkProfile(const LatencyProfile& profile, const std::vector<CourseFlights>& flights);

}  // namespace hagen::avoidance
