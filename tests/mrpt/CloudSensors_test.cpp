#include <gmock/gmock.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/scan/Angle.h>
#include <hagen/settings/CloudSensors.h>
#include "mrpt/Results.h"

#include "support/Random.h"
#include "support/SimpleFirings.h"
#include "support/SimpleScene.h"

namespace hagen::observations {
namespace {

using testing::HasSubstr;

void add(const Eigen::Vector3d& point_m, Scan& scan) {
    scan.x_m.push_back(static_cast<float>(point_m.x()));
    scan.y_m.push_back(static_cast<float>(point_m.y()));
    scan.z_m.push_back(static_cast<float>(point_m.z()));
    scan.intensity.push_back(0.5f);
}

/// Returns of these beams inside a sphere.
Scan scanOf(const std::vector<double>& beams_deg, int columns = 400) {
    Scan scan;
    for (int column = 0; column < columns; ++column) {
        for (const double beam_deg : beams_deg) {
            const double azimuth_rad = kPi - 2 * kPi * (column + 0.5) / columns;
            add(10 * test::directionOf(azimuth_rad, radians(beam_deg)), scan);
        }
    }
    return scan;
}

Scan scanOfModel(const std::string& model, int columns = 400) {
    std::vector<double> beams_deg;
    for (const float beam_rad : sensorModel(model).elevations_rad) {
        beams_deg.push_back(degrees(static_cast<double>(beam_rad)));
    }
    return scanOf(beams_deg, columns);
}

Scan withoutRings(int returns) {
    test::Random random(1);
    Scan scan;
    for (int i = 0; i < returns; ++i) {
        const auto azimuth_rad = static_cast<double>(random.real(-3.1f, 3.1f));
        add(10 * test::directionOf(azimuth_rad, static_cast<double>(random.real(-0.1f, 0.9f))),
            scan);
    }
    return scan;
}

mrpt::obs::CObservationPointCloud::Ptr cloudOf(const Scan& scan, const std::string& label) {
    return observationOf(scan, label, mrpt::Clock::fromDouble(1.0));
}

SharedBeams beamsOf(const Scan& scan) {
    CloudSensors sensors;
    sensors.see("a", scan);
    return sensors.beamsOf("a");
}

TEST(CloudSensors, RecoversModelFromFirstCloud) {
    for (const std::string model : {"VLP-16", "HDL-64E"}) {
        const SharedBeams beams = beamsOf(scanOfModel(model));
        ASSERT_TRUE(beams);
        EXPECT_EQ(beams->sensor.name, model);
        EXPECT_EQ(beams->sensor.elevations_rad, sensorModel(model).elevations_rad);
    }
}

TEST(CloudSensors, UsesVirtualRowsWithoutRings) {
    const SharedBeams beams = beamsOf(withoutRings(20000));
    ASSERT_TRUE(beams);
    EXPECT_FALSE(beams->sensor.has_rings);
    EXPECT_GE(beams->sensor.rows(), 16);
}

TEST(CloudSensors, IgnoresSparseClouds) {
    Scan padded = scanOfModel("VLP-16", 24);  // 384 returns
    for (int i = 0; i < 1000; ++i) {
        const float missing = i % 2 == 0 ? 0.0f : kNoValue;
        for (auto* coordinate : {&padded.x_m, &padded.y_m, &padded.z_m}) {
            coordinate->push_back(missing);
        }
    }
    CloudSensors sensors;
    EXPECT_FALSE(sensors.beamsOf("a"));
    for (int i = 0; i < 20; ++i) {
        sensors.see("a", Scan());
        sensors.see("a", padded);
    }
    EXPECT_FALSE(sensors.beamsOf("a"));
    EXPECT_FALSE(sensors.isSettled("a"));
    sensors.see("a", scanOfModel("VLP-16"));
    EXPECT_TRUE(sensors.beamsOf("a"));
}

TEST(CloudSensors, NeedsThreeBeams) {
    EXPECT_FALSE(beamsOf(scanOf({-3, 4})));
    EXPECT_EQ(beamsOf(scanOf({-3, 1, 4}))->sensor.rows(), 3);
}

TEST(CloudSensors, UsesFullestOfFiveClouds) {
    const std::vector<double> below{-20, -15, -11}, all{-20, -15, -11, -4, 2, 11};
    CloudSensors sensors;
    const auto rowsAfter = [&](const Scan& scan) {
        sensors.see("a", scan);
        return sensors.beamsOf("a")->sensor.rows();
    };
    EXPECT_EQ(rowsAfter(scanOf(below)), 3);
    EXPECT_EQ(rowsAfter(scanOf(all)), 6);
    EXPECT_EQ(rowsAfter(scanOf(below)), 6);
    EXPECT_EQ(rowsAfter(scanOf({-19, -14, -10, -3, 3, 12})), 6);  // equally full, but later
    EXPECT_NEAR(degrees(sensors.beamsOf("a")->sensor.elevations_rad[0]), -20, 0.02);
    EXPECT_FALSE(sensors.isSettled("a"));
    EXPECT_EQ(rowsAfter(scanOf(below)), 6);
    EXPECT_TRUE(sensors.isSettled("a"));
    const SharedBeams settled = sensors.beamsOf("a");
    EXPECT_EQ(rowsAfter(scanOfModel("VLP-16")), 6);
    EXPECT_EQ(sensors.beamsOf("a"), settled);
}

TEST(CloudSensors, SeparatesSensorLabels) {
    CloudSensors sensors;
    showCloud(*cloudOf(scanOfModel("VLP-16"), "front"), sensors);
    showCloud(*cloudOf(scanOfModel("HDL-32E"), "rear"), sensors);
    EXPECT_EQ(sensors.beamsOf("front")->sensor.name, "VLP-16");
    EXPECT_EQ(sensors.beamsOf("rear")->sensor.name, "HDL-32E");
    EXPECT_FALSE(sensors.beamsOf("top"));
}

TEST(CloudSensors, UsesVelodyneCloudWithoutPackets) {
    mrpt::obs::CObservationVelodyneScan observation;
    const Scan scan = scanOfModel("VLP-16");
    auto& cloud = observation.point_cloud;
    cloud.x.assign(scan.x_m.begin(), scan.x_m.end());
    cloud.y.assign(scan.y_m.begin(), scan.y_m.end());
    cloud.z.assign(scan.z_m.begin(), scan.z_m.end());
    cloud.intensity.assign(scan.size(), 7);
    CloudSensors sensors;
    showCloud(observation, sensors);
    EXPECT_EQ(sensors.beamsOf("")->sensor.name, "VLP-16");
}

TEST(CloudSensors, IgnoresOtherObservations) {
    CloudSensors sensors;
    auto packets = test::poleScanFrom(0, "a");
    const Scan scan = scanOfModel("VLP-16");
    showCloud(*packets, sensors);
    const auto cloud = cloudOf(scan, "a");
    showCloud(*resultOf(*cloud, true, cloud->pointcloud), sensors);
    mrpt::obs::CObservationPointCloud empty;  // unreadable
    empty.sensorLabel = "a";
    showCloud(empty, sensors);
    mrpt::obs::CObservationVelodyneScan torn;
    torn.sensorLabel = "a";
    torn.point_cloud.x = {1, 2};
    showCloud(torn, sensors);
    for (const char* label : {"a", "a_roi"}) EXPECT_FALSE(sensors.beamsOf(label)) << label;
}

TEST(CloudSensors, DescribesRecoveredBeams) {
    EXPECT_EQ(textOf(beamsOf(scanOfModel("VLP-16"))),
              "16 beams recovered (VLP-16), 100.0 % of the returns lie on them");
    EXPECT_EQ(textOf(beamsOf(scanOf({-15, -13, -11, -9, -7, -5}))),
              "6 beams recovered (VLP-16, which has 16), 100.0 % of the returns lie on them");
    EXPECT_EQ(textOf(beamsOf(scanOf({-12, -3.3, 4}))),
              "3 beams recovered, 100.0 % of the returns lie on them");
    const SharedBeams none = beamsOf(withoutRings(20000));
    EXPECT_EQ(textOf(none),
              "no beams found, using " + std::to_string(none->sensor.rows()) + " virtual rows");
    EXPECT_THAT(textOf(nullptr), HasSubstr("assuming VLP-16"));
    RecoveredBeams nearly = *beamsOf(scanOfModel("VLP-16"));
    nearly.share = 0.9999f;
    EXPECT_THAT(textOf(std::make_shared<RecoveredBeams>(nearly)), HasSubstr(" 99.9 %"));
}

}  // namespace
}  // namespace hagen::observations
