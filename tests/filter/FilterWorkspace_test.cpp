// Neither other filters in the thread nor the thread itself affect a filter's results.
#include <gtest/gtest.h>
#include <hagen/filter/HagenFilter.h>

#include <memory>
#include <thread>
#include <vector>

#include "support/PaperOptions.h"
#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

/// Scans of a yard along a path, with returns behind others.
std::vector<Scan> drive(const SensorModel& sensor, int columns) {
    std::vector<Scan> scans;
    for (int i = 0; i < 4; ++i) {
        scans.push_back(
            test::scanScene(test::yard(), sensor, columns, {0.7 * i, 0.3, 2.0 - 0.2 * i}).scan);
    }
    return scans;
}

/// All data of a result.
struct Segmented {
    Image<float> smoothed_rad, height_m;
    std::vector<Label> own_label, label;
    std::vector<std::int32_t> component;
    std::vector<std::uint32_t> roi;
};

Segmented outcomeOf(const SegmentationResult& r) {
    return {r.smoothed_rad,  r.ground.height_m,   r.own_labels.label,
            r.returns.label, r.returns.component, r.returns.roi};
}

void expectSame(const Segmented& a, const Segmented& b) {
    EXPECT_TRUE(test::same(a.smoothed_rad, b.smoothed_rad));
    EXPECT_TRUE(test::same(a.height_m, b.height_m));
    EXPECT_EQ(a.own_label, b.own_label);
    EXPECT_EQ(a.label, b.label);
    EXPECT_EQ(a.component, b.component);
    EXPECT_EQ(a.roi, b.roi);
}

/// A sensor, its settings and scans, and the results of a filter running alone.
struct Drive {
    SensorModel sensor;
    Options options;
    std::vector<Scan> scans;
    std::vector<Segmented> alone;

    Drive(const std::string& name, const Options& with, int columns)
        : sensor(sensorModel(name)), options(test::numbered(with)), scans(drive(sensor, columns)) {
        HagenFilter filter(sensor, options);
        for (const Scan& scan : scans) alone.push_back(outcomeOf(filter.segment(scan)));
    }
};

std::vector<Drive> differentDrives() {
    Options alarmed;
    alarmed.ground_is_roi_below_m = 1.5f;
    alarmed.columns = 500;
    return {Drive("VLP-16", Options(), 870), Drive("HDL-64E", alarmed, 600),
            Drive("HDL-32E", test::paperOptions(), 700)};
}

TEST(FilterWorkspace, FiltersInOneThreadAreIndependent) {
    const std::vector<Drive> drives = differentDrives();
    std::vector<HagenFilter> filters;
    for (const Drive& drive : drives) filters.emplace_back(drive.sensor, drive.options);
    std::vector<const SegmentationResult*> results(drives.size());
    for (std::size_t n = 0; n < drives.front().scans.size(); ++n) {
        for (std::size_t k = 0; k < drives.size(); ++k) {
            results[k] = &filters[k].segment(drives[k].scans[n]);
        }
        for (std::size_t k = 0; k < drives.size(); ++k) {
            SCOPED_TRACE(drives[k].sensor.name + ", scan " + std::to_string(n));
            expectSame(outcomeOf(*results[k]), drives[k].alone[n]);
        }
    }
}

TEST(FilterWorkspace, FiltersInThreadsAreIndependent) {
    const std::vector<Drive> drives = differentDrives();
    std::vector<std::vector<Segmented>> found(drives.size());
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < drives.size(); ++k) {
        threads.emplace_back([&, k] {
            HagenFilter filter(drives[k].sensor, drives[k].options);
            for (const Scan& scan : drives[k].scans) {
                found[k].push_back(outcomeOf(filter.segment(scan)));
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (std::size_t k = 0; k < drives.size(); ++k) {
        for (std::size_t n = 0; n < found[k].size(); ++n)
            expectSame(found[k][n], drives[k].alone[n]);
    }
}

TEST(FilterWorkspace, CopiesAndMovedFiltersAreIndependent) {
    const Drive drive("VLP-16", Options(), 870);
    auto first = std::make_unique<HagenFilter>(drive.sensor, drive.options);
    first->segment(drive.scans[0]);
    HagenFilter copy = *first;
    HagenFilter moved = std::move(*first);
    first.reset();
    for (std::size_t n = 0; n < drive.scans.size(); ++n) {
        expectSame(outcomeOf(copy.segment(drive.scans[n])), drive.alone[n]);
        expectSame(outcomeOf(moved.segment(drive.scans[n])), drive.alone[n]);
    }
}

}  // namespace
}  // namespace hagen
