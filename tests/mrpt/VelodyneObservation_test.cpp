#include <gmock/gmock.h>
#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/scan/Angle.h>
#include "mrpt/VelodyneEncoder.h"

#include <cmath>
#include <cstring>
#include <utility>

#include "support/Captures.h"
#include "support/InstructionSets.h"
#include "support/LaserRows.h"
#include "support/Program.h"
#include "support/Random.h"
#include "support/SimpleFirings.h"

namespace hagen::observations {
namespace {

using testing::HasSubstr;

using mrpt::obs::CObservationVelodyneScan;

/// Indices of our returns that MRPT also decodes: the first 16 in each block.
std::vector<std::size_t> returnsInFirstHalfOfBlocks(const CObservationVelodyneScan& observation) {
    std::vector<std::size_t> indices;
    std::size_t index = 0;
    for (const auto& packet : observation.scan_packets) {
        for (const auto& block : packet.blocks) {
            for (int i = 0; i < 32; ++i) {
                if (block.laser_returns[i].distance() == 0) continue;
                const double range_m = block.laser_returns[i].distance() * 0.002;
                const bool in_range =
                    range_m >= observation.minRange && range_m <= observation.maxRange;
                if (i < 16 && in_range) indices.push_back(index);
                ++index;
            }
        }
    }
    return indices;
}

void expectMrptAgrees(CObservationVelodyneScan observation) {
    Scan scan;
    EXPECT_EQ(decodePackets(observation, scan), 0u);
    const auto shared = returnsInFirstHalfOfBlocks(observation);
    observation.generatePointCloud();
    const auto& cloud = observation.point_cloud;
    ASSERT_EQ(cloud.size(), shared.size());
    for (std::size_t i = 0; i < shared.size(); ++i) {
        const double distance_m =
            std::hypot(scan.x_m[shared[i]] - cloud.x[i], scan.y_m[shared[i]] - cloud.y[i],
                       scan.z_m[shared[i]] - cloud.z[i]);
        ASSERT_LT(distance_m, 0.01) << "MRPT's return " << i;
        ASSERT_EQ(static_cast<int>(std::lround(255 * scan.intensity[shared[i]])),
                  cloud.intensity[i]);
    }
}

TEST(VelodyneObservation, DecodesWholeRealScan) {
    const auto observation = test::realVlp16Scan();
    if (!observation) GTEST_SKIP() << "mrpt-common is not installed";
    Scan scan;
    EXPECT_EQ(decodePackets(*observation, scan), 0u);
    EXPECT_EQ(scan.size(), 22591u);
    expectMrptAgrees(*observation);
}

TEST(VelodyneObservation, MatchesMrptOnCaptures) {
    const auto folder = test::dataFolder("HAGEN_VELODYNE_DATA");
    if (folder.empty()) GTEST_SKIP() << "HAGEN_VELODYNE_DATA is not a folder of captures";
    for (const auto& [file, calibration] : {std::pair{"sample_velodyne_vlp16_gps.pcap", "VLP16"},
                                            {"sample_velodyne_hdl32.pcap", "HDL32"}}) {
        const auto observation = test::readCapture(folder / file, calibration);
        ASSERT_GT(observation->scan_packets.size(), 100u) << file;
        expectMrptAgrees(*observation);
    }
}

TEST(VelodyneObservation, MatchesMrptWithCorrections) {
    auto observation = test::realVlp16Scan();
    if (!observation) GTEST_SKIP() << "mrpt-common is not installed";
    test::Random random(50);
    for (auto& laser : observation->calibration.laser_corrections) {
        laser.distanceCorrection = static_cast<double>(random.real(-0.2f, 0.2f));
        laser.verticalOffsetCorrection = static_cast<double>(random.real(-0.05f, 0.05f));
        laser.horizontalOffsetCorrection = static_cast<double>(random.real(-0.05f, 0.05f));
    }
    observation->minRange = 0.0;
    expectMrptAgrees(*observation);
}

/// Firings with random ranges, some missing.
Firings randomFirings(unsigned seed, const sensors::VelodyneModel& model, int count,
                      double missing) {
    test::Random random(seed);
    Firings firings;
    firings.range_m = random.image(model.lasers, count, 0.6f, 120.0f, missing);
    firings.intensity = random.image(model.lasers, count, 0.0f, 1.0f, 0.0);
    firings.first_azimuth_deg = 200.0;
    return firings;
}

void expectReturns(const sensors::VelodyneModel& model, const Firings& firings, const Scan& scan) {
    const auto rows = test::rowsOfLasers(sensors::defaultCalibration(model));
    std::size_t i = 0;
    for (int firing = 0; firing < firings.range_m.cols(); ++firing) {
        for (int laser = 0; laser < model.lasers; ++laser) {
            const float range_m = firings.range_m(laser, firing);
            if (!hasValue(range_m)) continue;
            ASSERT_LT(i, scan.size());
            const double azimuth_rad =
                -radians(test::firingAzimuthDeg(model, firings, laser, firing));
            const double turned =
                std::remainder(static_cast<double>(scan.azimuth_rad[i]) - azimuth_rad, 2 * kPi);
            ASSERT_LT(std::abs(degrees(turned)), 0.016);  // azimuths are rounded to 0.01 twice
            ASSERT_NEAR(scan.range_m[i], range_m, 0.5f * model.distance_unit_m + 1e-5f);
            ASSERT_EQ(scan.row[i], rows[laser]);
            ASSERT_NEAR(scan.intensity[i], firings.intensity(laser, firing), 0.5 / 255 + 1e-6);
            ASSERT_NEAR(std::hypot(scan.x_m[i], scan.y_m[i], scan.z_m[i]), range_m,
                        model.distance_unit_m);
            ASSERT_NEAR(std::remainder(std::atan2(scan.y_m[i], scan.x_m[i]) - scan.azimuth_rad[i],
                                       static_cast<float>(2 * kPi)),
                        0.0, 1e-5);
            ++i;
        }
    }
    ASSERT_EQ(i, scan.size());
}

TEST(VelodyneObservation, InvertsEncoding) {
    for (const char* name : {"VLP-16", "Puck Hi-Res", "HDL-32E", "VLP-32C", "VLS-128"}) {
        const sensors::VelodyneModel& model = sensors::velodyneModel(name);
        for (unsigned seed = 51; seed < 55; ++seed) {
            const Firings firings = randomFirings(seed, model, 24 * 40, 0.3);
            Scan scan;
            EXPECT_EQ(decodePackets(*encodeScan(model, firings), scan), 0u);
            expectReturns(model, firings, scan);
        }
    }
}

TEST(VelodyneObservation, DecodesDualReturns) {
    for (const char* name : {"VLP-16", "Puck Hi-Res", "HDL-32E", "VLP-32C", "VLS-128"}) {
        const sensors::VelodyneModel& model = sensors::velodyneModel(name);
        Firings firings = randomFirings(55, model, 240, 0.0);
        firings.last_range_m = firings.range_m + 1.0f;
        Scan scan;
        EXPECT_EQ(decodePackets(*encodeScan(model, firings), scan), 0u);
        ASSERT_EQ(scan.size(), static_cast<std::size_t>(2 * firings.range_m.size()));

        Scan strongest, last;  // alternating blocks
        for (std::size_t i = 0; i < scan.size(); ++i) {
            Scan& half = i / 32 % 2 == 0 ? last : strongest;
            half.x_m.push_back(scan.x_m[i]);
            half.y_m.push_back(scan.y_m[i]);
            half.z_m.push_back(scan.z_m[i]);
            half.range_m.push_back(scan.range_m[i]);
            half.azimuth_rad.push_back(scan.azimuth_rad[i]);
            half.row.push_back(scan.row[i]);
            half.intensity.push_back(scan.intensity[i]);
        }
        expectReturns(model, firings, strongest);
        firings.range_m = firings.last_range_m;
        expectReturns(model, firings, last);
    }
}

TEST(VelodyneObservation, TimesIncreaseAcrossHour) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
    Firings firings = randomFirings(56, model, 240, 0.0);
    firings.first_time_us = 3599995000u;
    Scan scan;
    decodePackets(*encodeScan(model, firings), scan);
    for (std::size_t i = 1; i < scan.size(); ++i) ASSERT_GT(scan.time_s[i], scan.time_s[i - 1]);
    EXPECT_EQ(scan.time_s.front(), 0.0f);
    EXPECT_NEAR(scan.time_s.back(), 1e-6 * (239 * 55.296 + 15 * 2.304), 2e-6);
}

TEST(VelodyneObservation, AcceptsPacketsOutOfOrder) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
    Firings firings = randomFirings(57, model, 240, 0.0);
    for (const std::uint32_t first_us : {5000u, 3599999000u}) {
        firings.first_time_us = first_us;
        const auto packets = encodeScan(model, firings);
        Scan in_order, late;
        decodePackets(*packets, in_order);
        std::swap(packets->scan_packets[0], packets->scan_packets[1]);
        decodePackets(*packets, late);
        ASSERT_EQ(late.size(), in_order.size());
        std::sort(late.time_s.begin(), late.time_s.end());
        const double packet_s = 1e-6 * 24 * 55.296;
        for (std::size_t i = 0; i < late.size(); ++i) {
            ASSERT_NEAR(late.time_s[i], static_cast<double>(in_order.time_s[i]) - packet_s, 3e-6);
        }
    }
}

TEST(VelodyneObservation, RejectsExcessivePackets) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
    const auto scan = encodeScan(model, randomFirings(58, model, 24, 0.0));
    Scan decoded;
    scan->scan_packets.resize(43691, scan->scan_packets.front());  // 16777344 returns
    EXPECT_THAT(test::messageOf([&] { decodePackets(*scan, decoded); }),
                testing::HasSubstr("16777344 returns; a scan may have at most 16777216"));
    EXPECT_EQ(decoded.size(), 0u);
}

/// Changes a byte of a packet in its transmitted form.
void setByte(CObservationVelodyneScan& observation, std::size_t packet, int byte,
             std::uint8_t value) {
    std::uint8_t bytes[CObservationVelodyneScan::PACKET_SIZE];
    std::memcpy(bytes, &observation.scan_packets[packet], sizeof bytes);
    bytes[byte] = value;
    std::memcpy(static_cast<void*>(&observation.scan_packets[packet]), bytes, sizeof bytes);
}

/// A random scan: any part of a revolution and any share of missing returns. Half of the scans have
/// dual returns, half a calibration with all corrections.
CObservationVelodyneScan::Ptr randomObservation(test::Random& random) {
    const char* const names[] = {"VLP-16", "Puck Hi-Res", "HDL-32E", "VLP-32C", "VLS-128"};
    const sensors::VelodyneModel& model = sensors::velodyneModel(names[random.whole(0, 4)]);
    const double missing = random.chance(0.2) ? 1.0 : static_cast<double>(random.real(0.0f, 0.9f));
    Firings firings = randomFirings(static_cast<unsigned>(random.whole(0, 1000000)), model,
                                    random.whole(1, 600), missing);
    firings.first_azimuth_deg = static_cast<double>(random.real(0.0f, 360.0f));
    firings.azimuth_step_deg = static_cast<double>(random.real(-0.7f, 0.7f));
    if (random.chance(0.5)) firings.last_range_m = firings.range_m + 1.0f;
    const auto observation = encodeScan(model, firings);
    if (random.chance(0.5)) return observation;
    for (auto& laser : observation->calibration.laser_corrections) {
        const float max_deg = random.chance(0.1) ? 500.0f : 6.0f;
        laser.azimuthCorrection = static_cast<double>(random.real(-max_deg, max_deg));
        laser.distanceCorrection = static_cast<double>(random.real(-0.2f, 0.2f));
        laser.verticalOffsetCorrection = static_cast<double>(random.real(-0.05f, 0.05f));
        laser.horizontalOffsetCorrection = static_cast<double>(random.real(-0.05f, 0.05f));
    }
    return observation;
}

TEST(VelodyneObservation, IsEqualOnAllInstructionSets) {
    test::Random random(64);
    for (int round = 0; round < 20; ++round) {
        const auto observation = randomObservation(random);
        Scan best;
        decodePackets(*observation, best);
        forEachInstructionSet([&](const std::string& name) {
            SCOPED_TRACE(name);
            Scan scan;
            decodePackets(*observation, scan);
            for (std::vector<float> Scan::*const values :
                 {&Scan::x_m, &Scan::y_m, &Scan::z_m, &Scan::intensity, &Scan::range_m,
                  &Scan::azimuth_rad, &Scan::time_s}) {
                EXPECT_EQ(scan.*values, best.*values);
            }
            EXPECT_EQ(scan.row, best.row);
        });
    }
}

/// Azimuths of a slow motor may step back by 0.01 degrees.
TEST(VelodyneObservation, ToleratesBackwardReadings) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
    const auto observation = encodeScan(model, randomFirings(66, model, 24, 0.0));
    ASSERT_EQ(observation->scan_packets.size(), 1u);
    for (int block = 0; block < 12; ++block) {
        const int reading = block % 2 == 0 ? 18000 : 17999;
        setByte(*observation, 0, 100 * block + 2, static_cast<std::uint8_t>(reading & 0xff));
        setByte(*observation, 0, 100 * block + 3, static_cast<std::uint8_t>(reading >> 8));
    }
    Scan scan;
    decodePackets(*observation, scan);
    ASSERT_EQ(scan.size(), 24u * 16);
    for (const float azimuth_rad : scan.azimuth_rad) {
        ASSERT_NEAR(degrees(std::abs(azimuth_rad)), 180, 0.02);
    }
}

TEST(VelodyneObservation, CountsInvalidBlocks) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
    const auto observation = encodeScan(model, randomFirings(57, model, 240, 0.0));
    setByte(*observation, 0, 0, 0x00);        // header of block 0
    setByte(*observation, 3, 500 + 3, 0xff);  // azimuth of block 5
    Scan scan;
    EXPECT_EQ(decodePackets(*observation, scan), 2u);
    EXPECT_EQ(scan.size(), 240u * 16 - 2 * 32);
}

TEST(VelodyneObservation, RejectsOtherModels) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
    for (const auto& [id, words] : {std::pair{0x21, "differs"}, {0x99, "unknown model id 0x99"}}) {
        const auto observation = encodeScan(model, randomFirings(58, model, 240, 0.0));
        setByte(*observation, 4, 1205, static_cast<std::uint8_t>(id));
        Scan scan;
        const std::string error = test::messageOf([&] { decodePackets(*observation, scan); });
        EXPECT_THAT(error, testing::AllOf(HasSubstr("packet 4"), HasSubstr(words)));
        EXPECT_EQ(scan.size(), 0u);
    }
}

/// Corrections finite as doubles but not as floats would make coordinates undefined.
TEST(VelodyneObservation, RejectsImplausibleCorrections) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
    const auto observation = encodeScan(model, randomFirings(64, model, 24, 0.0));
    auto& laser = observation->calibration.laser_corrections.at(5);
    for (double* const correction :
         {&laser.azimuthCorrection, &laser.distanceCorrection, &laser.verticalOffsetCorrection,
          &laser.horizontalOffsetCorrection}) {
        const bool is_angle = correction == &laser.azimuthCorrection;
        for (const double wild : {1e307, -1e307, 1e30, is_angle ? 1e9 : 10.1}) {
            const double before = std::exchange(*correction, wild);
            Scan scan;
            EXPECT_THAT(test::messageOf([&] { decodePackets(*observation, scan); }),
                        HasSubstr("calibration is corrupt: laser 5"));
            *correction = before;
        }
    }
    Scan scan;
    EXPECT_NO_THROW(decodePackets(*observation, scan));
}

TEST(VelodyneObservation, AcceptsZeroPackets) {
    Scan scan;
    EXPECT_EQ(decodePackets(CObservationVelodyneScan(), scan), 0u);
    EXPECT_EQ(scan.size(), 0u);
    EXPECT_THROW(sensorOf(CObservationVelodyneScan()), std::runtime_error);
}

TEST(VelodyneObservation, DefaultsToModelCalibration) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("HDL-32E");
    const auto observation = encodeScan(model, randomFirings(59, model, 240, 0.1));
    Scan with, without;
    decodePackets(*observation, with);
    observation->calibration.clear();
    decodePackets(*observation, without);
    EXPECT_EQ(with.z_m, without.z_m);
    EXPECT_EQ(sensorOf(*observation).rows(), 32);
}

TEST(VelodyneObservation, UsesRangeLimitsFromObservation) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
    const auto observation = encodeScan(model, randomFirings(60, model, 24, 0.0));
    observation->minRange = 0.9;
    observation->maxRange = 77.0;
    EXPECT_EQ(sensorOf(*observation).min_range_m, 0.9f);
    EXPECT_EQ(sensorOf(*observation).max_range_m, 77.0f);
    EXPECT_EQ(sensorOf(*observation).name, "VLP-16");
}

const mrpt::obs::VelodyneCalibration& ofMrpt(const char* model) {
    return mrpt::obs::VelodyneCalibration::LoadDefaultCalibration(model);
}

/// Expects each number to be bitwise equal.
void expectEqual(const mrpt::obs::VelodyneCalibration& found,
                 const mrpt::obs::VelodyneCalibration& expected) {
    ASSERT_EQ(found.laser_corrections.size(), expected.laser_corrections.size());
    for (std::size_t i = 0; i < found.laser_corrections.size(); ++i) {
        const auto &a = found.laser_corrections[i], &b = expected.laser_corrections[i];
        using Laser = std::decay_t<decltype(a)>;
        for (double Laser::*const number :
             {&Laser::azimuthCorrection, &Laser::verticalCorrection, &Laser::distanceCorrection,
              &Laser::verticalOffsetCorrection, &Laser::horizontalOffsetCorrection,
              &Laser::sinVertCorrection, &Laser::cosVertCorrection, &Laser::sinVertOffsetCorrection,
              &Laser::cosVertOffsetCorrection}) {
            EXPECT_EQ(a.*number, b.*number) << i;
            EXPECT_EQ(std::signbit(a.*number), std::signbit(b.*number)) << i;  // detects -0
        }
    }
}

TEST(VelodyneObservation, DefaultCalibrationsMatchMrpt) {
    expectEqual(mrptCalibration(sensors::defaultCalibration(sensors::velodyneModel("VLP-16"))),
                ofMrpt("VLP16"));
    expectEqual(mrptCalibration(sensors::defaultCalibration(sensors::velodyneModel("HDL-32E"))),
                ofMrpt("HDL32"));
}

TEST(VelodyneObservation, CalibrationRoundTrips) {
    mrpt::obs::VelodyneCalibration calibration = ofMrpt("HDL32");
    double number = 0.01;
    for (auto& laser : calibration.laser_corrections) {
        laser.azimuthCorrection = number += 0.01;
        laser.distanceCorrection = number += 0.01;
        laser.verticalOffsetCorrection = number += 0.01;
        laser.horizontalOffsetCorrection = number += 0.01;
        laser.sinVertOffsetCorrection = laser.verticalOffsetCorrection * laser.sinVertCorrection;
        laser.cosVertOffsetCorrection = laser.verticalOffsetCorrection * laser.cosVertCorrection;
    }
    sensors::VelodyneCalibration read =
        sensors::defaultCalibration(sensors::velodyneModel("VLP-16"));  // replaced
    readCalibration(calibration, read);
    expectEqual(mrptCalibration(read), calibration);
}

}  // namespace
}  // namespace hagen::observations
