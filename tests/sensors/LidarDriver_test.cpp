#include <gmock/gmock.h>
#include <hagen/sensors/LidarDriver.h>

#include "support/Program.h"

namespace hagen::sensors {
namespace {

TEST(LidarDriver, RejectsUnsupportedSensors) {
    struct Choice {
        const char *model, *sensor_json, *calibration, *message;
    };
    for (const auto& [model, sensor_json, calibration, message] :
         {Choice{"OS1-64", "", "",
                 "Supported: VLP-16, Puck Hi-Res, HDL-32E, VLP-32C, VLS-128, HDL-64E, Mid-360, "
                 "XT32, XT16"},
          {"HDL-64E", "", "", "--calibration FILE"},
          {"VLP-16", "", "db.xml", "db.xml"},
          {"VLP-16", "os.json", "", "--model"},
          {"", "os.json", "db.xml", "db.xml"}}) {
        EXPECT_THAT(test::messageOf(
                        [&, m = model, s = sensor_json, c = calibration] { checkDriver(m, s, c); }),
                    testing::HasSubstr(message));
    }
    checkDriver("VLP-16");
    checkDriver("Mid-360");
}

}  // namespace
}  // namespace hagen::sensors
