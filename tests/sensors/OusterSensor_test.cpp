#include "sensors/ouster/OusterSensor.h"
#include <gmock/gmock.h>
#include <hagen/scan/Angle.h>

#include <tuple>

#include "support/OusterPackets.h"
#include "support/Program.h"

namespace hagen::sensors {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class OusterSensorTest : public testing::Test {
 protected:
    OusterSensor read(const std::string& json) const {
        return readOusterSensor(folder_.write("sensor.json", json));
    }
    /// The error for metadata with `from` replaced.
    std::string messageWith(const std::string& from, const std::string& to) const {
        std::string json = test::ousterJson();
        const std::size_t at = json.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return test::messageOf([&] { read(json.replace(at, from.size(), to)); });
    }
    test::TemporaryFolder folder_;
};

TEST_F(OusterSensorTest, ReadsPacketHeader) {
    const auto headerOf = [&](const std::string& profile) {
        const OusterSensor sensor = read(test::ousterJson(profile));
        const std::string packet = test::packetsOf(sensor, test::randomFrame(sensor, 4321)).back();
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(packet.data());
        return std::tuple(isOfLidar(bytes, sensor), serialOf(bytes, sensor),
                          frameIdOf(bytes, sensor));
    };
    EXPECT_EQ(headerOf("RNG19_RFL8_SIG16_NIR16"), std::tuple(true, 992137000142u, 4321));
    EXPECT_EQ(headerOf("LEGACY"), std::tuple(true, 0u, 4321));  // packets without a serial number
}

TEST_F(OusterSensorTest, ReadsBeamsAndFormat) {
    const OusterSensor sensor = read(test::ousterJson());
    EXPECT_EQ(sensor.name, "OS-0-32-U1");
    EXPECT_EQ(sensor.serial, "992137000142");
    EXPECT_EQ(sensor.pixels, 4u);
    EXPECT_EQ(sensor.columns_per_frame, 64u);
    EXPECT_EQ(sensor.windowColumns(), 64u);
    EXPECT_EQ(sensor.packetBytes(), 16u * (12 + 4 * 12) + 64);
    EXPECT_THAT(sensor.row, ElementsAre(3, 2, 1, 0));  // pixels start at the top
    EXPECT_NEAR(sensor.azimuth_rad[0], radians(-3.0), 1e-12);
    EXPECT_NEAR(sensor.beam_origin_m, 0.02767, 1e-12);
    EXPECT_NEAR(sensor.lidar_to_sensor.translation().z(), 0.03618, 1e-12);
    EXPECT_EQ(sensor.model->rows(), 4);
    EXPECT_NEAR(sensor.model->elevations_rad[0], radians(-45.0), 1e-6);
    EXPECT_EQ(sensor.model->name, "OS-0-32-U1");
    EXPECT_EQ(sensor.model->min_range_m, 0.3f);
}

TEST_F(OusterSensorTest, PacketSizesMatchManual) {
    const auto bytesOf = [&](const std::string& profile, std::size_t pixels) {
        OusterSensor sensor = read(test::ousterJson(profile));
        sensor.pixels = pixels;
        return sensor.packetBytes();
    };
    EXPECT_EQ(bytesOf("LEGACY", 64), 12608u);
    EXPECT_EQ(bytesOf("LEGACY", 128), 24896u);
    EXPECT_EQ(bytesOf("RNG19_RFL8_SIG16_NIR16", 128), 24832u);
    EXPECT_EQ(bytesOf("RNG19_RFL8_SIG16_NIR16_DUAL", 128), 33024u);
    EXPECT_EQ(bytesOf("RNG15_RFL8_NIR8", 128), 8448u);
    // From the SDK: 32 bytes on each side of 16 columns of 12 bytes plus these bytes per pixel.
    EXPECT_EQ(bytesOf("RNG19_RFL8_SIG16_NIR16_ZONE16", 128), 64u + 16 * (12 + 128 * 12));
    EXPECT_EQ(bytesOf("RNG15_RFL8_WIN8", 128), 64u + 16 * (12 + 128 * 4));
    EXPECT_EQ(bytesOf("RNG15_RFL8_NIR8_ZONE16", 128), 64u + 16 * (12 + 128 * 8));
    EXPECT_EQ(bytesOf("RNG15_RFL8_NIR8_DUAL", 128), 64u + 16 * (12 + 128 * 8));
    EXPECT_EQ(bytesOf("FUSA_RNG15_RFL8_NIR8_DUAL", 128), 64u + 16 * (12 + 128 * 8));
    EXPECT_EQ(bytesOf("FIVE_WORD_PIXEL", 128), 64u + 16 * (12 + 128 * 20));
}

TEST_F(OusterSensorTest, HeaderFollowsMetadataOrProfile) {
    const auto withHeader = [&](const std::string& profile, const std::string& header) {
        std::string json = test::ousterJson(profile);
        json.insert(1, "\"header_type\": \"" + header + "\", ");
        return read(json);
    };
    EXPECT_FALSE(read(test::ousterJson("RNG15_RFL8_NIR8_DUAL")).has_fusa_header);
    EXPECT_TRUE(read(test::ousterJson("FUSA_RNG15_RFL8_NIR8_DUAL")).has_fusa_header);
    EXPECT_TRUE(withHeader("RNG15_RFL8_NIR8_DUAL", "FUSA").has_fusa_header);
    EXPECT_FALSE(withHeader("FUSA_RNG15_RFL8_NIR8_DUAL", "STANDARD").has_fusa_header);
    EXPECT_THAT(test::messageOf([&] { withHeader("RNG15_RFL8_NIR8", "NEW"); }),
                HasSubstr("'header_type' is 'NEW', not 'STANDARD' or 'FUSA'"));
}

TEST_F(OusterSensorTest, ReadsSectionedMetadata) {
    const OusterSensor sensor = read(R"({
        "sensor_info": {"prod_line": "OS-1-64", "prod_sn": "7"},
        "beam_intrinsics": {"beam_altitude_angles": [10, 0, -10], "beam_azimuth_angles": [0, 0, 0],
            "beam_to_lidar_transform": [1, 0, 0, 12.163, 0, 1, 0, 0, 0, 0, 1, 5, 0, 0, 0, 1]},
        "lidar_intrinsics": {"lidar_to_sensor_transform":
            [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 38.195, 0, 0, 0, 1]},
        "config_params": {"lidar_mode": "1024x10", "udp_profile_lidar": "RNG15_RFL8_NIR8"},
        "lidar_data_format": {"columns_per_frame": 1024, "columns_per_packet": 16,
            "pixels_per_column": 3, "column_window": [768, 255]}})");
    EXPECT_EQ(sensor.name, "OS-1-64");
    EXPECT_EQ(sensor.profile.name, "RNG15_RFL8_NIR8");
    EXPECT_NEAR(sensor.beam_origin_m, 0.012163, 1e-12);
    EXPECT_NEAR(sensor.beam_origin_up_m, 0.005, 1e-12);
    EXPECT_EQ(sensor.windowColumns(), 512u);  // the window wraps around
}

TEST_F(OusterSensorTest, ReadsMetadataWithoutFormat) {
    const OusterSensor sensor = read(R"({"prod_line": "OS-1-16", "lidar_mode": "2048x10",
        "beam_altitude_angles": [1, 0, -1], "beam_azimuth_angles": [0, 0, 0]})");
    EXPECT_EQ(sensor.profile.name, "LEGACY");
    EXPECT_EQ(sensor.columns_per_frame, 2048u);
    EXPECT_EQ(sensor.columns_per_packet, 16u);
    EXPECT_EQ(sensor.packetBytes(), 12608u);  // 64 pixels, whatever the number of beams
}

TEST_F(OusterSensorTest, FindsPixelsOfFewerBeams) {
    const auto withBeams = [&](const std::string& altitudes, const std::string& azimuths) {
        return read(R"({"lidar_mode": "1024x10", "data_format": {"columns_per_frame": 1024,
            "columns_per_packet": 16, "pixels_per_column": 8}, "beam_altitude_angles": [)" +
                    altitudes + R"(], "beam_azimuth_angles": [)" + azimuths + "]}");
    };
    for (const OusterSensor& sensor :
         {withBeams("0, 10, 0, 0, 0, -3, 0, -9", "0, -3, 0, 2, 0, -3, 0, -3"),
          withBeams("10, 0, -3, -9", "-3, 2, -3, -3")}) {
        EXPECT_THAT(sensor.beam_pixels, ElementsAre(1, 3, 5, 7));
        EXPECT_EQ(sensor.row[1], 3);
        EXPECT_EQ(sensor.row[7], 0);
        EXPECT_EQ(sensor.model->rows(), 4);
    }
}

TEST_F(OusterSensorTest, ReportsMissingOrWrongKeys) {
    EXPECT_THAT(test::messageOf([&] { readOusterSensor(folder_ / "none.json"); }),
                HasSubstr("none.json: cannot be read"));
    EXPECT_THAT(test::messageOf([&] { read(""); }), HasSubstr("sensor.json: not Ouster metadata"));
    EXPECT_THAT(test::messageOf([&] { read(""); }), HasSubstr("is empty"));
    EXPECT_THAT(test::messageOf([&] { read("{}"); }),
                HasSubstr("'beam_altitude_angles' is missing"));
    EXPECT_THAT(test::messageOf([&] { read("[1, 2]"); }),
                HasSubstr("is this file Ouster metadata"));
    EXPECT_THAT(test::messageOf([&] { read(std::string(2000000, ' ')); }),
                HasSubstr("larger than 1 M"));
    EXPECT_THAT(test::messageOf([&] { read(std::string(500000, '[')); }),
                HasSubstr("nested too deeply"));
    EXPECT_THAT(test::messageOf([&] {
                    read("{\"a\": \"" + std::string(340000, ']') +
                         "\", \"b\": " + std::string(340000, '[') + std::string(300000, ']') + "}");
                }),
                HasSubstr("nested too deeply"));
    const std::string unknown = messageWith("\"RNG19_RFL8_SIG16_NIR16\"", "\"SIX_WORD_PIXEL\"");
    EXPECT_THAT(unknown, HasSubstr("'SIX_WORD_PIXEL', which is not supported; known: LEGACY"));
    EXPECT_THAT(unknown, HasSubstr("FIVE_WORD_PIXEL. Set one of these in the sensor's"));
    EXPECT_THAT(messageWith("\"pixels_per_column\": 4", "\"pixels_per_column\": 5"),
                HasSubstr("'beam_altitude_angles' has 4 numbers, not 5"));
    EXPECT_THAT(messageWith("\"pixels_per_column\": 4", "\"pixels_per_column\": 4000000000"),
                HasSubstr("'pixels_per_column' is 4000000000, not 3 ... 256"));
    EXPECT_THAT(messageWith("\"columns_per_frame\": 64", "\"columns_per_frame\": 1e9"),
                HasSubstr("sensor.json: not Ouster metadata"));
    EXPECT_THAT(messageWith("\"columns_per_packet\": 16", "\"columns_per_packet\": 0"),
                HasSubstr("'columns_per_packet' is 0"));
    EXPECT_THAT(messageWith("\"columns_per_frame\": 64", "\"columns_per_frame\": 8"),
                HasSubstr("'columns_per_packet' is 16, not 1 ... 8"));
    EXPECT_THAT(messageWith("[0, 63]", "[0, 64]"), HasSubstr("'column_window'"));
    EXPECT_THAT(messageWith("[40.0, 15.0", "[40.0, 40.0"), HasSubstr("beam_altitude_angles"));
    for (const char* other :
         {"[1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 36", "[1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36"}) {
        EXPECT_THAT(messageWith("[-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36", other),
                    HasSubstr("'lidar_to_sensor_transform' rotates about other axes than z"));
    }
    EXPECT_THAT(messageWith("[40.0", "[\"up\""),
                HasSubstr("sensor.json: not Ouster metadata: 'beam_altitude_angles': "));
    EXPECT_THAT(messageWith("\"OS-0-32-U1\"", "7"), HasSubstr("'prod_line': "));
    EXPECT_THAT(messageWith("\"pixels_per_column\": 4", "\"pixels_per_column\": 4.5"),
                HasSubstr("'pixels_per_column' is 4.5, not 3 ... 256"));
    EXPECT_THAT(messageWith("27.67", "\"far\""), HasSubstr("'lidar_origin_to_beam_origin_mm': "));
    EXPECT_THAT(messageWith("\"prod_sn\"", "prod_sn"),
                HasSubstr("sensor.json: not Ouster metadata: is not valid JSON: "
                          "parse error at line 1, column 29: "));
    EXPECT_THAT(test::messageOf([&] { read("\xff\xd8\xff\xe0"); }),
                HasSubstr("not Ouster metadata: it seems to be a JPEG picture"));
    EXPECT_THAT(messageWith("[40.0", "[140.0"), HasSubstr("outside +-90"));
    EXPECT_THAT(messageWith("[-1, 0, 0, 0,", "[-2, 0, 0, 0,"), HasSubstr("not a rigid"));
    EXPECT_THAT(messageWith("27.67", "1e300"), HasSubstr("exceeds 1 m"));
}

TEST_F(OusterSensorTest, RejectsTruncatedMetadata) {
    const std::string json = test::ousterJson();
    for (std::size_t size = 0; size < json.size(); size += 7) {
        EXPECT_NE(test::messageOf([&] { read(json.substr(0, size)); }), "") << size;
    }
}

}  // namespace
}  // namespace hagen::sensors
