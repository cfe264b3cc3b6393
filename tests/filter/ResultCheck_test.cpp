#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/filter/ResultCheck.h>

#include <algorithm>
#include <functional>
#include <string>

#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// The warnings about scans of a box and a pole on flat ground, changed before they are labelled.
std::vector<std::string> warningsFor(const std::function<void(Scan&)>& change, int changed = 3,
                                     const SensorModel& sensor = sensorModel("VLP-16")) {
    const test::SimpleScene scene = test::sceneOf({{{-12, -6, 0}, {-11, 6, 4}}}, {{8, 3, 0.2, 6}});
    ResultCheck check;
    HagenFilter filter(sensor);
    for (int i = 0; i < 5; ++i) {
        Scan scan = test::scanScene(scene, sensor, filter.options().columns, {0, 0, 2}).scan;
        for (const float azimuth_rad : scan.azimuth_rad) {
            scan.time_s.push_back(0.1f * (0.5f - azimuth_rad / 6.2832f));
        }
        if (i < changed) change(scan);
        locateBeams(sensor, scan);
        check.add(scan, filter.segment(scan).returns.label, sensor, filter.options());
    }
    EXPECT_EQ(check.scans(), 5u);
    return check.warnings();
}

std::function<void(Scan&)> scaledBy(float factor) {
    return [factor](Scan& scan) {
        for (auto* values : {&scan.x_m, &scan.y_m, &scan.z_m}) {
            for (float& value : *values) value *= factor;
        }
    };
}

/// Gives each return another range, in its direction.
void setRanges(const std::function<float(std::size_t)>& range_m, Scan& scan) {
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const float factor = range_m(i) / scan.range_m[i];
        scan.x_m[i] *= factor;
        scan.y_m[i] *= factor;
        scan.z_m[i] *= factor;
    }
}

TEST(ResultCheck, AcceptsPlausibleScans) {
    EXPECT_THAT(warningsFor([](Scan&) {}), IsEmpty());
    EXPECT_THAT(warningsFor(scaledBy(1000), 2), IsEmpty());  // not most scans
}

TEST(ResultCheck, ProposesMountWithGround) {
    EXPECT_THAT(warningsFor([](Scan& scan) {
                    for (float& y_m : scan.y_m) y_m = -y_m;
                    for (float& z_m : scan.z_m) z_m = -z_m;
                }),
                ElementsAre(AllOf(HasSubstr("no ground was found in 3 of 5 scans"),
                                  HasSubstr("With --set sensor.mount_roll_deg=180, 3 of 3"))));
}

TEST(ResultCheck, ReportsWrongUnits) {
    EXPECT_THAT(warningsFor(scaledBy(1000)),
                testing::IsSupersetOf({HasSubstr("no obstacle was found in 3 of 5 scans"),
                                       HasSubstr("farther than 200 m in 3 of 5 scans")}));
    EXPECT_THAT(warningsFor(scaledBy(0.01f)),
                testing::Contains(HasSubstr("nearer than 0.3 m in 3 of 5 scans")));
}

TEST(ResultCheck, ReportsRepeatedRange) {
    EXPECT_THAT(warningsFor([](Scan& scan) { setRanges([](std::size_t) { return 5.0f; }, scan); }),
                testing::Contains(HasSubstr("most returns have the same range, 5 m")));
}

TEST(ResultCheck, ReportsShuffledRanges) {
    EXPECT_THAT(warningsFor([](Scan& scan) {
                    std::vector<float> mixed_m = scan.range_m;
                    std::shuffle(mixed_m.begin(), mixed_m.end(), test::Random(1).engine());
                    setRanges([&](std::size_t i) { return mixed_m[i]; }, scan);
                }),
                testing::Contains(HasSubstr("neighbouring returns are not near each other")));
}

TEST(ResultCheck, ReportsTimesThatContradictSweep) {
    const auto shuffled = [](Scan& scan) {
        std::vector<float> of_part(72);
        test::Random random(1);
        for (float& time_s : of_part) time_s = random.real(0, 0.1f);
        for (std::size_t i = 0; i < scan.size(); ++i) {
            const float turned = 0.5f - scan.azimuth_rad[i] / 6.2832f;
            scan.time_s[i] = of_part[static_cast<std::size_t>(71 * std::clamp(turned, 0.0f, 1.0f))];
        }
    };
    EXPECT_THAT(warningsFor(shuffled), ElementsAre(HasSubstr("times of the returns contradict")));
    const auto normalised = [](Scan& scan) {
        for (float& time_s : scan.time_s) time_s *= 10;
    };
    EXPECT_THAT(warningsFor(normalised), ElementsAre(HasSubstr("they span 1.00 s")));
    SensorModel without_rings = sensorModel("Mid-360");
    EXPECT_THAT(warningsFor(shuffled, 3, without_rings), IsEmpty());
}

}  // namespace
}  // namespace hagen
