#include <hagen/evaluation/Baselines.h>
#include "base/TextStream.h"
#include "evaluation/baselines/BaselineBogoslavskyi.h"
#include "evaluation/baselines/BaselineZermas.h"

namespace hagen::evaluation {
namespace {

Baseline zermas(const std::string& name, const ZermasOptions& options) {
    base::TextStream parameters;
    parameters << "N_segs " << options.segments << ", N_iter " << options.iterations << ", N_LPR "
               << options.lowest_points << ", Th_seeds " << options.seed_height_m << " m, Th_dist "
               << options.ground_distance_m << " m";
    return {name,
            "Zermas, Izzat, Papanikolopoulos, ICRA 2017",
            parameters.str(),
            [options](const Scan& scan, const SensorModel& sensor) {
                return zermasLabels(scan, sensor, options);
            },
            "Th_dist_m",
            [name, options](float limit) {
                ZermasOptions changed = options;
                changed.ground_distance_m = limit;
                return zermas(name, changed);
            }};
}

Baseline bogoslavskyi(const std::string& name, const BogoslavskyiOptions& options) {
    base::TextStream parameters;
    parameters << options.columns << " columns, repair " << options.repair_step_m << " m, window "
               << options.smoothing_window << ", start " << options.start_angle_deg
               << " deg, difference " << options.ground_difference_deg << " deg";
    return {name,
            "Bogoslavskyi, Stachniss, PFG 2017",
            parameters.str(),
            [options](const Scan& scan, const SensorModel& sensor) {
                return bogoslavskyiLabels(scan, sensor, options);
            },
            "difference_deg",
            [name, options](float limit) {
                BogoslavskyiOptions changed = options;
                changed.ground_difference_deg = limit;
                return bogoslavskyi(name, changed);
            }};
}

}  // namespace

std::vector<Baseline> baselines(float zone_m) {
    ZermasOptions zermas_published;
    zermas_published.zone_m = zone_m;
    ZermasOptions zermas_tuned = zermas_published;
    zermas_tuned.lowest_points = 200;
    zermas_tuned.seed_height_m = 1.0f;
    zermas_tuned.ground_distance_m = 0.25f;

    BogoslavskyiOptions bogoslavskyi_published;
    bogoslavskyi_published.zone_m = zone_m;
    BogoslavskyiOptions bogoslavskyi_tuned = bogoslavskyi_published;
    bogoslavskyi_tuned.smoothing_window = 1;
    bogoslavskyi_tuned.ground_difference_deg = 7.5f;

    return {zermas("zermas", zermas_published), zermas("zermas tuned", zermas_tuned),
            bogoslavskyi("bogoslavskyi", bogoslavskyi_published),
            bogoslavskyi("bogoslavskyi tuned", bogoslavskyi_tuned)};
}

}  // namespace hagen::evaluation
