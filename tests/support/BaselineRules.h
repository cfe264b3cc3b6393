#pragma once
#include <gtest/gtest.h>
#include <hagen/evaluation/Baselines.h>

#include "support/PointScan.h"
#include "support/Random.h"

namespace hagen::test {

/// Checks rules for all baselines: one label per return, range limits like the filter, reproducible
/// labels, and no labels for an empty scan.
inline void expectBaselineRules(const evaluation::Baseline& baseline, float zone_m) {
    SCOPED_TRACE(baseline.name);
    EXPECT_FALSE(baseline.source.empty());
    EXPECT_FALSE(baseline.parameters.empty());
    const SensorModel sensor = sensorModel("VLP-16");
    EXPECT_TRUE(baseline.segment({}, sensor).empty());

    const SimpleScene scene = sceneOf({}, {{5.0, 2.0, 0.2, 4.0}});
    Scan scan = scanScene(scene, sensor, 360, {0.0, 0.0, 1.5}).scan;
    Random random(11);
    for (int i = 0; i < 500; ++i) {  // random returns unlike any scene
        scan.x_m.push_back(random.real(-30.0f, 30.0f));
        scan.y_m.push_back(random.chance(0.1) ? kNoValue : random.real(-30.0f, 30.0f));
        scan.z_m.push_back(random.real(-8.0f, 8.0f));
        scan.intensity.push_back(0.5f);
    }
    for (std::vector<float>* values : {&scan.x_m, &scan.y_m, &scan.z_m}) values->push_back(0.0f);
    scan.intensity.push_back(0.5f);
    locateBeams(sensor, scan);

    const std::vector<Label> labels = baseline.segment(scan, sensor);
    ASSERT_EQ(labels.size(), scan.size());
    EXPECT_EQ(baseline.segment(scan, sensor), labels);
    int roi = 0, rou = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const bool is_seen = sensor.sees(scan.range_m[i]);
        EXPECT_EQ(labels[i] == Label::Unclassified, !is_seen) << "return " << i;
        if (is_seen && scan.range_m[i] > zone_m) {
            EXPECT_EQ(labels[i], Label::Rou) << "return " << i;
        } else {
            roi += labels[i] == Label::Roi;
            rou += labels[i] == Label::Rou;
        }
    }
    EXPECT_GT(roi, 0);
    EXPECT_GT(rou, 0);
}

}  // namespace hagen::test
