#include <gmock/gmock.h>
#include <hagen/filter/Levelling.h>
#include <hagen/scan/Angle.h>
#include <algorithm>
#include <cmath>
#include <set>
#include "evaluation/DegradedScans.h"
#include "evaluation/TrueHeights.h"

#include "evaluation/Labels.h"
#include "support/PointScan.h"
#include "support/Program.h"
#include "support/Random.h"

namespace hagen::evaluation {
namespace {

using Eigen::Vector3f;
using testing::HasSubstr;

const SensorModel kDegradedSensor = sensorModel("VLP-16");
constexpr int kColumns = 360;

/// Returns at the centres of all pixels, with random ranges and truth. `kinds` and `objects` hold
/// each return's index, so that it can be traced.
GroundTruthScan randomScan(unsigned seed = 1) {
    test::Random random(seed);
    std::vector<Vector3f> points_m;
    GroundTruthScan scan;
    for (int column = 0; column < kColumns; ++column) {
        for (int row = 0; row < kDegradedSensor.rows(); ++row) {
            points_m.push_back(
                test::onBeam(kDegradedSensor, row, column - 179.5, double(random.real(2, 30))));
            scan.truth.push_back(random.chance(0.5) ? G : O);
            scan.kinds.push_back(static_cast<std::uint16_t>(scan.kinds.size()));
            scan.objects.push_back(static_cast<std::uint32_t>(scan.objects.size()));
            scan.heights_m.push_back(random.real(0, 3));
        }
    }
    scan.input.scan = test::scanOf(kDegradedSensor, points_m);
    scan.input.scan.time_s.assign(points_m.size(), 0.05f);
    scan.name = "scan";
    return scan;
}

GroundTruthScan degraded(const GroundTruthScan& scan, const std::string& text, unsigned seed = 1) {
    return Degradation(text).apply(scan, kDegradedSensor, seed);
}

Vector3f point(const GroundTruthScan& scan, std::size_t i) {
    const Scan& s = scan.input.scan;
    return {s.x_m[i], s.y_m[i], s.z_m[i]};
}

/// Expects arrays of equal size, and ranges and azimuths that match the coordinates.
void expectSound(const GroundTruthScan& scan) {
    const Scan& s = scan.input.scan;
    for (const std::size_t size :
         {s.y_m.size(), s.z_m.size(), s.intensity.size(), s.range_m.size(), s.azimuth_rad.size(),
          s.row.size(), s.time_s.size(), scan.truth.size(), scan.kinds.size(), scan.objects.size(),
          scan.heights_m.size()})
        ASSERT_EQ(size, s.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
        ASSERT_NEAR(point(scan, i).norm(), s.range_m[i], 1e-4f * s.range_m[i]) << i;
        ASSERT_NEAR(std::atan2(s.y_m[i], s.x_m[i]), s.azimuth_rad[i], 1e-4) << i;
    }
}

/// Expects that exactly the returns with `isKept(original index)` remain.
template <class IsKept>
void expectPart(const GroundTruthScan& scan, const GroundTruthScan& part, IsKept isKept) {
    expectSound(part);
    std::size_t k = 0;
    for (std::size_t i = 0; i < scan.input.scan.size(); ++i) {
        if (!isKept(i)) continue;
        ASSERT_LT(k, part.input.scan.size());
        ASSERT_EQ(part.kinds[k], i);
        ASSERT_EQ(part.truth[k], scan.truth[i]);
        ASSERT_EQ(part.input.scan.row[k], scan.input.scan.row[i]);
        ASSERT_EQ(point(part, k), point(scan, i));
        ++k;
    }
    EXPECT_EQ(k, part.input.scan.size());
    EXPECT_GT(k, 0u);
    EXPECT_LT(k, scan.input.scan.size());
}

TEST(Degradation, DeadBeamsRemoveRows) {
    const auto scan = randomScan();
    expectPart(scan, degraded(scan, "dead_beams=3,7"), [&](std::size_t i) {
        return scan.input.scan.row[i] != 3 && scan.input.scan.row[i] != 7;
    });
}

TEST(Degradation, DropoutRemovesGivenShare) {
    const auto scan = randomScan();
    const double returns = static_cast<double>(scan.input.scan.size());
    const auto first = degraded(scan, "dropout=20");
    const double five_sd = 5 * std::sqrt(returns * 0.2 * 0.8);
    EXPECT_NEAR(static_cast<double>(first.kinds.size()), 0.8 * returns, five_sd);
    const std::set<std::uint16_t> kept(first.kinds.begin(), first.kinds.end());
    expectPart(scan, first, [&](std::size_t i) { return kept.count(scan.kinds[i]) > 0; });
    EXPECT_EQ(degraded(scan, "dropout=20").kinds, first.kinds);
    EXPECT_NE(degraded(scan, "dropout=20", 2).kinds, first.kinds);
    EXPECT_EQ(degraded(scan, "dropout=100").input.scan.size(), 0u);
    EXPECT_EQ(degraded(scan, "dropout=0").kinds, scan.kinds);
}

TEST(Degradation, NoiseMovesReturnsAlongRays) {
    const auto scan = randomScan();
    const auto noisy = degraded(scan, "noise_m=0.05");
    expectSound(noisy);
    EXPECT_EQ(noisy.kinds, scan.kinds);
    EXPECT_EQ(noisy.truth, scan.truth);
    EXPECT_EQ(noisy.input.scan.row, scan.input.scan.row);
    double sum = 0, squares = 0;
    const std::size_t returns = scan.input.scan.size();
    for (std::size_t i = 0; i < returns; ++i) {
        const double error_m = double(noisy.input.scan.range_m[i] - scan.input.scan.range_m[i]);
        sum += error_m;
        squares += error_m * error_m;
    }
    const double count = static_cast<double>(returns);
    EXPECT_NEAR(sum / count, 0, 5 * 0.05 / std::sqrt(count));
    EXPECT_NEAR(std::sqrt(squares / count), 0.05, 5 * 0.05 / std::sqrt(2 * count));
}

TEST(Degradation, RainShortensRangesUnscored) {
    const auto scan = randomScan();
    const auto rainy = degraded(scan, "rain=10");
    expectSound(rainy);
    EXPECT_EQ(rainy.kinds, scan.kinds);
    EXPECT_EQ(rainy.input.scan.row, scan.input.scan.row);
    int drops = 0;
    for (std::size_t i = 0; i < scan.truth.size(); ++i) {
        const float range_m = rainy.input.scan.range_m[i], before_m = scan.input.scan.range_m[i];
        if (rainy.truth[i] != U) {
            ASSERT_EQ(range_m, before_m);
            ASSERT_EQ(rainy.truth[i], scan.truth[i]);
            ASSERT_EQ(rainy.objects[i], scan.objects[i]);
            continue;
        }
        ++drops;
        ASSERT_LE(range_m, std::min(before_m, 12.0f));
        ASSERT_GE(range_m, 0.5f);
        ASSERT_EQ(rainy.objects[i], 0u);
    }
    const double returns = static_cast<double>(scan.truth.size());
    EXPECT_NEAR(drops, 0.1 * returns, 5 * std::sqrt(returns * 0.1 * 0.9));
}

TEST(Degradation, KeepsReturnsNearerThanDrops) {
    GroundTruthScan scan;
    scan.input.scan = test::scanOf(kDegradedSensor, {test::onBeam(kDegradedSensor, 5, 0, 0.4)});
    scan.truth = {O};
    EXPECT_EQ(degraded(scan, "rain=100").truth[0], O);
    EXPECT_GT(degraded(scan, "noise_m=10").input.scan.range_m[0], 0.0f);
}

/// Expects points to be rotated and cropped to the field of view. The attitude is
/// known only with ",attitude".
void expectTilted(const std::string& text, const Attitude& attitude) {
    const auto scan = randomScan();
    const auto tilted = degraded(scan, text);
    expectSound(tilted);
    const Eigen::Matrix3f level = levelFromSensor(attitude);
    std::set<std::size_t> kept;
    for (std::size_t k = 0; k < tilted.kinds.size(); ++k) {
        const std::size_t i = tilted.kinds[k];
        kept.insert(i);
        ASSERT_LT((level * point(tilted, k) - point(scan, i)).norm(), 1e-4f);
        const float elevation_rad = std::asin(tilted.input.scan.z_m[k] / point(tilted, k).norm());
        ASSERT_EQ(tilted.input.scan.row[k], kDegradedSensor.nearestRow(elevation_rad));
    }
    for (std::size_t i = 0; i < scan.kinds.size(); ++i) {
        const Vector3f seen_m = level.transpose() * point(scan, i);
        const double elevation_deg = degrees(std::asin(double(seen_m.z() / seen_m.norm())));
        if (std::abs(std::abs(elevation_deg) - 16) < 1e-3) continue;  // half a row beyond 15
        ASSERT_EQ(kept.count(i) > 0, std::abs(elevation_deg) < 16) << elevation_deg;
    }
    EXPECT_LT(kept.size(), scan.kinds.size());
    EXPECT_FALSE(tilted.input.map_from_sensor.has_value());
    EXPECT_TRUE(tilted.levelFromSensor().isApprox(level, 1e-6f));
    const auto with_attitude = degraded(scan, text + ",attitude");
    EXPECT_EQ(with_attitude.kinds, tilted.kinds);
    EXPECT_TRUE(with_attitude.input.map_from_sensor->isApprox(level, 1e-6f));
}

TEST(Degradation, TiltRotatesSensorOnly) {
    expectTilted("roll_deg=20", {static_cast<float>(radians(20)), 0});
    expectTilted("pitch_deg=-10", {0, static_cast<float>(radians(-10))});
}

TEST(Degradation, TiltAddsToRecordedAttitude) {
    auto scan = randomScan();
    const Eigen::Matrix3f before = levelFromSensor({0.1f, 0.2f});
    scan.input.map_from_sensor = before;
    const auto tilted = degraded(scan, "roll_deg=20");
    EXPECT_FALSE(tilted.input.map_from_sensor.has_value());
    const Vector3f up = before * point(scan, tilted.kinds[7]);
    EXPECT_LT((tilted.levelFromSensor() * point(tilted, 7) - up).norm(), 1e-4f);
}

TEST(Degradation, UpsideDownMatchesMirroredSensor) {
    const auto scan = randomScan();
    const auto turned = degraded(scan, "upside_down");
    expectSound(turned);
    EXPECT_EQ(turned.kinds, scan.kinds);
    EXPECT_EQ(turned.truth, scan.truth);
    ASSERT_TRUE(turned.input.map_from_sensor.has_value());
    Scan located = turned.input.scan;  // rows from its coordinates
    locateBeams(mirrored(kDegradedSensor), located);
    EXPECT_EQ(located.row, turned.input.scan.row);
    EXPECT_NO_THROW(checkLocated(turned.input.scan, mirrored(kDegradedSensor)));
    for (std::size_t i = 0; i < scan.kinds.size(); ++i) {
        ASSERT_LT((*turned.input.map_from_sensor * point(turned, i) - point(scan, i)).norm(),
                  1e-5f);
    }
    EXPECT_TRUE(Degradation("upside_down").mirrorsSensor());
    EXPECT_FALSE(Degradation("roll_deg=20").mirrorsSensor());
}

TEST(Degradation, KeepsReturnsOfDownwardSensor) {
    SensorModel down = kDegradedSensor;
    down.elevations_rad = {-1.5708f, -1.0472f, -0.5236f, 0};
    auto scan = randomScan();
    Scan& returns = scan.input.scan;
    for (std::size_t i = 0; i < returns.size(); ++i) {  // 88 degrees down
        returns.x_m[i] = 0.035f;
        returns.y_m[i] = 0;
        returns.z_m[i] = -1;
    }
    locateBeams(down, returns);
    const auto same = Degradation("roll_deg=0").apply(scan, down, 1);
    EXPECT_EQ(same.truth.size(), scan.truth.size());
}

TEST(Degradation, LimitsFieldOfView) {
    const auto scan = randomScan();
    expectPart(scan, degraded(scan, "fov_deg=180"),
               [&](std::size_t i) { return scan.input.scan.x_m[i] > 0; });
    const auto elevation_deg = [&](std::size_t i) {
        return degrees(double(kDegradedSensor.elevations_rad[scan.input.scan.row[i]]));
    };
    expectPart(scan, degraded(scan, "above_deg=-4"),
               [&](std::size_t i) { return elevation_deg(i) > -4; });
    expectPart(scan, degraded(scan, "below_deg=0"),
               [&](std::size_t i) { return elevation_deg(i) < 0; });
}

TEST(Degradation, SecondReturnsLieBehindEdges) {
    const auto scan = randomScan();
    const auto dual = degraded(scan, "dual_return");
    expectSound(dual);
    const std::size_t before = scan.kinds.size();
    ASSERT_GT(dual.kinds.size(), before);
    const auto neighbour = [&](std::size_t i, int side) {  // same row, next column
        const auto column = static_cast<int>(i) / kDegradedSensor.rows() + side + kColumns;
        return static_cast<std::size_t>(column % kColumns * kDegradedSensor.rows()) +
               i % kDegradedSensor.rows();
    };
    std::size_t candidates = 0;
    for (std::size_t i = 0; i < before; ++i) {
        ASSERT_EQ(point(dual, i), point(scan, i));
        ASSERT_EQ(dual.truth[i], scan.truth[i]);
        const auto& range_m = scan.input.scan.range_m;
        candidates +=
            range_m[neighbour(i, -1)] > range_m[i] + 1 || range_m[neighbour(i, 1)] > range_m[i] + 1;
    }
    const double count = static_cast<double>(candidates);
    EXPECT_NEAR(static_cast<double>(dual.kinds.size() - before), 0.3 * count,
                5 * std::sqrt(count * 0.3 * 0.7));
    for (std::size_t k = before; k < dual.kinds.size(); ++k) {
        const std::size_t behind = dual.kinds[k];
        ASSERT_EQ(dual.truth[k], scan.truth[behind]);
        ASSERT_EQ(dual.objects[k], scan.objects[behind]);
        ASSERT_EQ(dual.heights_m[k], scan.heights_m[behind]);
        ASSERT_FLOAT_EQ(dual.input.scan.range_m[k], scan.input.scan.range_m[behind]);
        const auto isRay = [&](std::size_t i) {
            return dual.input.scan.azimuth_rad[k] == scan.input.scan.azimuth_rad[i] &&
                   scan.input.scan.range_m[i] + 1 < dual.input.scan.range_m[k];
        };
        ASSERT_TRUE(isRay(neighbour(behind, -1)) || isRay(neighbour(behind, 1))) << k;
    }
}

// Across a gap, the next return in the row is not a neighbour.
TEST(Degradation, SecondReturnsNeedNeighbours) {
    GroundTruthScan scan;
    std::vector<Vector3f> points_m;
    for (int column = 0; column < 20; ++column) {
        const double azimuth_deg = column < 10 ? column : column + 10;
        points_m.push_back(test::onBeam(kDegradedSensor, 8, azimuth_deg, column < 10 ? 5 : 15));
    }
    scan.input.scan = test::scanOf(kDegradedSensor, points_m);
    scan.truth.assign(points_m.size(), O);
    for (unsigned seed = 0; seed < 50; ++seed) {
        EXPECT_EQ(degraded(scan, "dual_return", seed).truth.size(), scan.truth.size());
    }
}

TEST(Degradation, DoubleRateHalvesColumns) {
    const auto scan = randomScan();
    const auto fast = degraded(scan, "rate_hz=20");
    expectPart(scan, fast, [&](std::size_t i) { return i / kDegradedSensor.rows() % 2 == 0; });
    const auto faster = degraded(scan, "rate_hz=40");
    EXPECT_EQ(faster.kinds.size(), scan.kinds.size() / 4);
}

TEST(Degradation, RateKeepsDualReturns) {
    const auto scan = randomScan();
    auto dual = degraded(scan, "dual_return");
    const auto fast = degraded(dual, "rate_hz=20");
    const auto columns = [](const GroundTruthScan& of) {
        return std::set<float>(of.input.scan.azimuth_rad.begin(), of.input.scan.azimuth_rad.end());
    };
    const auto kept = columns(fast);
    std::size_t expected = 0;
    for (const float azimuth_rad : dual.input.scan.azimuth_rad) expected += kept.count(azimuth_rad);
    EXPECT_EQ(fast.input.scan.size(), expected);
}

TEST(Degradation, KeepsEmptyScansEmpty) {
    GroundTruthScan scan;
    scan.input.scan = test::scanOf(kDegradedSensor, {});
    for (const Degradation& degradation : standardDegradations(kDegradedSensor)) {
        const auto empty = degradation.apply(scan, kDegradedSensor, 1);
        EXPECT_EQ(empty.input.scan.size(), 0u) << degradation.name();
    }
}

TEST(Degradation, KeepsReturnsWithoutRange) {
    auto scan = randomScan();
    scan.input.scan.x_m[3] = std::nanf("");
    locateBeams(kDegradedSensor, scan.input.scan);
    for (const char* text : {"noise_m=0.1", "rain=3", "dual_return", "upside_down"}) {
        const auto result = degraded(scan, text);
        EXPECT_GE(result.truth.size(), scan.truth.size()) << text;
        EXPECT_TRUE(std::isnan(result.input.scan.range_m[3])) << text;
    }
}

TEST(Degradation, StandardSetsFitSensor) {
    const auto namesFor = [](const std::string& model) {
        std::vector<std::string> names;
        for (const Degradation& degradation : standardDegradations(sensorModel(model))) {
            EXPECT_NO_THROW(degradation.checkSensor(sensorModel(model)));
            names.push_back(degradation.name());
        }
        EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
        return names;
    };
    EXPECT_THAT(namesFor("VLP-16"), testing::IsSupersetOf({"dead_beams=0", "dead_beams=15",
                                                           "dead_beams=7,8", "upside_down"}));
    EXPECT_THAT(namesFor("HDL-64E"),
                testing::IsSupersetOf({"dead_beams=0", "dead_beams=60", "dead_beams=28,29"}));
    EXPECT_EQ(namesFor("VLP-16").size(), namesFor("HDL-64E").size());
}

std::string problemOf(const std::string& text) {
    return test::messageOf<std::invalid_argument>(
        [&] { Degradation(text).checkSensor(kDegradedSensor); });
}

TEST(Degradation, RejectsUnknownNames) {
    for (const char* text : {"", "snow=3", "dropout", "upside_down=1", "rain_percent=3"}) {
        EXPECT_THAT(problemOf(text), HasSubstr("known: dead_beams=R[,R...], dropout=")) << text;
    }
}

TEST(Degradation, RejectsValuesOutOfRange) {
    for (const char* text :
         {"dropout=101", "dropout=-1", "dropout=", "dropout=x", "rain=nan", "noise_m=11",
          "roll_deg=91", "roll_deg=20,attitudes", "fov_deg=0", "above_deg=-91", "rate_hz=5"}) {
        EXPECT_THAT(problemOf(text), HasSubstr("is not a number from")) << text;
    }
    EXPECT_THAT(problemOf("rate_hz=5"), HasSubstr("'rate_hz=5': '5' is not a number from 20 to"));
    for (const char* text : {"dead_beams=", "dead_beams=1,", "dead_beams=-1", "dead_beams=256"}) {
        EXPECT_THAT(problemOf(text), HasSubstr("expected rows")) << text;
    }
    EXPECT_THAT(problemOf("dead_beams=3,16"), HasSubstr("the sensor has rows 0 to 15"));
    EXPECT_EQ(problemOf("pitch_deg=-20,attitude"), "");
}

/// Returns the same scan three times.
class OneScan : public LabelledScanSource {
 public:
    std::optional<GroundTruthScan> next() override {
        if (pulled_++ == 3) return std::nullopt;
        GroundTruthScan scan = randomScan();
        scan.heights_m.clear();
        return scan;
    }
    const std::string& name() const override { return name_; }
    std::size_t size() const override { return 3; }
    const LabelMap& kinds() const override { return kinds_; }
    SensorModel sensor() const override { return kDegradedSensor; }
    std::vector<Method> makeMethods() const override { return {{"none", {}}}; }

 private:
    std::string name_ = "one";
    LabelMap kinds_;
    int pulled_ = 0;
};

TEST(DegradedScans, UseOneSeedPerScan) {
    DegradedScans scans(std::make_unique<OneScan>(), Degradation("dropout=50"));
    EXPECT_EQ(scans.name(), "one");
    EXPECT_EQ(scans.size(), 3u);
    EXPECT_EQ(scans.makeMethods().size(), 1u);
    const auto first = scans.next(), second = scans.next();
    EXPECT_NE(first->kinds, second->kinds);
    EXPECT_TRUE(scans.next().has_value());
    EXPECT_FALSE(scans.next().has_value());
    DegradedScans again(std::make_unique<OneScan>(), Degradation("dropout=50"));
    EXPECT_EQ(again.next()->kinds, first->kinds);
}

// Beams above the horizon do not see the ground.
TEST(DegradedScans, KeepRecordedHeights) {
    DegradedScans scans(std::make_unique<OneScan>(), Degradation("above_deg=0"));
    const auto recorded = randomScan();
    const std::vector<float> heights_m =
        heightsAboveTrueGround(recorded, levelPoints(recorded), 100);
    const auto scan = scans.next();
    ASSERT_EQ(scan->heights_m.size(), scan->truth.size());
    for (std::size_t k = 0; k < scan->truth.size(); ++k) {
        if (scan->truth[k] == O) {
            ASSERT_EQ(scan->heights_m[k], heights_m[scan->kinds[k]]);
        }
    }
}

TEST(DegradedScans, RejectMissingRows) {
    EXPECT_THROW(DegradedScans(std::make_unique<OneScan>(), Degradation("dead_beams=16")),
                 std::invalid_argument);
}

}  // namespace
}  // namespace hagen::evaluation
