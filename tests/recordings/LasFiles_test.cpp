// Uses the npm package copc as an independent reader of LAS files.
#include <gmock/gmock.h>
#include "recordings/clouds/CloudFile.h"

#include <cmath>
#include <cstring>
#include <sstream>

#include "support/Program.h"
#include "support/Random.h"

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;

constexpr int kPoints = 40;

/// Point data record formats: bytes per point and offset of the GPS time (0: none).
struct Format {
    int number;
    std::size_t bytes, gps_time;
};
void PrintTo(const Format& format, std::ostream* out) { *out << format.number; }

/// A file of records that are random except for their times.
std::string randomLas(const Format& format, unsigned seed) {
    test::Random random(seed);
    const bool is_new = format.number >= 6;
    const std::size_t header_size = is_new ? 375 : 227, extra_bytes = 3;
    std::string las(header_size, '\0');
    const auto put = [&](std::size_t at, auto number) {
        std::memcpy(&las[at], &number, sizeof number);
    };
    las.replace(0, 4, "LASF");
    put(24, std::uint8_t{1});
    put(25, static_cast<std::uint8_t>(is_new ? 4 : 2));
    put(94, static_cast<std::uint16_t>(header_size));
    put(96, static_cast<std::uint32_t>(header_size));
    put(104, static_cast<std::uint8_t>(format.number));
    put(105, static_cast<std::uint16_t>(format.bytes + extra_bytes));
    put(107, static_cast<std::uint32_t>(is_new ? 0 : kPoints));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        put(131 + 8 * axis, 0.001);
        put(155 + 8 * axis, static_cast<double>(random.real(-1000, 1000)));
    }
    if (is_new) put(247, std::uint64_t{kPoints});
    for (int i = 0; i < kPoints; ++i) {
        const std::size_t record = las.size();
        for (std::size_t k = 0; k < format.bytes + extra_bytes; ++k) {
            las.push_back(static_cast<char>(random.whole(0, 255)));
        }
        if (format.gps_time > 0) put(record + format.gps_time, 1e5 + 0.25 * i);
    }
    return las;
}

class LasFiles : public testing::TestWithParam<Format> {};

TEST_P(LasFiles, AgreesWithIndependentReader) {
    const fs::path modules = test::dataFolder("HAGEN_NODE_MODULES");
    if (modules.empty()) GTEST_SKIP() << "HAGEN_NODE_MODULES is not a folder with copc";
    const test::TemporaryFolder folder;
    const fs::path file =
        folder.write("random.las", randomLas(GetParam(), static_cast<unsigned>(GetParam().number)));
    const auto read = test::run(
        "/usr/bin/env", {"-C", modules.string(), "node",
                         std::string(HAGEN_SOURCE_DIR) + "/tests/recordings/read_las.mjs", file});
    if (read.exit_code == 127 || read.exit_code == 77) {
        GTEST_SKIP() << "node or a package is missing: " << read.err;
    }
    ASSERT_EQ(read.exit_code, 0) << read.err;
    const observations::PointTable table = readCloud(file).table;
    ASSERT_EQ(table.points, static_cast<std::size_t>(kPoints));
    std::vector<std::vector<double>> columns;
    for (const char* const name :
         {"x", "y", "z", "intensity", "return_number", "number_of_returns", "scanner_channel",
          "classification", "user_data", "classification_flags", "scan_direction",
          "edge_of_flight_line", "scan_angle", "point_source_id", "gps_time", "red", "green",
          "blue", "nir"}) {
        const auto* const field = findField(table, {name});
        columns.push_back(field == nullptr ? std::vector<double>(table.points, 0)
                                           : columnOf(table, *field));
    }
    std::istringstream lines(read.out);
    for (std::size_t i = 0; i < table.points; ++i) {
        for (std::size_t k = 0; k < columns.size(); ++k) {
            double expected = NAN;
            ASSERT_TRUE(lines >> expected);
            EXPECT_NEAR(columns[k][i], expected, 1e-6 * std::abs(expected))
                << "point " << i << ", column " << k;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, LasFiles,
                         testing::Values(Format{0, 20, 0}, Format{1, 28, 20}, Format{2, 26, 0},
                                         Format{3, 34, 20}, Format{6, 30, 22}, Format{7, 36, 22},
                                         Format{8, 38, 22}),
                         [](const auto& format) {
                             return "Format" + std::to_string(format.param.number);
                         });

}  // namespace
}  // namespace hagen::recordings
