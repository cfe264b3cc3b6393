#pragma once
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/LatencyProfile.h>
#include <hagen/avoidance/Trial.h>
#include <hagen/simulation/Random.h>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// Draws the latency of planning steps from the profile. Sectors are assumed to cost as much as a
/// whole scan: updates with a few sectors take less time, labelling about the same.
class TrialLatencies {
 public:
    TrialLatencies(const Course& course, const TrialSetup& setup, const LatencyProfile& profile);

    double draw_s();
    /// The latency that planners assume.
    double median_s() const;

 private:
    struct Stage {
        std::string name;
        simulation::Random random;
    };

    const LatencyProfile& profile_;
    double scale_;
    std::vector<Stage> stages_;
};

}  // namespace hagen::avoidance
