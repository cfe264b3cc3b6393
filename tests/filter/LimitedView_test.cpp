#include <gtest/gtest.h>
#include <hagen/filter/HagenFilter.h>
#include <hagen/scan/Angle.h>

#include <cmath>

#include "scan/AppendReturn.h"
#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

/// A sensor that is silent in a sector gets the labels of a full turn beyond the sector's edges.
TEST(LimitedView, LabelsEqualThoseOfFullTurn) {
    constexpr double kEdge_deg = 10;
    const SensorModel sensor = sensorModel("VLP-16");
    const test::SimpleScene scene = test::sceneOf(
        {{{-12, -6, 0}, {-11, 6, 4}}, {{4, 5, 0}, {6, 7, 1}}}, {{8, 3, 0.2, 6}, {-3, -7, 0.1, 5}});
    HagenFilter filter(sensor);
    const Scan full = test::scanScene(scene, sensor, filter.options().columns, {0, 0, 2}).scan;
    const std::vector<Label> expected = filter.segment(full).returns.label;
    test::Random random(4);
    for (int trial = 0; trial < 40; ++trial) {
        const double from_deg = random.whole(0, 359), width_deg = random.whole(10, 350);
        Scan limited;
        std::vector<Label> of_full;
        std::vector<bool> is_inner;
        for (std::size_t i = 0; i < full.size(); ++i) {
            const double turned_deg = degrees(-static_cast<double>(full.azimuth_rad[i])) - from_deg;
            const double after_deg = turned_deg - 360 * std::floor(turned_deg / 360);
            if (after_deg < width_deg) continue;
            appendReturn(full, i, limited);
            of_full.push_back(expected[i]);
            is_inner.push_back(after_deg > width_deg + kEdge_deg && after_deg < 360 - kEdge_deg);
        }
        const std::vector<Label>& found = filter.segment(limited).returns.label;
        std::size_t differ = 0, inner = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            inner += is_inner[i];
            differ += is_inner[i] && found[i] != of_full[i];
        }
        EXPECT_LE(differ, 1 + inner / 1000) << "silent from " << from_deg << " over " << width_deg;
    }
}

}  // namespace
}  // namespace hagen
