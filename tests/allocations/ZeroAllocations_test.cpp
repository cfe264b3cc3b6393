// After the first scans, segmentation does not allocate, from packets to labels and index lists.
// This is a separate program because it replaces malloc().
#include <gtest/gtest.h>
#include <hagen/filter/SlidingWindow.h>
#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/sensors/VelodyneModel.h>

#include <Eigen/Core>

#include "filter/OptionKeys.h"
#include "support/Allocations.h"
#include "support/PaperOptions.h"
#include "support/SimpleFirings.h"

namespace hagen {
namespace {

test::SimpleScene street() {
    return test::sceneOf(
        {{{6, -8, 0}, {10, -5, 2}}, {{-15, 5, 0}, {15, 6, 4}}, {{3, 1, 0}, {3.5, 1.5, 0.3}}},
        {{8, 2, 0.1, 5}, {-6, -3, 0.2, 3}});
}

/// Scans of a moving sensor.
std::vector<mrpt::obs::CObservationVelodyneScan::Ptr> drive(const std::string& model_name) {
    const sensors::VelodyneModel& model = sensors::velodyneModel(model_name);
    std::vector<mrpt::obs::CObservationVelodyneScan::Ptr> scans;
    for (int i = 0; i < 4; ++i) {
        scans.push_back(
            observations::encodeScan(model, test::fireAt(street(), model, {0.5 * i, 0, 2})));
    }
    return scans;
}

void expectNoAllocations(const std::string& model, const Options& options,
                         const std::optional<Attitude>& attitude) {
    const auto scans = drive(model);
    HagenFilter filter(observations::sensorOf(*scans.front()), test::numbered(options));
    observations::ObservationWorkspace decoder;
    Scan scan;
    std::size_t before = 0, roi = 0;
    for (int round = 0; round < 3; ++round) {
        if (round == 1) before = allocations();
        for (const auto& observation : scans) {
            observations::decodePackets(*observation, scan, decoder);
            roi += filter.segment(scan, attitude).returns.roi.size();
        }
    }
    EXPECT_EQ(allocations() - before, 0u);
    EXPECT_GT(roi, 0u);
}

class ZeroAllocations : public testing::TestWithParam<const char*> {
 protected:
    void SetUp() override {
        if (!countsAllocations()) GTEST_SKIP() << "the sanitizer replaces malloc()";
    }
};

TEST_P(ZeroAllocations, PaperPipelineNeverAllocates) {
    expectNoAllocations(GetParam(), test::paperOptions(), {});
}

TEST_P(ZeroAllocations, DefaultPipelineNeverAllocates) {
    expectNoAllocations(GetParam(), Options(), {});
}

TEST_P(ZeroAllocations, AllOptionsNeverAllocate) {
    Options options;
    for (const OptionKey& key : optionKeys()) {  // stages that are off by default
        const auto* const real = std::get_if<float Options::*>(&key.field);
        if (real != nullptr && options.*(*real) == 0 && key.min == 0) options.*(*real) = 1;
    }
    expectNoAllocations(GetParam(), options, Attitude{0.05f, -0.03f});
    options.seeds = Seeds::TopAndNearest;
    options.persistence_m = 0;
    options.sharpen_proximity = options.sharpen_by_neighbours = options.angle_to_beam_above = false;
    options.gaps_are_level = true;
    expectNoAllocations(GetParam(), options, Attitude{0.05f, -0.03f});
    options.seeds = Seeds::Every;
    options.raw_angles = true;
    expectNoAllocations(GetParam(), options, Attitude{0.05f, -0.03f});
}

TEST(ZeroAllocationsPerScan, LocatingAndSegmentingNeverAllocate) {
    if (!countsAllocations()) GTEST_SKIP() << "the sanitizer replaces malloc()";
    const SensorModel sensor = sensorModel("HDL-64E");
    test::LabelledScan seen = test::scanScene(street(), sensor, 600, {0, 0, 1.7});
    HagenFilter filter(sensor, Options());
    std::size_t before = 0;
    for (int round = 0; round < 3; ++round) {
        if (round == 2) before = allocations();
        locateBeams(sensor, seen.scan);
        filter.segment(seen.scan);
    }
    EXPECT_EQ(allocations() - before, 0u);
}

TEST(ZeroAllocationsPerScan, SlidingWindowNeverAllocates) {
    if (!countsAllocations()) GTEST_SKIP() << "the sanitizer replaces malloc()";
    Options options;
    options.window_scans = 3;
    const SensorModel sensor = sensorModel("HDL-64E");
    const test::LabelledScan seen = test::scanScene(street(), sensor, 600, {0, 0, 1.7});
    SlidingWindow window(HagenFilter(sensor, options));
    std::size_t before = 0;
    for (int round = 0; round < 8; ++round) {
        if (round == 5) before = allocations();
        window.segment(seen.scan, {}, Eigen::Isometry3d::Identity());
    }
    EXPECT_EQ(allocations() - before, 0u);
}

INSTANTIATE_TEST_SUITE_P(Sensors, ZeroAllocations, testing::Values("VLP-16", "HDL-32E"),
                         [](const auto& of) {
                             return std::string(of.param) == "VLP-16" ? "Vlp16" : "Hdl32";
                         });

/// The test's counter sees every kind of allocation.
TEST(AllocationCounter, SeesNewAndEigen) {
    if (!countsAllocations()) GTEST_SKIP() << "the sanitizer replaces malloc()";
    const std::size_t before = allocations();
    void* const block = ::operator new(8);  // compilers may leave out a new expression
    EXPECT_EQ(allocations() - before, 1u);
    ::operator delete(block);
    const Eigen::ArrayXXf numbers = Eigen::ArrayXXf::Zero(8, 8);
    EXPECT_EQ(allocations() - before, 2u);
    EXPECT_EQ(numbers(3, 3), 0);
}

}  // namespace
}  // namespace hagen
