#include <gtest/gtest.h>
#include <hagen/live/LidarStream.h>

#include <optional>

#include "support/OusterPackets.h"
#include "support/Program.h"

namespace hagen::live {
namespace {

TEST(LidarStream, LimitsRangesBySettings) {
    const test::TemporaryFolder folder;
    const auto json = folder.write("ouster.json", test::ousterJson());
    for (const char* model : {"VLP-16", "Mid-360", ""}) {
        const auto driver = [&] {
            const bool is_ouster = std::string(model).empty();
            return sensors::makeDriver(model, is_ouster ? json : std::filesystem::path());
        };
        const SensorModel usual = driver()->sensor();
        Settings settings;
        settings.options.columns = 64;
        settings.options.window_size = 2;
        settings.options.principal_components = 1;
        for (const std::optional<float>& min_m : {std::optional<float>(), {1.5f}}) {
            for (const std::optional<float>& max_m : {std::optional<float>(), {40.0f}}) {
                settings.sensor.min_range_m = min_m;
                settings.sensor.max_range_m = max_m;
                const LidarStream stream(driver(), settings, [](const LabelledSector&) {});
                const SensorModel& used = stream.segmenter().sensor();
                EXPECT_EQ(used.min_range_m, min_m.value_or(usual.min_range_m)) << model;
                EXPECT_EQ(used.max_range_m, max_m.value_or(usual.max_range_m)) << model;
            }
        }
    }
}

}  // namespace
}  // namespace hagen::live
