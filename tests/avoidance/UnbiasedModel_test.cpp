#include "avoidance/world_models/UnbiasedModel.h"
#include <gtest/gtest.h>
#include <hagen/simulation/Random.h>

#include <algorithm>

namespace hagen::avoidance {
namespace {

/// An obstacle at x = 0 that moves along x at 1 m/s.
class FixedWall : public WorldModel {
 public:
    void update(const observations::MappedScan& scan) override { updated_s = scan.time_s; }
    float clearance_m(const Eigen::Vector3f& at) const override {
        return std::clamp(at.x(), 0.0f, kReach_m);
    }
    float clearanceAfter_m(const Eigen::Vector3f& at, double after_s) const override {
        return std::clamp(at.x() - static_cast<float>(after_s), 0.0f, kReach_m);
    }
    float fastest_m_s() const override { return 1; }
    bool isKnown(const Eigen::Vector3f& at) const override { return at.y() > 0; }
    std::size_t bytes() const override { return 77; }
    Obstacles obstacles() const override { return {{{0, 0, 0}}, 0.2f}; }

    double updated_s = 0;
};

UnbiasedModel wallWith(float bias_m) {
    return UnbiasedModel(std::make_unique<FixedWall>(), bias_m);
}

TEST(UnbiasedModel, SubtractsBias) {
    EXPECT_FLOAT_EQ(wallWith(0.2f).clearance_m({1, 0, 0}), 0.8f);
    EXPECT_FLOAT_EQ(wallWith(-0.2f).clearance_m({1, 0, 0}), 1.2f);
    EXPECT_FLOAT_EQ(wallWith(0.2f).clearanceAfter_m({1, 0, 0}, 0.5), 0.3f);
    EXPECT_FLOAT_EQ(wallWith(-0.2f).clearanceAfter_m({1, 0, 0}, 0.5), 0.7f);
}

TEST(UnbiasedModel, KeepsClearanceRange) {
    for (const float bias_m : {0.3f, -0.3f}) {
        const UnbiasedModel model = wallWith(bias_m);
        for (float x_m = -1; x_m < 5; x_m += 0.01f) {
            for (const float clearance_m :
                 {model.clearance_m({x_m, 0, 0}), model.clearanceAfter_m({x_m, 0, 0}, 0.1)}) {
                EXPECT_GE(clearance_m, 0.0f);
                EXPECT_LE(clearance_m, WorldModel::kReach_m);
            }
        }
    }
    // Corrected clearances do not exceed the range.
    EXPECT_FLOAT_EQ(wallWith(-0.3f).clearance_m({2.8f, 0, 0}), 3.0f);
    EXPECT_FLOAT_EQ(wallWith(-0.3f).clearance_m({9, 0, 0}), 3.0f);
}

TEST(UnbiasedModel, LimitedClearanceIsCutOff) {
    simulation::Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const auto bias_m = static_cast<float>(random.uniform(-0.4, 0.4));
        const auto limit_m = static_cast<float>(random.uniform(0.05, 3.2));
        const Eigen::Vector3f at(static_cast<float>(random.uniform(-0.5, 4)), 0, 0);
        const UnbiasedModel model = wallWith(bias_m);
        EXPECT_NEAR(model.clearanceWithin_m(at, limit_m), std::min(model.clearance_m(at), limit_m),
                    1e-6f)
            << bias_m << " " << limit_m << " " << at.x();
    }
}

TEST(UnbiasedModel, ForwardsOtherQueries) {
    auto inner = std::make_unique<FixedWall>();
    const FixedWall* seen = inner.get();
    UnbiasedModel model(std::move(inner), 0.1f);
    observations::MappedScan scan;
    scan.time_s = 7;
    model.update(scan);
    EXPECT_EQ(seen->updated_s, 7);
    EXPECT_EQ(model.fastest_m_s(), 1);
    EXPECT_TRUE(model.isKnown({0, 1, 0}));
    EXPECT_FALSE(model.isKnown({0, -1, 0}));
    EXPECT_EQ(model.bytes(), 77u);
    EXPECT_EQ(model.obstacles().edge_m, 0.2f);
}

TEST(DistanceBias, IsNotSubtractedAsStored) {
    WorldModelSetting setting;
    setting.bounds_m = {Eigen::Vector3f(-6, -6, -2), Eigen::Vector3f(10, 6, 4)};
    setting.true_clearance_m = [](const Eigen::Vector3f&, double) { return 1.5f; };
    observations::MappedScan scan{0,  {0, 0, 1}, {{5, 0, 1}, {5, 0, 1}}, {Label::Roi, Label::Roi},
                                  {}, {}};
    for (const std::string& name : worldModelNames()) {
        setting.distance = ModelDistance::Unbiased;
        const auto unbiased = makeWorldModel(name, setting);
        setting.distance = ModelDistance::AsStored;
        const auto as_stored = makeWorldModel(name, setting);
        unbiased->update(scan);
        as_stored->update(scan);
        const auto biasAt_m = [&](float x_m) {
            const Eigen::Vector3f at(x_m, 0, 1);
            return as_stored->clearance_m(at) - unbiased->clearance_m(at);
        };
        EXPECT_EQ(biasAt_m(3.5f) == 0, needsTruth(name)) << name;
        EXPECT_NEAR(biasAt_m(3.5f), biasAt_m(4), 1e-6f) << name;
    }
}

}  // namespace
}  // namespace hagen::avoidance
