#include <gmock/gmock.h>
#include <hagen/scan/Angle.h>
#include <hagen/settings/Settings.h>
#include "base/Json.h"
#include "filter/OptionKeys.h"
#include "settings/AirframeFile.h"
#include "settings/SettingsJson.h"

#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

#include "support/Program.h"
#include "support/Random.h"

namespace hagen {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;
const fs::path kConfig = fs::path(HAGEN_SOURCE_DIR) / "config";

class SettingsTest : public testing::Test {
 protected:
    Settings settingsOf(const std::string& text) {
        Settings settings;
        mergeSettings(folder_.write("settings.yaml", text), settings);
        return settings;
    }
    /// The error message for a rejected file, which must not change the settings.
    std::string refusalOf(const std::string& text) {
        const fs::path file = folder_.write("refused.yaml", text);
        Settings settings;
        settings.options.beta_deg = 3.0f;
        try {
            mergeSettings(file, settings);
        } catch (const SettingsError& e) {
            EXPECT_EQ(settings.options.beta_deg, 3.0f);
            EXPECT_FALSE(settings.sensor.model);
            EXPECT_THAT(e.what(), HasSubstr("refused.yaml"));
            return e.what();
        }
        ADD_FAILURE() << "accepted: " << text;
        return "";
    }
    static bool says(const std::string& message, const std::string& words) {
        return message.find(words) != std::string::npos;
    }
    test::TemporaryFolder folder_;
};

TEST_F(SettingsTest, MergesSingleKeys) {
    Settings settings;
    mergeKey("zone_m=10", settings);
    mergeKey("paper.seeds=every", settings);
    mergeKey("sensor.model=OS1-64", settings);
    mergeKey("airframe=[sphere: {centre_m: [0, 0, 0], radius_m: 1}]", settings);
    EXPECT_EQ(settings.options.zone_m, 10.0f);
    EXPECT_EQ(settings.options.seeds, Seeds::Every);
    EXPECT_EQ(settings.sensor.model, "OS1-64");
    EXPECT_EQ(settings.airframe.parts.spheres.size(), 1u);
    for (const auto& [wrong, words] : std::map<std::string, std::string>{
             {"zone_n=1", "--set zone_n: unknown key 'zone_n'; did you mean 'zone_m'?"},
             {"zone_m=-1", "--set zone_m: zone_m is -1"},
             {"zone_m", "expected KEY=VALUE"},
             {"=1", "expected KEY=VALUE"},
             {"airframe=[", "--set airframe: "}}) {
        EXPECT_THAT(test::messageOf([&, key = wrong] { mergeKey(key, settings); }),
                    HasSubstr(words));
        EXPECT_EQ(settings.options.zone_m, 10.0f);
    }
}

TEST_F(SettingsTest, Vlp16PresetMatchesDefaults) {
    Settings preset;
    mergeSettings(kConfig / "vlp16.yaml", preset);
    const Options ours = preset.options, built_in;
    for (const OptionKey& key : optionKeys()) {
        std::visit([&](auto field) { EXPECT_EQ(ours.*field, built_in.*field) << key.name; },
                   key.field);
    }
    EXPECT_EQ(preset.sensorModel().elevations_rad, Settings().sensorModel().elevations_rad);
}

TEST_F(SettingsTest, PaperPresetHasOnlyPaperStages) {
    Settings paper;
    mergeSettings(kConfig / "paper.yaml", paper);
    EXPECT_EQ(paper.sensorModel().rows(), 16);
    EXPECT_EQ(paper.options.columns, 870);
    EXPECT_EQ(paper.options.window_size, 8);
    EXPECT_EQ(paper.options.principal_components, 5);
    EXPECT_EQ(paper.options.beta_deg, 10.0f);
    EXPECT_EQ(paper.options.repair_max_step_m, 0.0f);
    EXPECT_EQ(paper.options.context_m, 20.0f);
    EXPECT_EQ(paper.options.seeds, Seeds::Lowest);
    EXPECT_EQ(paper.options.seed_gate_deg, 90.0f);
    EXPECT_TRUE(paper.options.sharpen_by_neighbours);
    EXPECT_TRUE(paper.options.sharpen_proximity);
    EXPECT_TRUE(paper.options.angle_to_beam_above);
    EXPECT_FALSE(paper.options.gaps_are_level);
    EXPECT_FALSE(paper.options.level_by_attitude);
    EXPECT_FALSE(paper.options.ground_surface);
    EXPECT_FALSE(paper.options.raw_angles);
}

TEST_F(SettingsTest, FastPresetOnlySkipsStages) {
    Settings vlp16, fast;
    mergeSettings(kConfig / "vlp16.yaml", vlp16);
    mergeSettings(kConfig / "vlp16.yaml", fast);
    mergeSettings(kConfig / "fast.yaml", fast);
    vlp16.options.raw_angles = true;
    EXPECT_EQ(jsonOf(fast), jsonOf(vlp16));
}

TEST_F(SettingsTest, PresetsDifferOnlyWhereDocumented) {
    Settings vlp16;
    mergeSettings(kConfig / "vlp16.yaml", vlp16);
    for (const std::string file :
         {"hdl32e.yaml", "hdl64e.yaml", "vls128.yaml", "xt32.yaml", "xt16.yaml", "mid360.yaml",
          "avia.yaml", "hap.yaml", "ouster_os0_128.yaml", "ouster_os1_64.yaml", "common.yaml"}) {
        Settings preset;
        mergeSettings(kConfig / file, preset);
        for (const OptionKey& key : optionKeys()) {
            if (key.name == "columns" || key.name == "window_size" ||
                key.name == "principal_components") {
                continue;
            }
            const bool is_tolerance =
                key.name == "ground_tolerance_m" || key.name == "ground_tolerance_beside_tall";
            if (!preset.sensorModel().has_rings && is_tolerance) continue;  // docs/without-rings.md
            EXPECT_EQ(textOf(key, preset.options), textOf(key, vlp16.options)) << key.name;
            EXPECT_EQ(textOf(key, preset.options), textOf(key, Options())) << key.name;
        }
    }
}

TEST_F(SettingsTest, PresetsFitSensors) {
    for (const auto& [file, name, beams, columns] : {std::tuple{"vlp16.yaml", "VLP-16", 16, 870},
                                                     {"hdl32e.yaml", "HDL-32E", 32, 870},
                                                     {"hdl64e.yaml", "HDL-64E", 64, 870},
                                                     {"vls128.yaml", "VLS-128", 128, 870},
                                                     {"xt32.yaml", "XT32", 32, 870},
                                                     {"xt16.yaml", "XT16", 16, 870},
                                                     {"mid360.yaml", "Mid-360", 24, 360},
                                                     {"avia.yaml", "Avia", 40, 360},
                                                     {"hap.yaml", "HAP", 16, 360},
                                                     {"ouster_os0_128.yaml", "OS0-128", 128, 870},
                                                     {"ouster_os1_64.yaml", "OS1-64", 64, 870}}) {
        Settings preset;
        mergeSettings(kConfig / file, preset);
        EXPECT_EQ(preset.sensorModel().name, name);
        EXPECT_EQ(preset.sensorModel().rows(), beams);
        EXPECT_EQ(preset.options.columns, columns) << file;
        EXPECT_NO_THROW(checkOptions(preset.options, beams));
    }
}

TEST_F(SettingsTest, ReadsAndChecksEveryKey) {
    for (const OptionKey& key : optionKeys()) {
        if (key.name == "seeds" || std::holds_alternative<bool Options::*>(key.field)) continue;
        std::ostringstream min, below;
        min << key.name << ": " << key.min;
        below << key.name << ": " << key.min - 1;
        EXPECT_NO_THROW(settingsOf(min.str())) << key.name;
        EXPECT_TRUE(says(refusalOf(below.str()), "must lie between")) << key.name;
        refusalOf(key.name + ": soon");
        refusalOf(key.name + ": [1, 2]");
        refusalOf(key.name + ": .nan");
        if (std::isfinite(key.max)) refusalOf(key.name + ": 1000000000");
    }
}

TEST_F(SettingsTest, InfinityRoundTrips) {
    const Settings settings = settingsOf("context_m: .inf");
    EXPECT_THAT(dumpSettings(settings), HasSubstr("context_m: .inf "));
    EXPECT_EQ(settingsOf(dumpSettings(settings)).options.context_m, settings.options.context_m);
    const base::Json json = jsonOf(settings);
    EXPECT_EQ(json.at("context_m"), ".inf");
    EXPECT_EQ(json.at("zone_m"), 20);
    EXPECT_EQ(base::parseJson(json.dump()).at("context_m"), ".inf");
}

TEST_F(SettingsTest, SwitchesAcceptOnlyBooleans) {
    for (const OptionKey& key : optionKeys()) {
        if (!std::holds_alternative<bool Options::*>(key.field)) continue;
        for (const std::string word : {"true", "false"}) {
            EXPECT_EQ(textOf(key, settingsOf(key.name + ": " + word).options), word);
        }
        for (const std::string word : {"1", "yes", "[true]", "''"}) {
            EXPECT_TRUE(says(refusalOf(key.name + ": " + word), "'true' or 'false'")) << key.name;
        }
    }
}

TEST_F(SettingsTest, SeedsAcceptOnlyThreeWords) {
    EXPECT_EQ(settingsOf("seeds: top_and_nearest").options.seeds, Seeds::TopAndNearest);
    EXPECT_EQ(settingsOf("seeds: lowest").options.seeds, Seeds::Lowest);
    EXPECT_EQ(settingsOf("seeds: every").options.seeds, Seeds::Every);
    for (const OptionKey& key : optionKeys()) {
        if (key.name != "seeds") continue;
        for (const std::string word : {"lowest", "top_and_nearest", "every"}) {
            EXPECT_EQ(textOf(key, settingsOf("seeds: " + word).options), word);
        }
    }
    EXPECT_TRUE(says(refusalOf("seeds: highest"), "'highest'"));
}

TEST_F(SettingsTest, ReadsPaperSectionOrTopLevel) {
    EXPECT_EQ(settingsOf("paper: {seeds: every}").options.seeds, Seeds::Every);
    EXPECT_TRUE(settingsOf("paper: {seeds: every}").given.count("seeds"));
    EXPECT_TRUE(settingsOf("gaps_are_level: true").options.gaps_are_level);
    EXPECT_THAT(refusalOf("seeds: every\npaper:\n  seeds: every"),
                HasSubstr("refused.yaml:3: 'seeds' is both a top-level key and a key of 'paper'"));
    EXPECT_THAT(refusalOf("paper: {zone_m: 3}"), HasSubstr("(in 'paper')"));
    EXPECT_THAT(refusalOf("paper: 3"), HasSubstr("paper must contain keys"));
    Settings settings = settingsOf("paper: {seeds: every}");
    mergeSettings(folder_.write("later.yaml", "seeds: lowest"), settings);
    EXPECT_EQ(settings.options.seeds, Seeds::Lowest);
}

TEST_F(SettingsTest, LaterFilesOverrideEarlier) {
    Settings settings;
    mergeSettings(folder_.write("a.yaml", "beta_deg: 5\nzone_m: 15\n"), settings);
    mergeSettings(folder_.write("b.yaml", "beta_deg: 7.5\n"), settings);
    EXPECT_EQ(settings.options.beta_deg, 7.5f);
    EXPECT_EQ(settings.options.zone_m, 15.0f);
}

TEST_F(SettingsTest, IncludesComeFirst) {
    folder_.write("base.yaml", "beta_deg: 5\nzone_m: 15\n");
    const Settings settings = settingsOf("beta_deg: 6\ninclude: base.yaml\n");
    EXPECT_EQ(settings.options.beta_deg, 6.0f);
    EXPECT_EQ(settings.options.zone_m, 15.0f);
    folder_.write("more.yaml", "zone_m: 16\n");
    EXPECT_EQ(settingsOf("include: [base.yaml, more.yaml]").options.zone_m, 16.0f);
}

TEST_F(SettingsTest, RejectsMissingOrCircularInclude) {
    Settings settings;
    EXPECT_THROW(mergeSettings(folder_.write("a.yaml", "include: none.yaml"), settings),
                 SettingsError);
    const fs::path circle = folder_.write("circle.yaml", "include: circle.yaml");
    EXPECT_THROW(mergeSettings(circle, settings), SettingsError);
}

TEST_F(SettingsTest, RejectsInvalidIncludeNames) {
    for (const std::string& include : {std::string("[vlp16, [hdl32e]]"), std::string("[{}]"),
                                       std::string("\"vlp16\\0\""), std::string(5000, 'a')}) {
        EXPECT_TRUE(says(refusalOf("include: " + include),
                         "refused.yaml:1: an entry of 'include' is not a file name"))
            << include;
    }
    EXPECT_TRUE(says(refusalOf("include: " + std::string(300, 'a')), "no such file or preset"));
}

TEST_F(SettingsTest, SuggestsNearestKey) {
    const std::string message = refusalOf("zone_m: 20\nbeta_dge: 10\n");
    EXPECT_TRUE(says(message, "refused.yaml:2:")) << message;
    EXPECT_TRUE(says(message, "'beta_dge'")) << message;
    EXPECT_TRUE(says(message, "'beta_deg'")) << message;
    EXPECT_TRUE(says(refusalOf("sensor: {modle: VLP-16}"), "'model'"));
}

TEST_F(SettingsTest, RejectsDuplicateKeys) {
    EXPECT_TRUE(says(refusalOf("zone_m: 20\nzone_m: 21\n"), "twice"));
    EXPECT_TRUE(says(refusalOf("sensor: {model: VLP-16, model: HDL-32E}"), "'sensor.model'"));
}

TEST_F(SettingsTest, RejectsFractionsForWholeNumbers) {
    EXPECT_TRUE(says(refusalOf("window_size: 8.5"), "whole number"));
    EXPECT_TRUE(says(refusalOf("window_size: 8x"), "whole number"));
    EXPECT_EQ(settingsOf("window_size: 010").options.window_size, 10);  // decimal, not octal
}

TEST_F(SettingsTest, RejectsInvalidYaml) {
    EXPECT_TRUE(says(refusalOf("zone_m: [1"), "not YAML"));
    EXPECT_TRUE(says(refusalOf("- 1\n- 2\n"), "key: value"));
    EXPECT_TRUE(says(refusalOf("just words"), "key: value"));
    EXPECT_TRUE(says(refusalOf("zone_m: 20\n---\nzone: 30\n"), "several documents"));
    // yaml-cpp 0.7 would find infinitely many documents.
    EXPECT_THROW(settingsOf(","), SettingsError);
    EXPECT_THROW(settingsOf(std::string(",nclude: (\0\0\0\0\0\0\0\1", 18)), SettingsError);
    Settings settings;
    EXPECT_THROW(mergeSettings("/no/such/file.yaml", settings), SettingsError);
    EXPECT_THROW(mergeSettings(folder_.path(), settings), SettingsError);
}

TEST_F(SettingsTest, EmptyFileKeepsSettings) {
    EXPECT_NO_THROW(settingsOf(""));
    EXPECT_NO_THROW(settingsOf("# nothing but words\n"));
}

TEST_F(SettingsTest, CustomSensorHasOwnBeams) {
    const auto sensor = settingsOf(
                            "sensor: {model: custom, elevations_deg: [-5, 0, 2.5], "
                            "min_range_m: 1, max_range_m: 50}")
                            .sensorModel();
    ASSERT_EQ(sensor.rows(), 3);
    EXPECT_NEAR(degrees(sensor.elevations_rad[2]), 2.5, 1e-5);
    EXPECT_EQ(sensor.min_range_m, 1.0f);
    EXPECT_EQ(sensor.max_range_m, 50.0f);
}

TEST_F(SettingsTest, LaterModelReplacesEarlier) {
    Settings settings;
    mergeSettings(kConfig / "vlp16.yaml", settings);
    mergeSettings(folder_.write("a.yaml", "sensor: {model: custom, elevations_deg: [-1, 1]}"),
                  settings);
    EXPECT_EQ(settings.sensorModel().rows(), 2);
    mergeSettings(kConfig / "hdl32e.yaml", settings);
    EXPECT_EQ(settings.sensorModel().rows(), 32);
}

TEST_F(SettingsTest, RecoveredSensorReplacesModel) {
    Settings settings;
    mergeSettings(kConfig / "mid360.yaml", settings);
    mergeSettings(folder_.write("a.yaml", "sensor: {model: recovered, min_range_m: 2}"), settings);
    EXPECT_FALSE(settings.sensor.model);
    RecoveredBeams recovered{customSensorModel({-5, 0, 5}), 1.0f, {}, 300, {}, false};
    recovered.sensor.min_range_m = 0;
    recovered.sensor.max_range_m = 1000;
    EXPECT_EQ(settings.sensorModel(&recovered).rows(), 3);
    EXPECT_EQ(settings.sensorModel(&recovered).min_range_m, 2.0f);
    EXPECT_EQ(settings.sensorModel(&recovered).max_range_m, 1000.0f);
    settings.sensor.max_range_m = 1.0f;
    EXPECT_THROW(settings.sensorModel(&recovered), SettingsError);
    mergeSettings(kConfig / "hdl32e.yaml", settings);
    EXPECT_EQ(settings.sensorModel(&recovered).rows(), 32);
}

/// The columns, window size and components chosen for a sensor with this number of rows.
std::vector<int> fitted(const Settings& settings, int rows, int max_columns) {
    RecoveredBeams recovered;
    recovered.sensor.elevations_rad.assign(rows, 0.0f);
    recovered.max_columns = max_columns;
    const Options options = settings.optionsFor(&recovered);
    return {options.columns, options.window_size, options.principal_components};
}

TEST_F(SettingsTest, UnsetOptionsAdaptToRecoveredSensor) {
    const Settings none = settingsOf("zone_m: 10");
    EXPECT_EQ(fitted(none, 16, 1800), (std::vector{870, 8, 5}));  // like the presets
    EXPECT_EQ(fitted(none, 128, 512), (std::vector{512, 8, 5}));
    EXPECT_EQ(fitted(none, 8, 100), (std::vector{100, 4, 3}));
    EXPECT_EQ(fitted(none, 3, 0), (std::vector{8, 2, 1}));
    for (int rows = 3; rows <= 20; ++rows) {
        RecoveredBeams recovered;
        recovered.sensor.elevations_rad.assign(rows, 0.0f);
        EXPECT_NO_THROW(checkOptions(none.optionsFor(&recovered), rows)) << rows;
    }
}

TEST_F(SettingsTest, RecoveredSensorKeepsGivenOptions) {
    EXPECT_EQ(fitted(settingsOf("columns: 870"), 8, 100), (std::vector{870, 4, 3}));
    EXPECT_EQ(fitted(settingsOf("window_size: 8"), 8, 100), (std::vector{100, 8, 5}));
    EXPECT_EQ(fitted(settingsOf("{window_size: 6, principal_components: 5}"), 8, 100),
              (std::vector{100, 6, 5}));
    EXPECT_EQ(fitted(settingsOf("{columns: 870, sensor: {model: VLP-16}}"), 8, 100),
              (std::vector{870, 8, 5}));
    EXPECT_EQ(fitted(settingsOf("sensor: {model: VLP-16}"), 8, 100), (std::vector{870, 8, 5}));
    Settings settings;
    setOption("columns", "870", settings);
    EXPECT_EQ(fitted(settings, 16, 100)[0], 870);
    settings = Settings();
    settings.options.columns = 500;
    EXPECT_EQ(fitted(settings, 16, 100)[0], 500);
}

TEST_F(SettingsTest, RejectsInvalidSensors) {
    EXPECT_TRUE(says(refusalOf("sensor: {model: recover}"), "'recovered'"));
    EXPECT_TRUE(says(refusalOf("sensor: {model: recovered, elevations_deg: [1, 2]}"), "custom"));

    EXPECT_TRUE(says(refusalOf("sensor: {model: VLP-61}"), "VLP-61"));
    EXPECT_TRUE(says(refusalOf("sensor: VLP-16"), "sensor must contain keys"));
    EXPECT_TRUE(says(refusalOf("sensor: {elevations_deg: [1, 2]}"), "model: custom"));
    EXPECT_TRUE(says(refusalOf("sensor: {model: custom, elevations_deg: [2, 1]}"), "lowest"));
    EXPECT_TRUE(says(refusalOf("sensor: {model: custom, elevations_deg: 3}"), "list"));
    EXPECT_TRUE(says(refusalOf("sensor: {model: VLP-16, max_range_m: -1}"), "max_range_m"));
    EXPECT_THROW(settingsOf("sensor: {model: custom}").sensorModel(), SettingsError);
    EXPECT_THROW(settingsOf("sensor: {min_range_m: 50, max_range_m: 10}").sensorModel(),
                 SettingsError);
}

TEST_F(SettingsTest, ReadsMountInDegrees) {
    const Settings settings = settingsOf("sensor: {mount_roll_deg: 180, mount_pitch_deg: -30}");
    EXPECT_FLOAT_EQ(settings.mount.roll_rad, static_cast<float>(kPi));
    EXPECT_FLOAT_EQ(settings.mount.pitch_rad, static_cast<float>(-kPi / 6));
    EXPECT_EQ(settingsOf("").mount.roll_rad, 0.0f);
    EXPECT_EQ(settingsOf("").mount.pitch_rad, 0.0f);
    for (const std::string edge : {"mount_roll_deg: -180", "mount_pitch_deg: 90"}) {
        EXPECT_NO_THROW(settingsOf("sensor: {" + edge + "}")) << edge;
    }
    EXPECT_TRUE(says(refusalOf("sensor: {mount_roll_deg: 180.1}"), "-180 and 180"));
    EXPECT_TRUE(says(refusalOf("sensor: {mount_pitch_deg: -91}"), "-90 and 90"));
    EXPECT_TRUE(says(refusalOf("sensor: {mount_roll_deg: upside}"), "must be a number"));
    EXPECT_TRUE(says(refusalOf("mount_roll_deg: 180"), "unknown key"));
    EXPECT_TRUE(says(refusalOf("sensor: {mount_rol_deg: 1}"), "'mount_roll_deg'"));
}

TEST_F(SettingsTest, MountSurvivesModelChange) {
    Settings settings;
    mergeSettings(folder_.write("drone.yaml", "sensor: {mount_roll_deg: 180}"), settings);
    mergeSettings(kConfig / "mid360.yaml", settings);
    EXPECT_EQ(settings.sensorModel().name, "Mid-360");
    EXPECT_FLOAT_EQ(settings.mount.roll_rad, static_cast<float>(kPi));
    mergeSettings(folder_.write("upright.yaml", "sensor: {mount_roll_deg: 0}"), settings);
    EXPECT_EQ(settings.mount.roll_rad, 0.0f);
}

TEST_F(SettingsTest, ReadsAirframeParts) {
    const fs::path folder = folder_ / "drone";
    fs::create_directory(folder);
    folder_.write("drone/legs.yaml", "bin_deg: 10\nbins: [[-180, -20, 0.6], [170, 80, 1]]");
    folder_.write("drone/drone.yaml",
                  "airframe:\n"
                  "- box: {low_m: [-1, -0.5, 0], high_m: [1, 0.5, 0.25]}\n"
                  "- sphere: {centre_m: [0, 0, -0.3], radius_m: 0.2}\n"
                  "- learned: legs.yaml\n");
    const Settings settings = settingsOf("include: drone/drone.yaml");
    EXPECT_EQ(settings.files.back(), folder / "legs.yaml");  // so that no output overwrites it
    const auto& airframe = settings.airframe;
    ASSERT_EQ(airframe.parts.boxes.size(), 1u);
    EXPECT_EQ(airframe.parts.boxes[0].low_m, Eigen::Vector3f(-1, -0.5f, 0));
    EXPECT_EQ(airframe.parts.boxes[0].high_m, Eigen::Vector3f(1, 0.5f, 0.25f));
    ASSERT_EQ(airframe.parts.spheres.size(), 1u);
    EXPECT_EQ(airframe.parts.spheres[0].centre_m, Eigen::Vector3f(0, 0, -0.3f));
    EXPECT_EQ(airframe.parts.spheres[0].radius_m, 0.2f);
    ASSERT_EQ(airframe.parts.bin_range_m.rows(), 18);
    EXPECT_EQ(airframe.parts.bin_range_m(7, 0), 0.6f);
    EXPECT_EQ(airframe.parts.bin_range_m(17, 35), 1.0f);
    EXPECT_EQ((airframe.parts.bin_range_m > 0).count(), 2);
    EXPECT_EQ(airframe.learned, folder / "legs.yaml");
}

TEST_F(SettingsTest, LaterAirframeReplacesEarlier) {
    Settings settings;
    const auto a =
        folder_.write("a.yaml", "airframe: [sphere: {centre_m: [0, 0, 0], radius_m: 1}]");
    mergeSettings(a, settings);
    mergeSettings(folder_.write("b.yaml", "zone_m: 10"), settings);
    EXPECT_EQ(settings.airframe.parts.spheres.size(), 1u);
    mergeSettings(folder_.write("c.yaml", "airframe: []"), settings);
    EXPECT_TRUE(settings.airframe.parts.isEmpty());
    EXPECT_TRUE(settingsOf("").airframe.parts.isEmpty());
}

TEST_F(SettingsTest, RejectsInvalidAirframeParts) {
    const auto refused = [&](const std::string& part) {
        return refusalOf("zone_m: 20\nairframe:\n- " + part);
    };
    EXPECT_THAT(refusalOf("airframe: {box: 1}"), HasSubstr("must be a list"));
    EXPECT_THAT(refused("box"), HasSubstr("refused.yaml:3: each part of airframe must be one of"));
    EXPECT_THAT(refused("{box: 1, sphere: 2}"), HasSubstr("must be one of {box: "));
    EXPECT_THAT(refused("bx: {}"), HasSubstr("unknown key 'bx'; did you mean 'box'?"));
    EXPECT_THAT(refused("box: 3"), HasSubstr("airframe.box must contain low_m and high_m"));
    EXPECT_THAT(refused("box: {low_m: [0, 0, 0]}"), HasSubstr("low_m and high_m"));
    EXPECT_THAT(refused("box: {low_m: [0, 0, 0], hihg_m: [1, 1, 1]}"), HasSubstr("'high_m'"));
    EXPECT_THAT(refused("box: {low_m: [0, 0, 0], low_m: [0, 0, 0]}"), HasSubstr("once"));
    EXPECT_THAT(refused("box: {low_m: [0, 0], high_m: [1, 1, 1]}"), HasSubstr("[x, y, z]"));
    EXPECT_THAT(refused("box: {low_m: [0, 0, 2], high_m: [1, 1, 1]}"), HasSubstr("below"));
    EXPECT_THAT(refused("box: {low_m: [0, 0, 1], high_m: [1, 1, 1]}"), HasSubstr("below"));
    EXPECT_THAT(refused("box: {low_m: [0, 0, -21], high_m: [1, 1, 1]}"), HasSubstr("-20 and 20"));
    EXPECT_THAT(refused("box: {low_m: [0, 0, a], high_m: [1, 1, 1]}"), HasSubstr("a number"));
    EXPECT_THAT(refused("box: {low_m: [0, 0, .nan], high_m: [1, 1, 1]}"), HasSubstr("-20 and 20"));
    EXPECT_THAT(refused("sphere: {centre_m: [0, 0, 0], radius_m: 0}"), HasSubstr("positive"));
    EXPECT_THAT(refused("sphere: {centre_m: [0, 0, 0], radius_m: -1}"), HasSubstr("0 and 20"));
    EXPECT_THAT(refused("sphere: {centre_m: 1, radius_m: 1}"), HasSubstr("[x, y, z]"));
}

TEST_F(SettingsTest, RejectsInvalidLearnedAirframe) {
    const auto refused = [&](const std::string& learned) {
        folder_.write("learned.yaml", learned);
        return refusalOf("airframe: [learned: learned.yaml]");
    };
    EXPECT_THAT(refusalOf("airframe: [learned: none.yaml]"), HasSubstr("no such settings file"));
    EXPECT_THAT(refusalOf("airframe: [learned: [1]]"), HasSubstr("must be a file name"));
    EXPECT_THAT(refused("zone_m: 20"), HasSubstr("not a learned airframe"));
    EXPECT_THAT(refused("bin_deg: 2\nbins: []\nbin: 3"), HasSubstr("learned.yaml:3: unknown key"));
    EXPECT_THAT(refused("bin_deg: 7\nbins: []"), HasSubstr("divide 180"));
    EXPECT_THAT(refused("bin_deg: 0\nbins: []"), HasSubstr("0.5 and 30"));
    EXPECT_THAT(refused("bin_deg: 2\nbins: 3"), HasSubstr("a list"));
    EXPECT_THAT(refused("bin_deg: 2\nbins:\n- [0, 0]"), HasSubstr("learned.yaml:3: each of bins"));
    EXPECT_THAT(refused("bin_deg: 2\nbins: [[1, 0, 1]]"), HasSubstr("multiple of bin_deg (2)"));
    EXPECT_THAT(refused("bin_deg: 2\nbins: [[180, 0, 1]]"), HasSubstr("below 180"));
    EXPECT_THAT(refused("bin_deg: 2\nbins: [[0, 92, 1]]"), HasSubstr("-90 and 90"));
    EXPECT_THAT(refused("bin_deg: 2\nbins: [[0, 0, -1]]"), HasSubstr("0 and 20"));
    EXPECT_THAT(refused("bin_deg: 2\nbins: [[0, 0, 1], [0, 0, 1]]"), HasSubstr("twice"));
    folder_.write("learned.yaml", "bin_deg: 2\nbins: []");
    EXPECT_THAT(refusalOf("airframe: [learned: learned.yaml, learned: learned.yaml]"),
                HasSubstr("twice"));
}

TEST_F(SettingsTest, LearnedBinsRoundTrip) {
    test::Random random(4);
    for (const int rows : {6, 90, 360}) {
        Image<float> bins = random.image(rows, 2 * rows, 0.1f, 1.6f, 0.9);
        for (float& range_m : bins.reshaped()) range_m = hasValue(range_m) ? range_m : 0;
        const auto file = folder_.write("bins.yaml", airframeBinsText(bins, "a\nfile: {"));
        const Image<float> again = readAirframeBins(file);
        ASSERT_EQ(again.rows(), rows);
        EXPECT_LE((again - bins).abs().maxCoeff(), 0.0005001f);  // bins are stored in millimetres
        EXPECT_TRUE(((again > 0) == (bins > 0)).all());
    }
    const auto file = folder_.write("none.yaml", airframeBinsText(Image<float>::Zero(90, 180), ""));
    EXPECT_EQ((readAirframeBins(file) > 0).count(), 0);
}

TEST_F(SettingsTest, SimulatedAirframeIsReadable) {
    Settings settings;
    mergeSettings(kConfig / "airframe_simulated.yaml", settings);
    EXPECT_EQ(settings.airframe.parts.boxes.size(), 5u);
    EXPECT_EQ(settings.airframe.parts.spheres.size(), 1u);
}

TEST_F(SettingsTest, SetsOneOptionFromText) {
    Settings settings;
    setOption("beta_deg", "12.5", settings);
    setOption("paper.seeds", "every", settings);
    EXPECT_EQ(settings.options.seeds, Seeds::Every);
    setOption("seeds", "top_and_nearest", settings);
    EXPECT_EQ(settings.options.beta_deg, 12.5f);
    EXPECT_EQ(settings.options.seeds, Seeds::TopAndNearest);
    EXPECT_THROW(setOption("beta", "12.5", settings), SettingsError);
    EXPECT_THROW(setOption("beta_deg", "many", settings), SettingsError);
    EXPECT_THROW(setOption("beta_deg", "", settings), SettingsError);
    EXPECT_EQ(settings.options.beta_deg, 12.5f);
}

TEST(Settings, DumpRoundTrips) {
    const test::TemporaryFolder folder;
    Settings settings;
    settings.options.zone_m = 12.3456f;
    settings.options.seeds = Seeds::TopAndNearest;
    settings.options.window_size = 12;
    settings.sensor.model = "custom";
    settings.sensor.elevations_deg = {-7.25, 0.1, 3};
    settings.sensor.max_range_m = 33.3f;
    settings.mount = {static_cast<float>(radians(179.7)), static_cast<float>(radians(-12.345))};
    settings.airframe.parts.boxes = {{{-1.5f, 0.1f, -0.25f}, {1, 2, 3}}, {{0, 0, 0}, {1, 1, 1}}};
    settings.airframe.parts.spheres = {{{0.3f, -0.1f, 0}, 0.123f}};
    settings.airframe.learned = folder.write("it's #1.yaml", "bin_deg: 30\nbins: [[0, 0, 0.5]]");
    Settings again;
    mergeSettings(folder.write("dump.yaml", dumpSettings(settings)), again);
    for (const OptionKey& key : optionKeys()) {
        EXPECT_EQ(textOf(key, again.options), textOf(key, settings.options)) << key.name;
    }
    EXPECT_EQ(again.options.zone_m, 12.3456f);
    EXPECT_EQ(again.sensor.elevations_deg, settings.sensor.elevations_deg);
    EXPECT_EQ(again.sensor.max_range_m, settings.sensor.max_range_m);
    EXPECT_FALSE(again.sensor.min_range_m);
    EXPECT_EQ(again.mount.roll_rad, settings.mount.roll_rad);
    EXPECT_EQ(again.mount.pitch_rad, settings.mount.pitch_rad);
    ASSERT_EQ(again.airframe.parts.boxes.size(), 2u);
    EXPECT_EQ(again.airframe.parts.boxes[0].low_m, settings.airframe.parts.boxes[0].low_m);
    EXPECT_EQ(again.airframe.parts.boxes[1].high_m, settings.airframe.parts.boxes[1].high_m);
    ASSERT_EQ(again.airframe.parts.spheres.size(), 1u);
    EXPECT_EQ(again.airframe.parts.spheres[0].centre_m, Eigen::Vector3f(0.3f, -0.1f, 0));
    EXPECT_EQ(again.airframe.parts.spheres[0].radius_m, 0.123f);
    EXPECT_EQ(again.airframe.learned, settings.airframe.learned);
    EXPECT_EQ(again.airframe.parts.bin_range_m(3, 6), 0.5f);
    EXPECT_THAT(dumpSettings(settings), HasSubstr("mount_roll_deg: 179.7 "));
    EXPECT_THAT(dumpSettings(settings), HasSubstr("mount_pitch_deg: -12.345 "));
    mergeSettings(folder.write("none.yaml", dumpSettings(Settings())), again = Settings());
    EXPECT_FALSE(again.sensor.model);
    EXPECT_TRUE(again.given.count("zone_m"));
    EXPECT_FALSE(again.given.count("columns"));  // so that columns adapt to the sensor
    EXPECT_THAT(dumpSettings(Settings()), HasSubstr("model: recovered"));
    EXPECT_TRUE(again.airframe.parts.isEmpty());
}

TEST(Settings, DegreesRoundTripWithFewDecimals) {
    EXPECT_EQ(degreesText(0), "0");
    EXPECT_EQ(degreesText(static_cast<float>(kPi)), "180");
    test::Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const float angle_rad = random.real(-3.2f, 3.2f);
        const double read_deg = std::stod(degreesText(angle_rad));
        ASSERT_EQ(static_cast<float>(radians(read_deg)), angle_rad);
        const int tenths = static_cast<int>(random.real(-1800.0f, 1800.0f));
        const auto even_rad = static_cast<float>(radians(0.1 * tenths));
        ASSERT_LE(degreesText(even_rad).size(), 6u) << tenths;
    }
}

TEST(Settings, TableListsEveryKey) {
    const auto keys = settingsKeys();
    EXPECT_EQ(keys.size(), optionKeys().size() + 8);
    for (const SettingsKey& key : keys) EXPECT_FALSE(key.what.empty()) << key.name;
    EXPECT_EQ(keys[0].name, "zone_m");
    EXPECT_EQ(keys[0].standard, "20");
    EXPECT_EQ(keys[0].range, "0.1 ... 1000");
}

}  // namespace
}  // namespace hagen
