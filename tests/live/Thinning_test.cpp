#include <gmock/gmock.h>
#include <hagen/live/Thinning.h>
#include <hagen/scan/RangeImage.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "support/Random.h"

namespace hagen::live {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr int kScanRows = 16, kScanColumns = 870;

void add(int column, int row, float range_m, float z_m, Scan& scan) {
    scan.x_m.push_back(range_m);
    scan.y_m.push_back(0);
    scan.z_m.push_back(z_m);
    scan.range_m.push_back(range_m);
    scan.azimuth_rad.push_back(columnAzimuth(column, kScanColumns));
    scan.row.push_back(static_cast<std::uint8_t>(row));
}

/// Implements the definition of the class with maps.
std::set<std::size_t> thinnedByHand(const Scan& scan, int every) {
    using Pixel = std::pair<int, int>;
    std::map<Pixel, std::vector<std::size_t>> own, group;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const int column = nearestColumn(scan.azimuth_rad[i], kScanColumns);
        const Pixel pixel{column / every, scan.row[i]};
        if (column % every == 0) own[pixel].push_back(i);
        group[pixel].push_back(i);
    }
    std::set<std::size_t> kept;
    for (const auto& [pixel, returns] : own) {
        const auto closest = *std::min_element(
            returns.begin(), returns.end(),
            [&](std::size_t a, std::size_t b) { return scan.range_m[a] < scan.range_m[b]; });
        const auto& all = group[pixel];
        const auto lowest = *std::min_element(
            all.begin(), all.end(),
            [&](std::size_t a, std::size_t b) { return scan.z_m[a] < scan.z_m[b]; });
        kept.insert(scan.z_m[lowest] < scan.z_m[closest] - 0.3F ? lowest : closest);
    }
    return kept;
}

TEST(Thinning, MatchesDefinition) {
    test::Random random(1);
    for (const int every : {1, 2, 5, 7}) {
        Thinning thinning(kScanRows, kScanColumns, every);
        for (int k = 0; k < 50; ++k) {
            SCOPED_TRACE(k);
            Scan scan;
            const int first = random.whole(0, kScanColumns - 12);
            for (int n = random.whole(0, 300); n > 0; --n) {
                add(first + random.whole(0, 11), random.whole(0, kScanRows - 1), random.real(1, 60),
                    random.real(-3, 1), scan);
            }
            const std::vector<std::size_t>& kept = thinning.of(scan);
            EXPECT_EQ(std::set<std::size_t>(kept.begin(), kept.end()), thinnedByHand(scan, every));
        }
    }
}

/// maskAirframe() removes the range of masked returns.
TEST(Thinning, IgnoresMaskedReturns) {
    Scan scan;
    add(10, 3, kNoValue, 0, scan);
    add(10, 3, 8, 2, scan);
    add(11, 3, kNoValue, 0.07f, scan);
    add(15, 4, 6, 2, scan);
    add(16, 4, kNoValue, 0.07f, scan);
    Thinning thinning(kScanRows, kScanColumns, 5);
    EXPECT_THAT(thinning.of(scan), ElementsAre(1, 3));
}

TEST(Thinning, LowGroundReplacesCrown) {
    Thinning thinning(kScanRows, kScanColumns, 5);
    Scan scan;
    add(100, 3, 4, -1, scan);
    add(101, 3, 4.1F, -1.1F, scan);
    EXPECT_THAT(thinning.of(scan), ElementsAre(0));
    add(102, 3, 9, -2.3F, scan);
    add(105, 3, 4, -1, scan);
    EXPECT_THAT(thinning.of(scan), ElementsAre(2, 3));
}

TEST(Thinning, UpsideDownSensorInvertsHeights) {
    Thinning thinning(kScanRows, kScanColumns, 5);
    Scan scan;
    add(100, 3, 4, 1, scan);
    add(101, 3, 9, 2.3F, scan);
    add(102, 3, 4, -1, scan);
    EXPECT_THAT(thinning.of(scan, -1), ElementsAre(1));
    EXPECT_THAT(thinning.of(scan, 0), ElementsAre(0));  // the sensor is on its side
    EXPECT_THAT(thinning.of(scan), ElementsAre(2));
}

TEST(Thinning, IgnoresReturnsWithoutCoordinates) {
    Thinning thinning(kScanRows, kScanColumns, 5);
    Scan scan;
    add(100, 3, 4, -1, scan);
    add(101, 3, kNoValue, kNoValue, scan);
    EXPECT_THAT(thinning.of(scan), ElementsAre(0));
}

TEST(Thinning, KeepsNoReturnsWithoutColumns) {
    Thinning thinning(kScanRows, kScanColumns, 0);
    Scan scan;
    add(0, 3, 4, -1, scan);
    EXPECT_THAT(thinning.of(scan), IsEmpty());
}

}  // namespace
}  // namespace hagen::live
