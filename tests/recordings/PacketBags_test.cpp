// Bags of packets beside the points of another driver (HAGEN_NEBULA_DATA).
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/scan/Angle.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodyneModel.h>
#include "recordings/clouds/CloudFile.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "support/LaserRows.h"
#include "support/Program.h"
#include "support/ReadBag.h"

namespace hagen::recordings {
namespace {

struct Direction {
    double range_m, elevation_deg, azimuth_deg;  ///< clockwise from x
};

/// The other driver's points.
std::vector<Direction> truthOf(const std::filesystem::path& file, bool is_hesai) {
    const CloudFile cloud = readCloud(file);
    const auto column = [&](const char* name) {
        return columnOf(cloud.table, *findExactly(cloud.table, name));
    };
    const auto x = column("x"), y = column("y"), z = column("z");
    std::vector<Direction> truth;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double level_m = std::hypot(x[i], y[i]);
        // Hesai's y axis points forward.
        const double azimuth_rad = is_hesai ? std::atan2(x[i], y[i]) : -std::atan2(y[i], x[i]);
        truth.push_back(
            {std::hypot(level_m, z[i]), degrees(std::atan2(z[i], level_m)), degrees(azimuth_rad)});
    }
    return truth;
}

/// A decoded return: azimuth and range.
using Beam = std::multimap<double, double>;

/// The returns of scans by beam, repeated beyond +-180 degrees.
std::vector<Beam> beamsOf(const std::vector<mrpt::obs::CObservation::Ptr>& scans, bool is_hesai,
                          SensorModel& sensor) {
    std::vector<Beam> beams;
    for (const auto& scan : scans) {
        observations::ObservedScan decoded;
        observations::readObservation(*scan, {}, decoded);
        sensor = decoded.sensor;
        beams.resize(static_cast<std::size_t>(sensor.rows()));
        for (std::size_t i = 0; i < decoded.scan.size(); ++i) {
            double azimuth_deg = -degrees(static_cast<double>(decoded.scan.azimuth_rad[i]));
            // The inverse of azimuthOfReadingDeg().
            if (!is_hesai) azimuth_deg = (azimuth_deg + 180) * 35999 / 36000 - 180;
            for (const double turn_deg : {-360.0, 0.0, 360.0}) {
                beams[decoded.scan.row[i]].emplace(azimuth_deg + turn_deg, decoded.scan.range_m[i]);
            }
        }
    }
    return beams;
}

/// The differences in azimuth from the returns with the same range within 1 mm.
std::vector<double> azimuthsOff(const Beam& beam, const Direction& point) {
    constexpr double kWindow_deg = 0.5;
    std::vector<double> off_deg;
    const auto end = beam.upper_bound(point.azimuth_deg + kWindow_deg);
    for (auto at = beam.lower_bound(point.azimuth_deg - kWindow_deg); at != end; ++at) {
        if (std::abs(at->second - point.range_m) > 1e-3) continue;
        off_deg.push_back(at->first - point.azimuth_deg);
    }
    return off_deg;
}

/// The most frequent difference.
double commonOff(const Beam& beam, const std::vector<Direction>& points) {
    constexpr double kBin_deg = 0.001;
    std::map<long, int> votes;
    for (const Direction& point : points) {
        for (const double off_deg : azimuthsOff(beam, point)) {
            ++votes[std::lround(off_deg / kBin_deg)];
        }
    }
    const auto most = std::max_element(votes.begin(), votes.end(),
                                       [](auto& x, auto& y) { return x.second < y.second; });
    return static_cast<double>(most->first) * kBin_deg;
}

struct PacketBag {
    const char *name, *model;
    std::size_t first, last;  ///< scans that contain those of the truth
    double max_azimuth_deg;
};

class PacketBags : public testing::TestWithParam<PacketBag> {};
// The other driver interpolates azimuths differently: a VLP-16 not in the last block of a packet, a
// VLP-32C with 32 single lasers, and of a VLS-128 only the last bank, except in the last block.
INSTANTIATE_TEST_SUITE_P(Sensors, PacketBags,
                         testing::Values(PacketBag{"vlp16", "VLP-16", 2, 3, 0.5},
                                         PacketBag{"vlp32", "VLP-32C", 0, 1, 0.2},
                                         PacketBag{"vls128", "VLS-128", 1, 1, 0.0125},
                                         PacketBag{"hesai_xt32", "XT32", 2, 4, 0.01}),
                         [](const auto& bag) { return std::string(bag.param.name); });

TEST_P(PacketBags, MatchOtherDriver) {
    const auto folder = test::dataFolder("HAGEN_NEBULA_DATA");
    if (folder.empty()) GTEST_SKIP() << "HAGEN_NEBULA_DATA is not a folder of bags";
    const auto& [name, model, first, last, max_azimuth_deg] = GetParam();
    const std::string path = (folder / name).string();
    const bool is_hesai = model == std::string("XT32"), is_vls = model == std::string("VLS-128");
    const auto bag = test::readBag(path + ".db3");
    ASSERT_EQ(bag.failed_because, "");
    ASSERT_GT(bag.observations.size(), last);
    const auto scans = bag.observations.begin();
    SensorModel sensor;
    const auto beams = beamsOf({scans + first, scans + last + 1}, is_hesai, sensor);
    EXPECT_EQ(sensor.name, model);
    std::vector<std::vector<Direction>> truth(beams.size());
    for (const Direction& point : truthOf(path + "_truth.pcd", is_hesai)) {
        truth[sensor.nearestRow(static_cast<float>(radians(point.elevation_deg)))].push_back(point);
    }
    std::vector<int> laser_of(beams.size());
    if (is_vls) {
        const auto rows = test::rowsOfLasers(defaultCalibration(sensors::velodyneModel(model)));
        for (int laser = 0; laser < 128; ++laser) laser_of[rows[laser]] = laser;
    }
    std::size_t unmatched = 0;
    for (std::size_t row = 0; row < beams.size(); ++row) {
        if (truth[row].empty()) continue;  // a defective laser
        SCOPED_TRACE(row);
        std::vector<double> expected_deg{0};
        double elevation_deg = degrees(static_cast<double>(sensor.elevations_rad[row]));
        if (is_hesai) {  // the truth includes the calibration of the unit, which its packets lack
            expected_deg = {commonOff(beams[row], truth[row])};
            EXPECT_LT(std::abs(expected_deg[0]), 0.15);
            EXPECT_NEAR(truth[row][0].elevation_deg, elevation_deg, 0.1);
            elevation_deg = truth[row][0].elevation_deg;
        }
        if (is_vls) {
            const auto& velodyne = sensors::velodyneModel(model);
            const double ahead_deg = 0.2 * velodyne.turnWithinBlock(0, laser_of[row]);
            if (laser_of[row] < 96) expected_deg.clear();
            expected_deg.push_back(ahead_deg);
        }
        for (const Direction& point : truth[row]) {
            ASSERT_NEAR(point.elevation_deg, elevation_deg, 0.01);
            double least_deg = 1;
            for (const double off_deg : azimuthsOff(beams[row], point)) {
                for (const double expected : expected_deg) {
                    least_deg = std::min(least_deg, std::abs(off_deg - expected));
                }
            }
            unmatched += least_deg > max_azimuth_deg;
        }
    }
    EXPECT_EQ(unmatched, 0u);
}

}  // namespace
}  // namespace hagen::recordings
