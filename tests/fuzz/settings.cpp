// YAML settings files, and files of learned airframe bins.
#include <hagen/settings/Settings.h>
#include "settings/AirframeFile.h"

#include "fuzz/Target.h"

namespace hagen::fuzz {
namespace {

void readSettings(std::string_view input) {
    const InputFile file(input, "input.yaml");
    mayRefuse([&] { readAirframeBins(file.path()); });
    Settings settings;
    // An include could name any file, so the text is read like settings of a recording.
    const bool is_read =
        mayRefuse([&] { mergeSettings(file.path(), settings, SettingsOrigin::Recording); });
    if (!is_read) return;
    mayRefuse([&] {
        const SensorModel sensor = settings.sensorModel();
        require(sensor.rows() >= 2 && sensor.rows() <= 256, "a sensor's rows");
    });
    // The written file round-trips.
    const std::string text = dumpSettings(settings);
    if (!settings.airframe.learned.empty()) return;  // bins may be in a file in another folder
    const InputFile copy(text, "copy.yaml");
    Settings again;
    const bool is_again =
        mayRefuse([&] { mergeSettings(copy.path(), again, SettingsOrigin::User); });
    require(is_again, "settings are refused that were written");
    require(dumpSettings(again) == text, "settings change by writing them");
}

Seeds settingsSeeds() {
    Seeds seeds;
    Settings settings;
    seeds.push_back(
        "zone_m: 20\ncolumns: 870\nseeds: lowest\ngrow_feet: true\n"
        "sensor:\n  model: HDL-32E\n  min_range_m: 0.5\n  mount_roll_deg: 180\n");
    seeds.push_back("sensor:\n  model: custom\n  elevations_deg: [-15, -5.5, 0, 7]\n");
    seeds.push_back("airframe:\n- box_m: [-0.3, 0.3, -0.3, 0.3, -0.3, 0]\n");
    seeds.push_back("bin_deg: 2\nbins:\n- [-180, -16, 0.531]\n- [90, 0, 1]\n");
    seeds.push_back("include: other.yaml\n");
    seeds.push_back("a: &a [1, 2]\nb: *a\n<<: *a\n");
    std::string keys;
    for (const auto& key : settingsKeys()) {
        if (!key.standard.empty()) keys += key.name + ": " + key.standard + "\n";
    }
    seeds.push_back(keys.substr(0, 2000));
    return seeds;
}

std::vector<std::string> words() {
    std::vector<std::string> words{
        "\n  ", "- ",  ": ", "[",    "]",    "{",    "}",    "&a ",  "*a", "!!int ",
        "|\n",  ">\n", "? ", "<<: ", ".nan", ".inf", "1e39", "0x7f", "~"};
    for (const auto& key : settingsKeys()) words.push_back(key.name + ": ");
    return words;
}

const bool kAdded = add({"settings", readSettings, settingsSeeds, words(), 2048});

}  // namespace
}  // namespace hagen::fuzz
