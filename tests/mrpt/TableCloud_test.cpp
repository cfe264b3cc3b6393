#include "mrpt/TableCloud.h"
#include <gmock/gmock.h>
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/NewerClouds.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/scan/Angle.h>
#include <hagen/settings/CloudSensors.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/serialization/CArchive.h>

#include "support/Program.h"
#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen::observations {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Numbers = std::vector<double>;

PointTable tableAt(const Numbers& x_m) {
    PointTable table;
    table.points = x_m.size();
    addColumn("x", NumberType::Float32, x_m, table);
    addColumn("y", NumberType::Float64, Numbers(x_m.size(), 1), table);
    addColumn("z", NumberType::Int16, Numbers(x_m.size(), 0), table);
    return table;
}

TableCloud cloudOf(const PointTable& table) {
    return TableCloud(std::make_shared<const PointTable>(table));
}

/// A cloud of two points with an additional field.
TableCloud cloudWith(const char* name, NumberType type, const Numbers& numbers) {
    PointTable table = tableAt(Numbers(numbers.size(), 2));
    addColumn(name, type, numbers, table);
    return cloudOf(table);
}

TEST(TableCloud, KeepsNonFinitePointsInTable) {
    const double infinity = std::numeric_limits<double>::infinity();
    const TableCloud cloud = cloudOf(tableAt({kNan, 3, infinity, 5, -infinity}));
    EXPECT_THAT(cloud.getPointsBufferRef_x(), ElementsAre(3, 5));
    EXPECT_THAT(cloud.pointOfReturn(), ElementsAre(1, 3));
    EXPECT_EQ(cloud.pointsNotFinite(), 3u);
    EXPECT_EQ(cloud.table().points, 5u);
}

TEST(TableCloud, TreatsFloatOverflowAsNonFinite) {
    PointTable table = tableAt({1, 2});
    table.fields[1].name = "v";
    addColumn("y", NumberType::Float64, {1e300, 4}, table);
    EXPECT_THAT(cloudOf(table).pointOfReturn(), ElementsAre(1));
}

TEST(TableCloud, ScalesIntensitiesByMaximum) {
    const auto intensities = [](const char* name, NumberType type, const Numbers& numbers) {
        const TableCloud cloud = cloudWith(name, type, numbers);
        const auto& all = *intensitiesOf(cloud);
        return std::vector<float>(all.begin(), all.end());
    };
    EXPECT_THAT(intensities("intensity", NumberType::Float32, {0.5, 1}), ElementsAre(0.5f, 1.0f));
    EXPECT_THAT(intensities("Reflectivity", NumberType::UInt8, {51, 2}),
                ElementsAre(0.2f, 2.0f / 255));
    EXPECT_THAT(intensities("i", NumberType::UInt16, {256, 65535}),
                ElementsAre(256.0f / 65535, 1.0f));
    EXPECT_THAT(intensities("remission", NumberType::Float32, {kNan, -1}), ElementsAre(0, 0));
    EXPECT_THAT(intensities("other", NumberType::UInt8, {51, 2}), ElementsAre(0, 0));
}

TEST(TableCloud, GuessesTimeUnits) {
    const auto times = [](const char* name, NumberType type, const Numbers& numbers) {
        return cloudWith(name, type, numbers).times_s();
    };
    const auto are = [](float first, float second) {
        return ElementsAre(FloatNear(first, 1e-6f), FloatNear(second, 1e-6f));
    };
    EXPECT_THAT(times("time", NumberType::Float32, {-0.1, 0}), are(-0.1f, 0));    // Velodyne, ROS
    EXPECT_THAT(times("t", NumberType::UInt32, {0, 99e6}), are(0, 0.099f));       // Ouster
    EXPECT_THAT(times("t", NumberType::UInt32, {0, 99e3}), are(0, 0.099f));       // in us
    EXPECT_THAT(times("timestamp", NumberType::Float64, {1.7e9, 1.7e9 + 0.125}),  // Hesai
                are(0, 0.125f));
    EXPECT_THAT(times("timestamp", NumberType::Float64, {1.7e18 + 131072000, 1.7e18}),  // Livox
                are(0.131072f, 0));
    EXPECT_THAT(times("time_stamp", NumberType::UInt64, {1.7e18, 1.7e18 + 131072000}),
                are(0, 0.131072f));
    EXPECT_THAT(times("gps_time", NumberType::Float64, {1000, 1001.5}), are(0, 1.5f));  // LAS
    EXPECT_THAT(times("other", NumberType::Float64, {0, 0.1}), IsEmpty());
}

TEST(TableCloud, UnwrapsTimes) {
    const TableCloud cloud =
        cloudWith("offset_time", NumberType::UInt32, {4294967296.0 - 40e6, 4294967295.0, 60e6});
    EXPECT_THAT(cloud.times_s(), ElementsAre(0, FloatNear(0.04f, 1e-6f), FloatNear(0.1f, 1e-6f)));
}

TEST(TableCloud, ScalesNormalizedTimes) {
    PointTable table = tableAt({1, 2, 3});
    addColumn("time", NumberType::Float32, {0, 0.5, 0.99}, table);
    const auto with = [&](double period_s) {
        return TableCloud(std::make_shared<const PointTable>(table), period_s);
    };
    EXPECT_THAT(with(0.1).times_s(), ElementsAre(0, FloatNear(0.05f, 1e-6f), 0.099f));
    EXPECT_THAT(with(0.1).remarks(), IsEmpty());
    EXPECT_THAT(with(0).times_s(), ElementsAre(0, 0.5f, 0.99f));
    EXPECT_THAT(with(0).remarks(), ElementsAre(HasSubstr("'time' spans 0 to 1: read as seconds")));
    EXPECT_THAT(with(1.0).times_s(), ElementsAre(0, 0.5f, 0.99f));
    EXPECT_THAT(with(1.0).remarks(), IsEmpty());
}

TEST(TableCloud, ReadsFieldsRenamedByCloudCompare) {
    PointTable table = tableAt({1, 2});
    addColumn("scalar_Intensity", NumberType::Float32, {1, 0.5}, table);
    addColumn("scalar_ring", NumberType::Float32, {3, 4}, table);
    addColumn("scalar_GpsTime", NumberType::Float64, {1e5, 1e5 + 0.1}, table);
    const TableCloud cloud = cloudOf(table);
    EXPECT_THAT(cloud.rings(), ElementsAre(3, 4));
    EXPECT_THAT(cloud.times_s(), ElementsAre(0, FloatNear(0.1f, 1e-6f)));
    EXPECT_EQ((*intensitiesOf(cloud))[1], 0.5f);
    EXPECT_THAT(cloud.remarks(), IsEmpty());
}

TEST(TableCloud, ReportsFieldsLikeStandardOnes) {
    const auto remarksOn = [](const char* name, NumberType type, const Numbers& numbers) {
        return cloudWith(name, type, numbers).remarks();
    };
    EXPECT_THAT(
        remarksOn("laser_id", NumberType::UInt8, {0, 1, 2, 3, 4}),
        ElementsAre("the field 'laser_id' may contain beam numbers, but is not used; rename "
                    "it to 'ring'"));
    EXPECT_THAT(remarksOn("pointTime", NumberType::Float64, {0, 1, 2, 3, 4}),
                ElementsAre(HasSubstr("rename it to 'time'")));
    EXPECT_THAT(remarksOn("amplitude", NumberType::UInt16, {0, 1, 2, 3, 4}),
                ElementsAre(HasSubstr("rename it to 'intensity'")));
    EXPECT_THAT(remarksOn("edge_of_flight_line", NumberType::UInt8, {0, 1, 0, 1, 0}), IsEmpty());
    EXPECT_THAT(remarksOn("beam_width", NumberType::Float32, {0.5, 1, 2, 3, 4}), IsEmpty());
    PointTable table = tableAt({1, 2, 3, 4, 5});
    addColumn("intensity", NumberType::UInt8, {1, 2, 3, 4, 5}, table);
    addColumn("reflectance", NumberType::UInt8, {1, 2, 3, 4, 5}, table);
    EXPECT_THAT(cloudOf(table).remarks(), IsEmpty());
}

TEST(TableCloud, ReportsImplausibleTimes) {
    for (const double last : {kNan, 3600.0}) {
        const TableCloud cloud = cloudWith("gps_time", NumberType::Float64, {0, last});
        EXPECT_THAT(cloud.times_s(), IsEmpty());
        EXPECT_THAT(cloud.remarks(), ElementsAre(HasSubstr("'gps_time'")));
    }
}

TEST(TableCloud, ReportsInvalidRings) {
    EXPECT_THAT(cloudWith("Line", NumberType::Float32, {3, 0}).rings(), ElementsAre(3, 0));
    for (const double wrong : {-1.0, 0.5, 1e9, kNan}) {
        const TableCloud cloud = cloudWith("ring", NumberType::Float32, {3, wrong});
        EXPECT_THAT(cloud.rings(), IsEmpty());
        EXPECT_THAT(cloud.remarks(), ElementsAre(HasSubstr("'ring'")));
    }
}

TEST(TableCloud, WarnsAboutMaps) {
    EXPECT_THAT(cloudOf(tableAt({5e5, 5e5 + 1, 3})).remarks(), ElementsAre(HasSubstr("map")));
    EXPECT_THAT(cloudOf(tableAt({5e5, 2, 3})).remarks(), IsEmpty());
}

TEST(TableCloud, RejectsTablesWithoutCoordinates) {
    PointTable table = tableAt({1});
    table.fields[2].name = "height";
    EXPECT_THAT(test::messageOf([&] { cloudOf(table); }), HasSubstr("x, y, height"));
    table.fields[2].offset = 100;
    EXPECT_THROW(cloudOf(table), std::runtime_error);
}

/// Returns of these beams inside a sphere; `ringOf` assigns ring numbers.
template <class RingOf>
PointTable sphereOf(const std::vector<double>& beams_deg, const RingOf& ringOf) {
    Numbers x, y, z, rings;
    for (int column = 0; column < 200; ++column) {
        for (std::size_t beam = 0; beam < beams_deg.size(); ++beam) {
            const double azimuth_rad = kPi - 2 * kPi * (column + 0.5) / 200;
            const Eigen::Vector3d point =
                10 * test::directionOf(azimuth_rad, radians(beams_deg[beam]));
            x.push_back(point.x());
            y.push_back(point.y());
            z.push_back(point.z());
            rings.push_back(ringOf(static_cast<int>(beam), column));
        }
    }
    PointTable table;
    table.points = x.size();
    addColumn("x", NumberType::Float32, x, table);
    addColumn("y", NumberType::Float32, y, table);
    addColumn("z", NumberType::Float32, z, table);
    addColumn("ring", NumberType::UInt16, rings, table);
    return table;
}

std::vector<double> vlp16_deg() {
    std::vector<double> beams_deg;
    for (int beam = 0; beam < 16; ++beam) beams_deg.push_back(-15 + 2 * beam);
    return beams_deg;
}

ObservedScan readBack(const PointTable& table, const Settings& settings = {}) {
    const auto observation =
        observationOf(std::make_shared<const PointTable>(table), "a", mrpt::Clock::fromDouble(1));
    CloudSensors sensors;
    showCloud(*observation, sensors);
    ObservedScan observed;
    readObservation(*observation, settings, observed, sensors.beamsOf("a"));
    return observed;
}

/// Like readBack(), but from a log of a newer MRPT that stores the table as a CGenericPointsMap.
ObservedScan readFromLog(const PointTable& table) {
    registerMrptClasses();
    registerNewerClouds();
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    archive << *genericCloudOf(table);
    stream.Seek(0);
    mrpt::obs::CObservationPointCloud observation;
    observation.sensorLabel = "a";
    observation.pointcloud =
        std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(archive.ReadObject());
    CloudSensors sensors;
    showCloud(observation, sensors);
    ObservedScan observed;
    readObservation(observation, {}, observed, sensors.beamsOf("a"));
    return observed;
}

TEST(TableCloud, UsesMonotonicRingsAsRows) {
    for (const bool is_rising : {true, false}) {
        const auto observed = readBack(sphereOf(
            vlp16_deg(), [&](int beam, int) { return is_rising ? beam + 3 : 100 - 2 * beam; }));
        EXPECT_EQ(observed.sensor.name, "VLP-16");
        EXPECT_THAT(textOf(observed.recovered), HasSubstr("by ring number"));
        for (std::size_t i = 0; i < observed.scan.size(); ++i) {
            ASSERT_EQ(observed.scan.row[i], i % 16);
        }
    }
}

TEST(TableCloud, PrefersRingOverElevation) {
    PointTable table = sphereOf(vlp16_deg(), [](int beam, int) { return beam; });
    Numbers z = columnOf(table, table.fields[2]);
    z[5] += 1.0;  // 6 degrees up
    PointTable moved;
    moved.points = table.points;
    for (const PointField& field : table.fields) {
        addColumn(field.name, field.type, field.name == "z" ? z : columnOf(table, field), moved);
    }
    EXPECT_EQ(readBack(moved).scan.row[5], 5);
    Settings named;
    named.sensor.model = "VLP-16";  // the settings specify the beams
    EXPECT_EQ(readBack(moved, named).scan.row[5], 8);
}

TEST(TableCloud, KeepsRowsAndTimesInLogs) {
    PointTable table = sphereOf(vlp16_deg(), [](int beam, int) { return 3 * beam; });
    Numbers times(table.points);
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = 0.1 / 3200 * static_cast<double>(i);
    addColumn("t", NumberType::Float32, times, table);
    const ObservedScan of_table = readBack(table), of_log = readFromLog(table);
    EXPECT_THAT(textOf(of_log.recovered), HasSubstr("by ring number"));
    EXPECT_EQ(of_log.scan.row, of_table.scan.row);
    EXPECT_EQ(of_log.scan.time_s, of_table.scan.time_s);
    EXPECT_EQ(of_log.scan.time_s.size(), table.points);
    EXPECT_EQ(of_log.remark, "");

    times[7] = 100;  // too long for a scan
    PointTable strange = sphereOf(vlp16_deg(), [](int, int column) { return column; });
    addColumn("gps_time", NumberType::Float64, times, strange);
    const ObservedScan observed = readFromLog(strange);
    EXPECT_THAT(observed.scan.time_s, IsEmpty());
    EXPECT_THAT(observed.remark,
                AllOf(HasSubstr("keep them: gps_time, ring"), HasSubstr("span more")));
}

TEST(TableCloud, SeparatesCloseBeamsByRings) {
    std::vector<double> beams_deg;  // 0.1 degrees apart, too close for a histogram of 20 columns
    for (int beam = 0; beam < 32; ++beam)
        beams_deg.push_back(-2 + 0.1 * beam + 0.001 * beam * beam);
    const auto observed = readBack(sphereOf(beams_deg, [](int beam, int) { return beam; }));
    ASSERT_EQ(observed.sensor.rows(), 32);
    for (int row = 0; row < 32; ++row) {
        EXPECT_NEAR(degrees(observed.sensor.elevations_rad[row]), beams_deg[row], 0.001);
    }
}

TEST(TableCloud, IgnoresContradictingRings) {
    // Laser numbers of a VLP-16 in firing order, and overlapping lines like those of a Livox.
    const auto interleaved = readBack(
        sphereOf(vlp16_deg(), [](int beam, int) { return beam < 8 ? 2 * beam : 2 * beam - 15; }));
    const auto overlapping =
        readBack(sphereOf(vlp16_deg(), [](int beam, int column) { return (beam + column) % 4; }));
    for (const auto* observed : {&interleaved, &overlapping}) {
        EXPECT_EQ(observed->sensor.name, "VLP-16");  // as without rings
        EXPECT_THAT(textOf(observed->recovered), HasSubstr("contradict the elevations"));
        EXPECT_THAT(textOf(observed->recovered), Not(HasSubstr("by ring")));
        for (std::size_t i = 0; i < observed->scan.size(); ++i) {
            ASSERT_EQ(observed->scan.row[i], i % 16);
        }
    }
}

TEST(TableCloud, PassesTimesToScan) {
    PointTable table = tableAt({1, 2});
    addColumn("t", NumberType::UInt32, {0, 5e7}, table);
    EXPECT_THAT(readBack(table).scan.time_s, ElementsAre(0, 0.05f));
}

TEST(TableCloud, ConvertsScansToTables) {
    Scan scan;
    scan.x_m = {1, 2};
    scan.y_m = {3, 4};
    scan.z_m = {5, 6};
    scan.intensity = {0.25f, 0.5f};
    EXPECT_EQ(namesOf(tableOf(scan)), "x, y, z, intensity");
    scan.time_s = {0, 0.5f};
    const PointTable table = tableOf(scan);
    EXPECT_EQ(namesOf(table), "x, y, z, intensity, time");
    EXPECT_THAT(columnOf(table, table.fields[3]), ElementsAre(0.25, 0.5));
    EXPECT_THAT(cloudOf(table).times_s(), ElementsAre(0, 0.5f));
}

}  // namespace
}  // namespace hagen::observations
