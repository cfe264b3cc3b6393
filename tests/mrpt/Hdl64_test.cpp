// Tests with synthetic packets and a synthetic calibration file of an HDL-64E.
#include <gmock/gmock.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/VelodyneObservation.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include "sensors/velodyne/VelodyneCalibrationFile.h"

#include <cstring>
#include <limits>

#include "support/Hdl64.h"
#include "support/Program.h"

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationVelodyneScan;
using mrpt::obs::VelodyneCalibration;
using testing::AllOf;
using testing::HasSubstr;

/// The file name is unique to this process, as tests run in parallel.
std::filesystem::path fileOf(const std::string& content) {
    static const test::TemporaryFolder folder;
    return test::writeBytes(folder / "calibration.xml", content);
}

std::string errorOf(const std::string& xml) {
    return test::messageOf([&] { sensors::readVelodyneCalibration(fileOf(xml)); });
}

std::string replaced(const std::string& from, const std::string& to) {
    std::string xml = test::hdl64Xml();
    const std::size_t at = xml.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? xml : xml.replace(at, from.size(), to);
}

/// The range to the walls, floor and ceiling of a room around the sensor.
double rangeInRoom(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& direction) {
    const Eigen::Vector3d low_m(-12, -9, -1.7), high_m(15, 7, 2.5);
    double range_m = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double wall_m = direction[axis] > 0 ? high_m[axis] : low_m[axis];
        if (direction[axis] != 0) {
            range_m = std::min(range_m, (wall_m - origin_m[axis]) / direction[axis]);
        }
    }
    return range_m;
}

CObservationVelodyneScan scanInRoom(int firings) {
    const auto lasers = test::hdl64Lasers();
    CObservationVelodyneScan scan;
    scan.calibration = mrptCalibration(sensors::readVelodyneCalibration(fileOf(test::hdl64Xml())));
    for (const auto& bytes : test::hdl64Packets(firings, [&](int laser, double azimuth_deg) {
             return rangeInRoom(lasers[laser].origin_m(azimuth_deg),
                                lasers[laser].direction(azimuth_deg));
         })) {
        auto& packet = scan.scan_packets.emplace_back();
        std::memcpy(static_cast<void*>(&packet), bytes.data(), bytes.size());
    }
    return scan;
}

TEST(Hdl64, DecodesReturnsOntoRoomWalls) {
    constexpr int kFirings = 1998;
    const CObservationVelodyneScan observation = scanInRoom(kFirings);
    Scan scan;
    EXPECT_EQ(decodePackets(observation, scan), 0u);
    const auto lasers = test::hdl64Lasers();
    const auto calibration = sensors::readVelodyneCalibration(fileOf(test::hdl64Xml()));
    ASSERT_EQ(scan.size(), std::size_t{64 * kFirings});
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const int firing = static_cast<int>(i / 64), laser = static_cast<int>(i % 64);
        const double azimuth_deg = 0.18 * firing;
        const Eigen::Vector3d origin_m = lasers[laser].origin_m(azimuth_deg);
        const Eigen::Vector3d direction = lasers[laser].direction(azimuth_deg);
        const double range_m = rangeInRoom(origin_m, direction);
        const Eigen::Vector3d hit_m = origin_m + range_m * direction;
        const Eigen::Vector3d there_m =
            Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]).cast<double>();
        // Ranges are in steps of 2 mm, azimuths up to 0.01 degrees ahead (azimuthOfReadingDeg()).
        ASSERT_LT((there_m - hit_m).norm(), 0.002 + 2e-4 * range_m) << firing << " " << laser;
        ASSERT_NEAR(scan.range_m[i], range_m, 0.0011);
        ASSERT_NEAR(scan.time_s[i], 48e-6 * firing, 1e-7);
        ASSERT_EQ(scan.row[i], sensors::rowOfLaser(calibration, laser));
        ASSERT_FLOAT_EQ(scan.intensity[i], 0.2f);
    }
    EXPECT_EQ(scan.beams.rows, 64);
}

TEST(Hdl64, UsesScanCalibration) {
    CObservationVelodyneScan observation = scanInRoom(12);
    ObservedScan observed;
    readObservation(observation, {}, observed);
    EXPECT_EQ(observed.sensor.name, "HDL-64E");
    EXPECT_EQ(observed.sensor.rows(), 64);
    EXPECT_EQ(observed.scan.size(), 64u * 12);
    observation.calibration.laser_corrections.resize(32);
    EXPECT_THAT(test::messageOf([&] { readObservation(observation, {}, observed); }),
                HasSubstr("require a calibration"));
}

TEST(Hdl64, SkipsInvalidBlocks) {
    CObservationVelodyneScan observation = scanInRoom(6);
    auto* const bytes = reinterpret_cast<std::uint8_t*>(&observation.scan_packets.front());
    bytes[300] = 0x12;  // the header of the fourth block
    bytes[402] = 0xff;  // the azimuth of the fifth
    bytes[403] = 0xff;
    Scan scan;
    EXPECT_EQ(decodePackets(observation, scan), 2u);
    EXPECT_EQ(scan.size(), 10u * 32);
}

TEST(Hdl64, MatchesMrptCalibrationReader) {
    const VelodyneCalibration read =
        mrptCalibration(sensors::readVelodyneCalibration(fileOf(test::hdl64Xml())));
    VelodyneCalibration expected;
    ASSERT_TRUE(expected.loadFromXMLText(test::hdl64Xml()));
    ASSERT_EQ(read.laser_corrections.size(), 64u);
    for (std::size_t i = 0; i < 64; ++i) {
        const auto &a = read.laser_corrections[i], &b = expected.laser_corrections[i];
        using Laser = std::decay_t<decltype(a)>;
        for (double Laser::*const number :
             {&Laser::azimuthCorrection, &Laser::verticalCorrection, &Laser::distanceCorrection,
              &Laser::verticalOffsetCorrection, &Laser::horizontalOffsetCorrection,
              &Laser::sinVertCorrection, &Laser::cosVertCorrection}) {
            EXPECT_DOUBLE_EQ(a.*number, b.*number) << i;
        }
    }
}

TEST(Hdl64, ReportsInvalidCalibration) {
    EXPECT_EQ(errorOf(test::hdl64Xml()), "");
    const auto reports = [](const std::string& why) {
        return AllOf(HasSubstr("calibration.xml"), HasSubstr(why));
    };
    for (const char* const broken : {"", "{\"json\": 1}", "<a>", "<a></b>", "<>"}) {
        EXPECT_THAT(errorOf(broken), reports("is not an HDL-64E calibration"));
    }
    EXPECT_THAT(errorOf("<a/>"), reports("boost_serialization is missing"));
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "<a>";
    EXPECT_THAT(errorOf(deep), reports("DEPTH"));
    EXPECT_THAT(errorOf(replaced("<id_>7</id_>", "<id_>8</id_>")), reports("laser 8 occurs twice"));
    EXPECT_THAT(errorOf(replaced("<id_>7</id_>", "<id_/>")), reports("id_ in line"));
    EXPECT_THAT(errorOf(replaced("<id_>7</id_>", "<id_>-1e300</id_>")), reports("an invalid id_"));
    EXPECT_THAT(errorOf(replaced("<id_>63</id_>", "<id_>64</id_>")),
                reports("laser 63 is missing"));
    EXPECT_THAT(errorOf(replaced("<item>1</item>", "<item>0</item>")), reports("63 lasers"));
    EXPECT_THAT(errorOf(replaced("<item>1</item>", "<item/>")), reports("not a number"));
    EXPECT_THAT(errorOf(replaced("distCorrection_>90.000000", "distCorrection_>9e9")),
                reports("distCorrection_ is 9"));
    EXPECT_THAT(errorOf(replaced("distCorrection_>90.000000", "distCorrection_>nan")),
                reports("not a number"));
    EXPECT_THAT(errorOf(replaced("<vertOffsetCorrection_>20.000000</vertOffsetCorrection_>", "")),
                reports("vertOffsetCorrection_ is missing"));
    auto lasers = test::hdl64Lasers();
    lasers[5].vert_deg = lasers[9].vert_deg;
    EXPECT_THAT(errorOf(test::hdl64Xml(lasers)), reports("lasers 5 and 9 have the same elevation"));
    lasers[5].vert_deg = 90.5;
    EXPECT_THAT(errorOf(test::hdl64Xml(lasers)), reports("vertCorrection_ is 90.5"));
    EXPECT_THAT(errorOf(std::string(5 << 20, ' ')), reports("is larger than 4 MiB"));
    EXPECT_THROW(sensors::readVelodyneCalibration("/no/such/file.xml"), std::runtime_error);
    EXPECT_THROW(sensors::readVelodyneCalibration(std::filesystem::temp_directory_path()),
                 std::runtime_error);
}

TEST(Hdl64, RejectsTruncatedCalibration) {
    const std::string xml = test::hdl64Xml();
    const std::size_t end = xml.rfind("</boost_serialization>");
    for (std::size_t size = 0; size < end; size += 501) {
        EXPECT_NE(errorOf(xml.substr(0, size)), "") << size;
    }
}

}  // namespace
}  // namespace hagen::observations
