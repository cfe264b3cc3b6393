#include <gmock/gmock.h>
#include <hagen/scan/MostReturns.h>
#include <hagen/scan/RangeImage.h>
#include <hagen/scan/Scan.h>

#include <limits>
#include <utility>

#include "support/Program.h"

namespace hagen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Scan pointsOf(std::size_t returns) {
    Scan scan;
    scan.x_m.assign(returns, 5.0f);
    scan.y_m.assign(returns, 1.0f);
    scan.z_m.assign(returns, 0.1f);
    return scan;
}

Scan locatedWith(const SensorModel& sensor, std::size_t returns = 3) {
    Scan scan = pointsOf(returns);
    locateBeams(sensor, scan);
    return scan;
}

/// The error message of checkLocated(); empty if it accepts the scan.
std::string objection(const Scan& scan, const SensorModel& sensor) {
    return test::messageOf<std::invalid_argument>([&] { checkLocated(scan, sensor); });
}

TEST(CheckLocated, RejectsTooManyReturns) {
    Scan scan;
    scan.x_m.resize(kMaxReturns + 1);
    EXPECT_EQ(objection(scan, sensorModel("VLP-16")),
              "the scan has 16777217 returns; the maximum is 16777216");
    scan.x_m.resize(kMaxReturns);
    EXPECT_THAT(objection(scan, sensorModel("VLP-16")), HasSubstr("differ in number"));
}

TEST(CheckLocated, AcceptsLocatedScans) {
    for (const std::string& name : knownSensorModels()) {
        EXPECT_EQ(objection(locatedWith(sensorModel(name)), sensorModel(name)), "");
        EXPECT_EQ(objection(Scan(), sensorModel(name)), "");
    }
}

TEST(CheckLocated, RejectsUnlocatedScan) {
    EXPECT_THAT(objection(pointsOf(3), sensorModel("VLP-16")),
                AllOf(HasSubstr("3 returns"), HasSubstr("call locateBeams()")));
    Scan grown = locatedWith(sensorModel("VLP-16"));
    for (auto* values : {&grown.x_m, &grown.y_m, &grown.z_m}) values->push_back(1.0f);
    EXPECT_THAT(objection(grown, sensorModel("VLP-16")), HasSubstr("call locateBeams()"));
}

TEST(CheckLocated, RejectsShortArrays) {
    const SensorModel sensor = sensorModel("VLP-16");
    Scan scan = locatedWith(sensor);
    for (auto* values : {&scan.range_m, &scan.azimuth_rad, &scan.y_m, &scan.z_m}) {
        const float last = values->back();
        values->pop_back();
        EXPECT_NE(objection(scan, sensor), "");
        values->push_back(last);
    }
    EXPECT_EQ(objection(scan, sensor), "");
    scan.row.pop_back();
    EXPECT_NE(objection(scan, sensor), "");
}

TEST(CheckLocated, RejectsRowsFromOtherSensor) {
    EXPECT_THAT(objection(locatedWith(sensorModel("VLP-16")), sensorModel("HDL-64E")),
                AllOf(HasSubstr("16 beams from -15 to 15 degrees"), HasSubstr("HDL-64E"),
                      HasSubstr("64 beams"), HasSubstr("call locateBeams()")));
    // the same number of beams at other angles
    EXPECT_NE(objection(locatedWith(sensorModel("VLP-16")), sensorModel("Puck Hi-Res")), "");
    EXPECT_NE(objection(locatedWith(sensorModel("HDL-32E")), sensorModel("VLP-32C")), "");
}

TEST(CheckLocated, ToleratesCalibration) {
    const Scan scan = locatedWith(customSensorModel({-10, 0, 10}));
    EXPECT_EQ(objection(scan, customSensorModel({-10.9, 0, 10.9})), "");
    EXPECT_NE(objection(scan, customSensorModel({-11.1, 0, 10})), "");
    EXPECT_NE(objection(scan, customSensorModel({-10, 0, 8.9})), "");
}

TEST(CheckLocated, RejectsRowsBeyondUnnamedSensor) {
    Scan scan = locatedWith(sensorModel("HDL-64E"), 1000);
    scan.beams = {};
    scan.row.assign(1000, 15);
    EXPECT_EQ(objection(scan, sensorModel("VLP-16")), "");
    for (const std::size_t i : {std::size_t{0}, std::size_t{517}, std::size_t{999}}) {
        scan.row.assign(1000, 15);
        scan.row[i] = 16;
        EXPECT_THAT(objection(scan, sensorModel("VLP-16")),
                    AllOf(HasSubstr("row 16"), HasSubstr("16 beams")));
    }
}

TEST(CheckLocated, RejectsRowsBeyondNamedSensor) {
    Scan scan = locatedWith(sensorModel("VLP-16"));
    scan.row.back() = 16;
    EXPECT_THAT(objection(scan, sensorModel("VLP-16")), HasSubstr("a return in row 16"));
}

TEST(CheckLocated, RejectsRangeWithoutPosition) {
    const SensorModel sensor = sensorModel("VLP-16");
    for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()}) {
        Scan scan = locatedWith(sensor);
        for (auto* values : {&scan.x_m, &scan.y_m, &scan.z_m}) {
            const float good = std::exchange(values->back(), bad);
            EXPECT_THAT(objection(scan, sensor), HasSubstr("non-finite coordinates"));
            values->back() = good;
        }
        EXPECT_EQ(objection(scan, sensor), "");
        scan.x_m.back() = bad;
        scan.range_m.back() = std::nanf("");
        EXPECT_EQ(objection(scan, sensor), "");
    }
}

TEST(CheckLocated, ProjectionChecksScan) {
    RangeImage image;
    ProjectionWorkspace work;
    const SensorModel sensor = sensorModel("VLP-16");
    EXPECT_THROW(projectScan(pointsOf(3), sensor, 870, 20.0f, image, work), std::invalid_argument);
    EXPECT_THROW(projectScan(locatedWith(sensorModel("HDL-32E")), sensor, 870, 20.0f, image, work),
                 std::invalid_argument);
    EXPECT_NO_THROW(projectScan(locatedWith(sensor), sensor, 870, 20.0f, image, work));
}

}  // namespace
}  // namespace hagen
