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
    if (const auto* whole = std::get_if<int Options::*>(&key.field)) {
        return std::to_string(options.*(*whole));
    }
    return shortest(options.*std::get<float Options::*>(key.field));
}

std::string rangeOf(const OptionKey& key) {
    if (std::holds_alternative<Seeds Options::*>(key.field)) return "lowest, top_and_nearest";
    return shortest(static_cast<float>(key.least)) + " ... " +
           shortest(static_cast<float>(key.most));
}

}  // namespace hagen
