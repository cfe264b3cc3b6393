#include <gmock/gmock.h>
#include <hagen/settings/Presets.h>
#include <hagen/settings/Settings.h>

#include <cstdlib>

#include "support/Program.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Tests run in a build, which uses the presets of the source folder.
const fs::path kSources = fs::path(HAGEN_SOURCE_DIR) / "config";

class PresetsTest : public testing::Test {
 protected:
    PresetsTest() : before_(fs::current_path()) { fs::current_path(folder_.path()); }
    ~PresetsTest() override {
        fs::current_path(before_);
        if (variable_) setenv("HAGEN_CONFIG_PATH", variable_->c_str(), 1);
        if (!variable_) unsetenv("HAGEN_CONFIG_PATH");
    }
    void search(const std::string& folders) { setenv("HAGEN_CONFIG_PATH", folders.c_str(), 1); }
    static float zoneOf(const fs::path& file) {
        Settings settings;
        mergeSettings(file, settings);
        return settings.options.zone_m;
    }
    test::TemporaryFolder folder_;

 private:
    static std::optional<std::string> variable() {
        const char* const value = std::getenv("HAGEN_CONFIG_PATH");
        return value == nullptr ? std::nullopt : std::optional<std::string>(value);
    }
    fs::path before_;
    std::optional<std::string> variable_ = variable();
};

TEST_F(PresetsTest, BuildFindsSourcePresets) {
    for (const char* name : {"vlp16", "hdl32e", "paper", "common"}) {
        const fs::path file = presetFile(name);
        EXPECT_TRUE(fs::equivalent(file, kSources / (std::string(name) + ".yaml"))) << file;
    }
    EXPECT_TRUE(fs::equivalent(presetFile("vlp16.yaml"), kSources / "vlp16.yaml"));
}

TEST_F(PresetsTest, AddedFoldersRankBetweenUserAndInstalled) {
    folder_.write("library/vlp16.yaml", "zone_m: 11");
    folder_.write("library/drone.yaml", "zone_m: 12");
    folder_.write("user/drone.yaml", "zone_m: 13");
    // The variable remains set in this process, but its folder is removed after this test.
    addPresetFolder(folder_ / "library");
    EXPECT_EQ(zoneOf(presetFile("vlp16")), 11);
    EXPECT_EQ(zoneOf(presetFile("drone")), 12);
    search((folder_ / "user").string());
    EXPECT_EQ(zoneOf(presetFile("drone")), 13);
}

TEST_F(PresetsTest, EarlierFolderHidesLater) {
    folder_.write("a/vlp16.yaml", "zone_m: 11");
    folder_.write("b/vlp16.yaml", "zone_m: 12");
    folder_.write("b/drone.yaml", "zone_m: 13");
    search((folder_ / "none").string() + "::" + (folder_ / "a").string() + ":" +
           (folder_ / "b").string());
    EXPECT_EQ(zoneOf(presetFile("vlp16")), 11);
    EXPECT_EQ(zoneOf(presetFile("drone")), 13);
    EXPECT_TRUE(fs::equivalent(presetFile("hdl32e"), kSources / "hdl32e.yaml"));
    EXPECT_THAT(presetNames(isSettingsFile), Contains("drone"));
}

TEST_F(PresetsTest, ExistingFileWins) {
    folder_.write("vlp16", "zone_m: 14");
    EXPECT_EQ(zoneOf(presetFile("vlp16")), 14);
    folder_.write("mine.yaml", "zone_m: 15");
    EXPECT_EQ(zoneOf(presetFile("mine.yaml")), 15);
    EXPECT_EQ(zoneOf(presetFile((folder_ / "mine.yaml").string())), 15);
    // A folder with the preset's name, e.g. an earlier output, does not hide the preset.
    fs::create_directory(folder_ / "hdl32e");
    EXPECT_TRUE(fs::equivalent(presetFile("hdl32e"), kSources / "hdl32e.yaml"));
}

TEST_F(PresetsTest, UserSettingsIncludePresets) {
    Settings settings;
    mergeSettings(folder_.write("drone.yaml", "include: hdl32e\nzone_m: 9"), settings);
    EXPECT_EQ(settings.sensor.model, "HDL-32E");
    EXPECT_EQ(settings.options.zone_m, 9);
    // A file next to the settings takes precedence.
    folder_.write("vlp16.yaml", "zone_m: 8");
    EXPECT_EQ(zoneOf(folder_.write("b.yaml", "include: [vlp16.yaml]")), 8);
    const fs::path wrong = folder_.write("c.yaml", "zone_m: 9\ninclude: hdl32");
    EXPECT_THAT(test::messageOf([&] { mergeSettings(wrong, settings); }),
                AllOf(HasSubstr("c.yaml:2: includes "), HasSubstr("preset")));
}

TEST_F(PresetsTest, EveryListedPresetIsReadable) {
    const std::vector<std::string> names = presetNames(isSettingsFile);
    EXPECT_THAT(names, AllOf(Contains("vlp16"), Contains("mid360"), Contains("airframe_simulated"),
                             Not(Contains("semantic_kitti")), Not(Contains("camera_forward"))));
    for (const std::string& name : names) EXPECT_TRUE(isSettingsFile(presetFile(name))) << name;
}

TEST_F(PresetsTest, UnknownNameListsPresetsAndFolders) {
    folder_.write("a/drone.yaml", "zone_m: 13");
    search((folder_ / "a").string() + ":" + (folder_ / "none").string());
    const auto message = test::messageOf([] { presetFile("vlp61"); });
    EXPECT_THAT(message, AllOf(HasSubstr("vlp61: no such file or preset; did you mean 'vlp16'?"),
                               HasSubstr("drone"), HasSubstr("hdl64e"), HasSubstr("paper"),
                               HasSubstr((folder_ / "a").string() + ","),
                               HasSubstr((folder_ / "none").string() + " (no such folder)"),
                               HasSubstr("share/hagen/config"), HasSubstr("HAGEN_CONFIG_PATH"),
                               Not(HasSubstr("camera_forward"))));
    EXPECT_THROW(presetFile("vlp61"), SettingsError);
}

TEST_F(PresetsTest, PathIsNotPreset) {
    EXPECT_THAT(test::messageOf([] { presetFile("conf/drone.yaml"); }),
                HasSubstr("conf/drone.yaml: no such file"));
    // The path is from a guide, but used in another folder.
    EXPECT_THAT(test::messageOf([] { presetFile("config/hdl64e.yaml"); }),
                HasSubstr("config/hdl64e.yaml: no such file; the preset's name is 'hdl64e'"));
    EXPECT_THROW(presetFile("../config/vlp16"), SettingsError);
    EXPECT_THROW(presetFile(""), SettingsError);
    EXPECT_THROW(presetFile(".yaml"), SettingsError);
}

TEST_F(PresetsTest, BrokenPresetIsNotListed) {
    folder_.write("a/broken.yaml", "zone_m: [");
    fs::create_directories(folder_ / "a/folder.yaml");
    search((folder_ / "a").string());
    EXPECT_THAT(presetNames(isSettingsFile), Not(Contains("broken")));
    EXPECT_THROW(zoneOf(presetFile("broken")), SettingsError);
    EXPECT_THROW(presetFile("folder"), SettingsError);
}

}  // namespace
}  // namespace hagen
