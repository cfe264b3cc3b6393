// What is left of the world models' biases, on flights that the constants were not chosen on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/avoidance/ClearanceErrors.h>
#include <hagen/avoidance/WorldModel.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace hagen::avoidance {
namespace {

using testing::HasSubstr;

/// The mean over few flights depends on how obstacles lie in the voxels. Without the correction,
/// the biases of maps are 14 to 27 cm.
double tolerance_m(const std::string& model) {
    return model.find("0.4") != std::string::npos ? 0.09
           : model.compare(0, 2, "W-") == 0       ? 0.03
                                                  : 0.04;
}

TEST(ClearanceErrors, TheRemainingBiasIsSmall) {
    ClearanceMeasurement measurement;
    for (const std::string& model : avoidance::worldModelNames()) {
        // The maps of RoI points store distances as those of all points do.
        const bool is_roi_map = model.compare(0, 5, "O-RoI") == 0;
        if (!avoidance::needsTruth(model) && !is_roi_map) measurement.models.push_back(model);
    }
    measurement.first_seed = 200;
    measurement.last_seed = 202;
    measurement.distance = ModelDistance::Unbiased;
    const std::vector<ClearanceErrors> errors = measureClearances(measurement);
    for (const std::string& model : measurement.models) {
        EXPECT_NEAR(biasOf_m(errors, model), 0, tolerance_m(model))
            << model << ": measure it again with 'octomap-compare distances' and update "
            << "libs/avoidance/DistanceBias.cpp";
        for (const char* kind : {"wall", "pole"}) {
            const ErrorSpread spread = spreadOf(errors, model, kind);
            EXPECT_LT(spread.missed, 0.02 * spread.queries) << model;
        }
    }
}

/// A point lies in a voxel, so that the voxel's face is nearer, by its diagonal at most.
TEST(ClearanceErrors, AsStoredAMapsDistanceIsThatToTheFacesOfItsVoxels) {
    const auto errors =
        measureClearances({{"O-Full-0.2"}, 0, 0, ModelDistance::AsStored, false, {}});
    ASSERT_EQ(errors.size(), measuredObstacles().size());
    const ErrorSpread wall = spreadOf(errors, "O-Full-0.2", "wall");
    EXPECT_EQ(wall.queries, 16 * 40);
    EXPECT_LT(wall.mean_m, -0.05);
    EXPECT_GT(wall.mean_m, -0.3);
    EXPECT_GT(wall.p05_m, -0.2 * std::sqrt(3.0) - 0.08);  // 4 sigma of the noise
}

TEST(ClearanceErrors, WallsAndPolesHaveEqualWeight) {
    const std::vector<ClearanceErrors> errors{{"A", "wall", {0.1}, 0},
                                              {"A", "pole of 5 cm radius", {-0.2, -0.2}, 1},
                                              {"A", "pole of 15 cm radius", {0.1}, 0},
                                              {"B", "wall", {9}, 0}};
    EXPECT_NEAR(biasOf_m(errors, "A"), 0, 1e-12);
    const ErrorSpread pole = spreadOf(errors, "A", "pole");
    EXPECT_EQ(pole.queries, 4);
    EXPECT_EQ(pole.missed, 1);
    EXPECT_NEAR(pole.mean_m, -0.1, 1e-12);
    EXPECT_NEAR(pole.median_m, -0.2, 1e-12);
    EXPECT_NEAR(pole.deviation_m, std::sqrt(0.02), 1e-12);
}

/// 0, 1 ... 100 mm: each percentile is a number of them.
TEST(ClearanceErrors, QuantilesAreThoseOfAllObstaclesTogether) {
    std::vector<ClearanceErrors> errors{{"A", "pole of 5 cm radius", {}, 0},
                                        {"A", "pole of 15 cm radius", {}, 0}};
    for (int mm = 0; mm <= 100; ++mm) errors[mm % 2].errors_m.push_back(0.001 * mm);
    const ErrorSpread pole = spreadOf(errors, "A", "pole");
    EXPECT_EQ(pole.queries, 101);
    EXPECT_NEAR(pole.p05_m, 0.005, 1e-12);
    EXPECT_NEAR(pole.median_m, 0.05, 1e-12);
    EXPECT_NEAR(pole.p95_m, 0.095, 1e-12);
}

TEST(ClearanceErrors, TheGreatestSeedIsTheLast) {
    struct Enough {};
    const std::uint64_t greatest = std::numeric_limits<std::uint64_t>::max();
    std::vector<std::uint64_t> seeds;
    ClearanceMeasurement measurement{{"W-RoI"}, greatest, greatest, ModelDistance::AsStored,
                                     false,     {}};
    measurement.doing = [&](std::uint64_t seed) {
        seeds.push_back(seed);
        if (seeds.size() > 1) throw Enough();
    };
    EXPECT_NO_THROW(measureClearances(measurement));
    EXPECT_EQ(seeds, std::vector<std::uint64_t>{greatest});
}

TEST(ClearanceErrors, ModelsThatCannotBeMeasuredAreNamed) {
    const auto saidOf = [](const std::string& model) -> std::string {
        try {
            measureClearances({{model}, 0, 0, ModelDistance::AsStored, false, {}});
        } catch (const std::invalid_argument& e) {
            return e.what();
        }
        return "nothing";
    };
    EXPECT_THAT(saidOf("oracle"), HasSubstr("'oracle' answers with the truth"));
    EXPECT_THAT(saidOf("X"), HasSubstr("unknown world model 'X'"));
}

}  // namespace
}  // namespace hagen::avoidance
