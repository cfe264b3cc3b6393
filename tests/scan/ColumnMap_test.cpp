#include <gmock/gmock.h>
#include <hagen/scan/ColumnMap.h>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>

namespace hagen {
namespace {

using testing::ElementsAre;

TEST(ColumnMap, WindowKeepsItsColumns) {
    ColumnMap map;
    mapColumns(16, 4, 1, 1, map);  // columns 4 to 7; column 12 is opposite
    EXPECT_THAT(map.to_turn, ElementsAre(12, 0, 4, 5, 6, 7, 8));
    EXPECT_THAT(map.to_image, ElementsAre(1, 1, 1, 1, 2, 3, 4, 5, 6, 6, 6, 6, 0, 0, 0, 0));
    EXPECT_THAT(map.even, ElementsAre(0, 1, 2, 6));
    EXPECT_EQ(map.columns(), 16);
}

TEST(ColumnMap, WindowAtSeamIsContiguous) {
    ColumnMap map;
    mapColumns(16, 4, 3, 2, map);  // columns 12 to 15, then 0 to 3
    EXPECT_THAT(map.to_turn, ElementsAre(8, 12, 13, 14, 15, 0, 1, 2, 3, 4));
}

/// For any window, the image has the same size, each column of the turn is mapped, groups have
/// different first columns, and neighbours stay in order.
TEST(ColumnMap, EveryColumnMapsToItsGroup) {
    for (const int columns : {870, 1024, 19}) {
        for (const int group : {1, 2, 3, 4, 6}) {
            const int groups = (columns + group - 1) / group;
            for (const int count : {0, 1, groups / 3, groups}) {
                for (int first = 0; first < groups; ++first) {
                    ColumnMap map;
                    mapColumns(columns, group, first, count, map);
                    ASSERT_EQ(map.to_turn.size(),
                              static_cast<std::size_t>(groups + (group - 1) * count));
                    ASSERT_EQ(map.even.size(), static_cast<std::size_t>(groups));
                    std::map<int, std::set<int>> groups_of_image;
                    for (int c = 0; c < columns; ++c) {
                        const int at = map.to_image[c];
                        ASSERT_GE(at, 0);
                        ASSERT_LT(at, static_cast<int>(map.to_turn.size()));
                        groups_of_image[at].insert(c / group);
                        const int g = c / group;
                        const bool is_in_window = (g < first ? g + groups : g) - first < count;
                        if (is_in_window || c % group == 0) {
                            ASSERT_EQ(map.to_turn[at], c);
                        }
                    }
                    for (const auto& [at, of] : groups_of_image) ASSERT_EQ(of.size(), 1u) << at;
                }
            }
        }
    }
}

TEST(ColumnMap, RejectsInvalidWindows) {
    ColumnMap map;
    EXPECT_THROW(mapColumns(0, 4, 0, 0, map), std::invalid_argument);
    EXPECT_THROW(mapColumns(16, 0, 0, 1, map), std::invalid_argument);
    EXPECT_THROW(mapColumns(16, 4, 4, 1, map), std::invalid_argument);
    EXPECT_THROW(mapColumns(16, 4, 0, 5, map), std::invalid_argument);
    EXPECT_THROW(mapColumns(16, 4, -1, 1, map), std::invalid_argument);
}

TEST(ColumnMap, DirectionsMatchTurn) {
    const SensorModel sensor = sensorModel("VLP-16");
    const PixelDirections turn = pixelDirections(sensor, 16);
    ColumnMap map;
    mapColumns(16, 4, 1, 1, map);
    PixelDirections image;
    mapDirections(turn, map, image);
    EXPECT_EQ(image.row_sine, turn.row_sine);
    ASSERT_EQ(image.column_sine.size(), 7u);
    EXPECT_EQ(image.column_sine[0], turn.column_sine[12]);
    EXPECT_EQ(image.column_cosine[6], turn.column_cosine[8]);
}

TEST(ColumnMap, FullWindowMatchesWholeTurn) {
    Scan scan;
    const SensorModel sensor = sensorModel("VLP-16");
    for (int i = 0; i < 3000; ++i) {
        const float azimuth_rad = -3.1f + 0.002f * static_cast<float>(i);
        scan.azimuth_rad.push_back(azimuth_rad);
        scan.range_m.push_back(2.0f + static_cast<float>(i % 37));
        scan.row.push_back(static_cast<std::uint8_t>(i * 7 % 16));
    }
    for (auto* values : {&scan.x_m, &scan.y_m, &scan.z_m, &scan.intensity}) values->resize(3000);
    ColumnMap map;
    mapColumns(100, 4, 0, 25, map);
    RangeImage whole, mapped;
    ProjectionWorkspace work;
    projectScan(scan, sensor, 100, 30.0f, whole, work);
    projectScan(scan, sensor, map, 30.0f, mapped, work);
    ASSERT_EQ(mapped.depth_m.cols(), 100);
    std::size_t found = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const bool is_in = whole.depth_mapper[i] != RangeImage::kNoPixel;
        found += is_in;
        const int column = map.to_image[whole.depth_mapper[i] / 16];
        const int expected = column * 16 + whole.depth_mapper[i] % 16;
        EXPECT_EQ(mapped.depth_mapper[i], is_in ? expected : RangeImage::kNoPixel);
    }
    EXPECT_GT(found, 1000u);
}

}  // namespace
}  // namespace hagen
