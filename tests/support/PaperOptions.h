#pragma once
#include <hagen/filter/Options.h>

namespace hagen::test {

/// The filter as described in the paper: only its stages, without returns beyond the zone.
inline Options paperOptions() {
    Options options;
    options.context_m = options.zone_m;
    options.repair_max_step_m = 0.0f;
    options.seed_gate_deg = 90.0f;
    options.level_by_attitude = false;
    options.bridge_dead_beams = false;
    options.ground_surface = false;
    return options;
}

/// These options, with numbered obstacles.
inline Options numbered(Options options) {
    options.number_obstacles = true;
    return options;
}

}  // namespace hagen::test
