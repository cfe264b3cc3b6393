#include <hagen/segmentation/OptionKeys.h>
#include <charconv>
#include <limits>

namespace hagen {
namespace {

/// The shortest text that reads back as the same number.
std::string shortest(float value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return {text, end};
}

}  // namespace

const std::vector<OptionKey>& optionKeys() {
    static const std::vector<OptionKey> keys{
        {"zone_m", "m", 0.1, 1000, "radius of the avoidance zone; farther returns are ROU", "",
         &Options::zone_m},
        {"context_m", "m", 0.1, std::numeric_limits<double>::infinity(),
         "returns up to this range enter the image, as context; never less than zone_m", "",
         &Options::context_m},
        {"columns", "px", 8, 10000, "columns of the image in a full turn", "I_w",
         &Options::columns},
        {"repair_max_step_m", "m", 0, 1000,
         "fill one-pixel holes between vertical neighbours that differ by less; 0: none", "",
         &Options::repair_max_step_m},
        {"persistence_m", "m", 0, 1000, "least persistence of a maximum that is sharpened", "",
         &Options::persistence_m},
        {"sharpening_sigma_px", "px", 0.01, 100, "spatial Gaussian of the bilateral filter", "g_s",
         &Options::sharpening_sigma_px},
        {"sharpening_sigma_m", "m", 0.01, 100, "range Gaussian of the bilateral filter", "g_r",
         &Options::sharpening_sigma_m},
        {"window_size", "angles", 2, 64, "rows of the trajectory matrix", "W",
         &Options::window_size},
        {"principal_components", "", 1, 64, "leading components kept; as many as W: no smoothing",
         "PC", &Options::principal_components},
        {"beta_deg", "deg", 0, 90, "neighbours whose angles differ by less are one region", "beta",
         &Options::beta_deg},
        {"seeds", "", 0, 1,
         "lowest: ground seeds the ROU; top_and_nearest: the text's literal reading", "",
         &Options::seeds},
        {"seed_gate_deg", "deg", 0, 90,
         "a column's seed is ground only where its angle is less; 90: always", "",
         &Options::seed_gate_deg},
        {"level_by_attitude", "", 0, 1,
         "angles are about the horizon where the log tells the sensor's attitude", "",
         &Options::level_by_attitude},
        {"ground_surface", "", 0, 1,
         "judge all pixels again by their height above a surface fitted to the ROU", "",
         &Options::ground_surface},
        {"ground_tolerance_m", "m", 0, 10,
         "a return is RoI where it is higher above that surface than this", "",
         &Options::ground_tolerance_m},
        {"ground_tolerance_per_m", "m/m", 0, 1, "and so much more a metre of distance", "",
         &Options::ground_tolerance_per_m},
        {"ground_tolerance_beside_tall", "m/m", 0, 1,
         "and so much less a metre that what stands there is tall", "",
         &Options::ground_tolerance_beside_tall},
        {"canopy_layer", "", 0, 1,
         "a low layer that covers much of what is around is a crop's canopy: ROU", "",
         &Options::canopy_layer},
        {"grow_feet", "", 0, 1, "follow obstacles down to where they touch the surface", "",
         &Options::grow_feet},
        {"remove_specks", "", 0, 1, "a lone doubtful pixel follows its neighbours", "",
         &Options::remove_specks},
        {"ground_is_roi_below_m", "m", 0, 1000,
         "ground less than this below the sensor is RoI; 0: none", "",
         &Options::ground_is_roi_below_m},
        {"component_gap_m", "m", 0, 1000,
         "RoI pixels side by side are one obstacle where depths differ by less", "",
         &Options::component_gap_m},
        {"window_scans", "scans", 1, 100, "consecutive scans segmented together; needs poses", "K",
         &Options::window_scans}};
    return keys;
}

std::string textOf(const OptionKey& key, const Options& options) {
    if (const auto* seeds = std::get_if<Seeds Options::*>(&key.field)) {
        return options.*(*seeds) == Seeds::Lowest ? "lowest" : "top_and_nearest";
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
    if (std::holds_alternative<Seeds Options::*>(key.field)) return "lowest, top_and_nearest";
    if (std::holds_alternative<bool Options::*>(key.field)) return "true, false";
    return shortest(static_cast<float>(key.least)) + " ... " +
           shortest(static_cast<float>(key.most));
}

}  // namespace hagen
