#include "filter/OptionKeys.h"
#include <charconv>
#include <cmath>
#include <limits>

namespace hagen {
namespace {

/// The shortest text that parses to the same number.
std::string shortest(float value) {
    if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return {text, end};
}

using Ablations = std::vector<Ablation>;
Ablations off(StageGroup group, const char* value, const char* what) {
    return {{group, value, what}};
}
Ablations both(const Ablations& a, const Ablations& b) { return {a.front(), b.front()}; }

}  // namespace

const std::vector<OptionKey>& optionKeys() {
    static const std::vector<OptionKey> keys{
        {"zone_m", "m", 0.1, 1000, "radius of the avoidance zone; farther returns are ROU", "",
         &Options::zone_m, ""},
        {"context_m", "m", 0.1, std::numeric_limits<double>::infinity(),
         "maximum range of projected returns (zone and context); at least zone_m", "",
         &Options::context_m, "", off(StageGroup::Own, "zone", "no context beyond the zone")},
        {"window_scans", "scans", 1, 100,
         "scans of the sliding window, moved to the newest and concatenated; 1: each scan alone",
         "", &Options::window_scans, ""},
        {"window_fills_gaps", "", 0, 1,
         "older scans only fill pixels that the newest leaves empty; false: the closest return "
         "counts",
         "", &Options::window_fills_gaps, ""},
        {"label_window", "", 0, 1,
         "label the returns of all scans of the window, not of the newest only", "",
         &Options::label_window, ""},
        {"columns", "px", 8, 10000, "columns of the image per revolution", "I_w", &Options::columns,
         ""},
        {"repair_max_step_m", "m", 0, 1000,
         "fill one-pixel gaps between vertical neighbours that differ by less; 0: off", "",
         &Options::repair_max_step_m, "", off(StageGroup::Paper, "0", "no gap repair")},
        {"bridge_dead_beams", "", 0, 1, "fill the rows of dead beams", "",
         &Options::bridge_dead_beams, ""},
        {"persistence_m", "m", 0, 1000, "minimum persistence of a maximum to be sharpened", "",
         &Options::persistence_m, "",
         both(off(StageGroup::Paper, "0", "no persistence: all maxima sharpened"),
              off(StageGroup::Paper, "1000", "no sharpening: no maximum is kept"))},
        {"sharpening_sigma_px", "px", 0.01, 100, "spatial Gaussian of the bilateral filter", "g_s",
         &Options::sharpening_sigma_px, ""},
        {"sharpening_sigma_m", "m", 0.01, 100, "range Gaussian of the bilateral filter", "g_r",
         &Options::sharpening_sigma_m, ""},
        {"sharpen_by_neighbours", "", 0, 1,
         "add the mean of its neighbours to a maximum; false: of itself, as printed", "",
         &Options::sharpen_by_neighbours, "paper"},
        {"sharpen_proximity", "", 0, 1,
         "sharpen proximity (moves maxima nearer); false: depth (moves them away)", "",
         &Options::sharpen_proximity, "paper"},
        {"angle_to_beam_above", "", 0, 1,
         "a pixel gets the angle to the beam above it; false: to the beam below", "",
         &Options::angle_to_beam_above, "paper"},
        {"gaps_are_level", "", 0, 1,
         "angles to empty pixels are 0; false: no angle, regions do not cross gaps", "",
         &Options::gaps_are_level, "paper"},
        {"window_size", "angles", 2, 64, "rows of the trajectory matrix", "W",
         &Options::window_size, ""},
        {"principal_components", "", 1, 64, "leading components kept; equal to W: no smoothing",
         "PC", &Options::principal_components, "", off(StageGroup::Paper, "W", "no SSA: PC = W")},
        {"raw_angles", "", 0, 1,
         "skip sharpening and smoothing: angles are those of the repaired depth image", "",
         &Options::raw_angles, ""},
        {"beta_deg", "deg", 0, 90, "neighbours whose angles differ by less belong to one region",
         "beta", &Options::beta_deg, ""},
        {"seeds", "", 0, 2,
         "lowest: ground seeds ROU; top_and_nearest: RoI (literal); every: all ROU", "",
         &Options::seeds, "paper"},
        {"seed_gate_deg", "deg", 0, 90,
         "a column's seed is ground only if its angle is smaller; 90: always", "",
         &Options::seed_gate_deg, "", off(StageGroup::Own, "90", "no seed gate")},
        {"level_by_attitude", "", 0, 1,
         "gravity-aligned angles if the log contains the sensor's attitude", "",
         &Options::level_by_attitude, "", off(StageGroup::Own, "false", "no attitude")},
        {"ground_surface", "", 0, 1,
         "relabel all pixels by their height above a surface fitted to the ROU", "",
         &Options::ground_surface, "", off(StageGroup::Surface, "false", "no ground surface")},
        {"ground_evidence", "", 0, 1,
         "ROU only where level returns show that the surface is ground; otherwise RoI", "",
         &Options::ground_evidence, "",
         off(StageGroup::Surface, "false", "no evidence of ground needed")},
        {"ground_tolerance_m", "m", 0, 10, "returns higher than this above that surface are RoI",
         "", &Options::ground_tolerance_m, ""},
        {"ground_tolerance_per_m", "m/m", 0, 1, "plus this per metre of distance", "",
         &Options::ground_tolerance_per_m, ""},
        {"ground_tolerance_beside_tall", "m/m", 0, 1,
         "minus this per metre of obstacle height there", "",
         &Options::ground_tolerance_beside_tall, "",
         off(StageGroup::Surface, "0", "same tolerance next to tall obstacles")},
        {"canopy_layer", "", 0, 1,
         "treat a low layer covering most of the surroundings as crop canopy (ROU)", "",
         &Options::canopy_layer, "", off(StageGroup::Surface, "false", "no canopy layer")},
        {"grow_feet", "", 0, 1, "extend obstacles down to the ground surface", "",
         &Options::grow_feet, "",
         off(StageGroup::Surface, "false", "obstacles not extended to the ground")},
        {"remove_specks", "", 0, 1,
         "remove speckle: an uncertain isolated pixel takes its neighbours' label", "",
         &Options::remove_specks, "", off(StageGroup::Surface, "false", "no speckle filter")},
        {"ground_is_roi_below_m", "m", 0, 1000,
         "ground closer than this below the sensor is RoI; 0: off", "",
         &Options::ground_is_roi_below_m, ""},
        {"component_gap_m", "m", 0, 1000,
         "adjacent RoI pixels belong to one obstacle if their depths differ by less", "",
         &Options::component_gap_m, ""}};
    return keys;
}

std::string nameInFiles(const OptionKey& key) {
    return (key.section.empty() ? "" : key.section + ".") + key.name;
}

std::string textOf(const OptionKey& key, const Options& options) {
    if (const auto* seeds = std::get_if<Seeds Options::*>(&key.field)) {
        switch (options.*(*seeds)) {
            case Seeds::Lowest:
                return "lowest";
            case Seeds::TopAndNearest:
                return "top_and_nearest";
            case Seeds::Every:
                return "every";
        }
    }
    if (const auto* yes = std::get_if<bool Options::*>(&key.field)) {
        return options.*(*yes) ? "true" : "false";
    }
    if (const auto* whole = std::get_if<int Options::*>(&key.field)) {
        return std::to_string(options.*(*whole));
    }
    return shortest(options.*std::get<float Options::*>(key.field));
}

std::string rangeOf(const OptionKey& key) {
    if (std::holds_alternative<Seeds Options::*>(key.field))
        return "lowest, top_and_nearest, every";
    if (std::holds_alternative<bool Options::*>(key.field)) return "true, false";
    const bool is_open = std::isinf(key.max);
    return shortest(static_cast<float>(key.min)) + " ... " +
           (is_open ? "inf" : shortest(static_cast<float>(key.max)));
}

}  // namespace hagen
