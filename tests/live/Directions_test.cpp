#include "live/Directions.h"
#include <gtest/gtest.h>
#include <hagen/filter/HagenFilter.h>
#include <hagen/scan/Angle.h>
#include "live/autopilot/VehicleMotion.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <vector>

#include "live/Vehicle.h"

namespace hagen::live {
namespace {

using State = DirectionState;

constexpr double kTurn_s = 0.1, kPacket_rad = kPi / 36;  // 5 degrees
constexpr int kPacketsPerTurn = 72, kPacketsPerSector = 5;

struct Pole {
    double north_m, east_m, radius_m = 0.15;
    double top_m = 1e9;  ///< relative to the vehicle's initial position
};

/// A LiDAR on a vehicle that moves among infinitely high poles. All returns are RoI.
class Flight {
 public:
    std::vector<Pole> poles;
    std::function<Vehicle(double time_s)> vehicleAt = [](double) { return Vehicle(); };
    Eigen::Matrix3d vehicle_from_sensor = Eigen::Matrix3d::Identity();
    std::function<bool(int packet)> isLost = [](int) { return false; };
    VehicleMotion motion;
    bool has_attitude = true, has_place = true;

    SectorDistances::PoseAt poses() const {
        return [this](double time_s) { return motion.at(time_s); };
    }
    /// Continues the flight until this time.
    void fly(double until_s, SectorDistances& distances) {
        for (; packet_ * kTurn_s / kPacketsPerTurn < until_s; ++packet_) {
            const double time_s = packet_ * kTurn_s / kPacketsPerTurn;
            const Vehicle vehicle = vehicleAt(time_s);
            if (packet_ % 14 == 0) {  // at about 50 Hz
                if (has_attitude) motion.take(vehicle.attitude(time_s), time_s);
                if (has_place) motion.take(vehicle.place(time_s), time_s);
            }
            if (!isLost(packet_)) measure(vehicle);
            last_time_s_ = time_s;
            if (sweeps_.empty()) first_time_s_ = time_s;
            if (packet_ % kPacketsPerSector == kPacketsPerSector - 1) label(distances);
        }
    }

 private:
    void measure(const Vehicle& vehicle) {
        if (sweeps_.empty()) first_time_s_ = packet_ * kTurn_s / kPacketsPerTurn;
        sweeps_.push_back({packet_ * kPacket_rad, (packet_ + 1) * kPacket_rad});
        const Eigen::Vector3d flip(1, -1, -1);
        const Eigen::Matrix3d ned_from_sensor =
            vehicle.nedFromFrd() * flip.asDiagonal() * vehicle_from_sensor;
        for (double azimuth = sweeps_.back().from_rad; azimuth < sweeps_.back().to_rad;
             azimuth += radians(0.2)) {
            for (const float elevation : sensorModel("VLP-16").elevations_rad) {
                const double e = static_cast<double>(elevation);
                const Eigen::Vector3d beam(std::cos(e) * std::cos(azimuth),
                                           -std::cos(e) * std::sin(azimuth), std::sin(e));
                const double range_m = rangeOf(vehicle, ned_from_sensor * beam);
                if (range_m > 20) continue;
                scan_.x_m.push_back(static_cast<float>(range_m * beam.x()));
                scan_.y_m.push_back(static_cast<float>(range_m * beam.y()));
                scan_.z_m.push_back(static_cast<float>(range_m * beam.z()));
            }
        }
    }
    double rangeOf(const Vehicle& vehicle, const Eigen::Vector3d& ray) const {
        double nearest_m = 1e9;
        for (const Pole& pole : poles) {
            // Intersects a line and a circle, seen from above.
            const Eigen::Vector2d from =
                vehicle.ned_m.head<2>() - Eigen::Vector2d(pole.north_m, pole.east_m);
            const Eigen::Vector2d way = ray.head<2>();
            const double a = way.squaredNorm(), b = from.dot(way),
                         c = from.squaredNorm() - pole.radius_m * pole.radius_m;
            const double root = b * b - a * c;
            if (root < 0 || b > 0) continue;
            const double range_m = (-b - std::sqrt(root)) / a;
            if (-(vehicle.ned_m.z() + range_m * ray.z()) > pole.top_m) continue;
            nearest_m = std::min(nearest_m, range_m);
        }
        return nearest_m;
    }
    void label(SectorDistances& distances) {
        const std::vector<Label> labels(scan_.size(), Label::Roi);
        if (!sweeps_.empty()) {
            const Sweep all{sweeps_.front().from_rad, sweeps_.back().to_rad};
            distances.take({scan_, labels, all, first_time_s_, last_time_s_, true, false, false,
                            result_, &sweeps_});
        }
        scan_.clear();
        sweeps_.clear();
    }

    int packet_ = 0;
    double first_time_s_ = 0, last_time_s_ = 0;
    Scan scan_;
    std::vector<Sweep> sweeps_;
    SegmentationResult result_;
};

class DirectionsInFlight : public testing::Test {
 protected:
    /// Compares directions with the true positions of poles; returns the number of poles compared.
    int compare(const Flight& flight, const SectorDistances& distances, double now_s,
                bool all_is_seen = true) {
        const Vehicle vehicle = flight.vehicleAt(now_s);
        const Directions directions = distances.at(now_s, flight.poses());
        int compared = 0;
        std::vector<bool> may_be_obstacle(72, false);
        for (const Pole& pole : flight.poles) {
            const Eigen::Vector3d foot(pole.north_m, pole.east_m, 0);
            const double bearing_deg = vehicle.bearing_deg(foot);
            const double distance_m = (foot - vehicle.ned_m).head<2>().norm() - pole.radius_m;
            const double half_deg = degrees(std::asin(pole.radius_m / distance_m)) + 0.6;
            for (const double edge_deg :
                 {bearing_deg - half_deg, bearing_deg, bearing_deg + half_deg}) {
                const double turned = edge_deg + 2.5 + 360;
                may_be_obstacle[static_cast<std::size_t>(turned / 5) % 72] = true;
            }
            // Skips poles near the edge of a direction.
            const double into_deg = std::remainder(bearing_deg, 5);
            if (std::abs(into_deg) > 1.5) continue;
            const auto k = static_cast<std::size_t>((bearing_deg + 2.5) / 5) % 72;
            EXPECT_EQ(directions[k].state, State::Obstacle) << bearing_deg << " at " << now_s;
            EXPECT_NEAR(directions[k].distance_m, distance_m, 0.12)
                << bearing_deg << " at " << now_s;
            ++compared;
        }
        for (std::size_t k = 0; k < 72; ++k) {
            if (may_be_obstacle[k]) continue;
            EXPECT_NE(directions[k].state, State::Obstacle) << k << " at " << now_s;
            if (all_is_seen) {
                EXPECT_EQ(directions[k].state, State::SeenNothing) << k << " at " << now_s;
            }
        }
        return compared;
    }
    static std::vector<Pole> around() {
        return {{10, 0}, {7, 7}, {0, 12}, {-5, 9}, {-14, -1}, {-6, -8}, {1, -5}, {9, -9}};
    }
    static SectorDistances::Settings settings(const Eigen::Matrix3d& mount) {
        SectorDistances::Settings settings = aheadFirst();
        settings.body_from_sensor.linear() = mount;
        return settings;
    }

    const SensorModel sensor_ = sensorModel("VLP-16");
};

TEST_F(DirectionsInFlight, DirectionsAreClockwiseFromAhead) {
    Flight flight;
    flight.has_attitude = flight.has_place = false;
    // The poles are ahead, right, behind and left.
    flight.poles = {{6, 0}, {0, 7}, {-8, 0}, {0, -9}};
    SectorDistances distances(sensor_, aheadFirst());
    flight.fly(0.2, distances);
    const Directions at = distances.at(0.2, flight.poses());
    const float expected_m[] = {5.85f, 6.85f, 7.85f, 8.85f};
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(at[18 * k].state, State::Obstacle);
        EXPECT_NEAR(at[18 * k].distance_m, expected_m[k], 0.02);
        EXPECT_EQ(at[18 * k + 9].state, State::SeenNothing);
    }
    EXPECT_NEAR(at[18].at_m.y(), -6.85, 0.05);  // y is left
    EXPECT_EQ(compare(flight, distances, 0.2), 4);
}

TEST_F(DirectionsInFlight, PolesStayInPlaceInFlight) {
    Flight flight;
    flight.poles = around();
    flight.vehicleAt = [](double t) {
        Vehicle vehicle;
        const double roll = 0.2, rate = 6;
        vehicle.yaw_rad = 0.5 + 1.6 * t;  // 92 degrees per second
        vehicle.roll_rad = roll * std::sin(rate * t);
        // Angular rates about the vehicle's axes.
        vehicle.rates_rad_s = {roll * rate * std::cos(rate * t), 1.6 * std::sin(vehicle.roll_rad),
                               1.6 * std::cos(vehicle.roll_rad)};
        vehicle.speed_m_s = {4, -3, 0.5};
        vehicle.ned_m = (t - 0.5) * vehicle.speed_m_s;
        return vehicle;
    };
    SectorDistances distances(sensor_, aheadFirst());
    int compared = 0;
    for (double now_s = 0.25; now_s < 1; now_s += 0.013) {
        flight.fly(now_s - 0.01, distances);  // labels arrive with a delay
        compared += compare(flight, distances, now_s);
    }
    EXPECT_GT(compared, 200);
}

TEST_F(DirectionsInFlight, UpsideDownMountDoesNotAffectDirections) {
    using Eigen::AngleAxisd;
    using Eigen::Vector3d;
    for (const double roll_deg : {0.0, 180.0}) {
        Flight flight;
        flight.poles = around();
        flight.vehicle_from_sensor = (AngleAxisd(radians(-75), Vector3d::UnitZ()) *
                                      AngleAxisd(radians(8), Vector3d::UnitY()) *
                                      AngleAxisd(radians(roll_deg), Vector3d::UnitX()))
                                         .toRotationMatrix();
        SectorDistances distances(sensor_, settings(flight.vehicle_from_sensor));
        flight.fly(0.3, distances);
        EXPECT_GT(compare(flight, distances, 0.3), 3);
    }
}

TEST_F(DirectionsInFlight, IsUnknownWithoutBeamAtHorizon) {
    Flight flight;
    flight.poles = around();
    flight.vehicleAt = [](double) {
        Vehicle vehicle;
        vehicle.roll_rad = radians(30);
        return vehicle;
    };
    SectorDistances distances(sensor_, aheadFirst());
    flight.fly(0.3, distances);
    compare(flight, distances, 0.3, false);
    const Directions at = distances.at(0.3, flight.poses());
    EXPECT_EQ(at[1].state, State::SeenNothing);  // ahead of or behind the vehicle
    EXPECT_EQ(at[38].state, State::SeenNothing);
    EXPECT_EQ(at[20].state, State::Unknown);  // to the sides, the sensor looks up or down
    EXPECT_EQ(at[52].state, State::Unknown);
}

/// A tilted sensor sees a low obstacle and the horizon above it at different times.
TEST_F(DirectionsInFlight, ObstacleBelowHorizonStays) {
    int compared = 0;
    for (const auto& [roll_deg, pitch_deg, rate_deg_s] :
         {std::tuple{0.0, -20.0, 0.0}, {0.0, 20.0, 0.0}, {15.0, -10.0, 0.0}, {-5.0, 0.0, 20.0}}) {
        Flight flight;
        flight.vehicleAt = [=](double time_s) {
            Vehicle vehicle;
            vehicle.roll_rad = radians(roll_deg + rate_deg_s * time_s);
            vehicle.pitch_rad = radians(pitch_deg);
            vehicle.rates_rad_s.x() = radians(rate_deg_s);
            return vehicle;
        };
        for (int bearing_deg = 0; bearing_deg < 360; bearing_deg += 10) {
            flight.poles.push_back({8 * std::cos(radians(bearing_deg)),
                                    8 * std::sin(radians(bearing_deg)), 0.15, -1.5});
        }
        SectorDistances distances(sensor_, aheadFirst());
        flight.fly(0.25, distances);
        const Directions before = distances.at(0.25, flight.poses());
        for (double now_s = 0.25; now_s < 0.35; now_s += 0.0007) {
            flight.fly(now_s, distances);
            const Directions at = distances.at(now_s, flight.poses());
            for (std::size_t k = 0; k < 72; k += 2) {
                if (before[k].state != State::Obstacle) continue;
                EXPECT_NE(at[k].state, State::SeenNothing)
                    << 5 * k << " degrees, " << now_s << " s, rolled " << roll_deg << ", pitched "
                    << pitch_deg;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 3000);
}

/// In each turn, the packet that would hit the obstacle is lost; the horizon above is swept.
TEST_F(DirectionsInFlight, LostPacketsOfTiltedSensorAreNotFree) {
    Vehicle vehicle;
    vehicle.pitch_rad = radians(-20);
    Flight flight;
    flight.vehicleAt = [&](double) { return vehicle; };
    flight.poles = {{8 * std::cos(radians(267)), 8 * std::sin(radians(267)), 0.1, -1.6}};
    const Eigen::Vector3d seen =
        vehicle.seen({flight.poles[0].north_m, flight.poles[0].east_m, 1.7});
    const double azimuth_deg = 360 - degrees(std::atan2(seen.y(), seen.x()));
    ASSERT_GT(azimuth_deg, 270);
    ASSERT_LT(azimuth_deg, 275);
    flight.isLost = [](int packet) { return packet > 72 && packet % 72 == 54; };
    SectorDistances distances(sensor_, aheadFirst());
    flight.fly(0.1, distances);
    for (double now_s = 0.1; now_s < 0.95; now_s += 0.003) {
        flight.fly(now_s, distances);
        const auto state = distances.at(now_s, flight.poses())[53].state;
        if (now_s < 0.35) {
            EXPECT_EQ(state, State::Obstacle) << now_s;
        } else if (now_s > 0.4) {
            EXPECT_EQ(state, State::Unknown) << now_s;
        } else {
            EXPECT_NE(state, State::SeenNothing) << now_s;
        }
    }
    flight.isLost = [](int) { return false; };
    flight.poles.clear();
    flight.fly(1.15, distances);
    EXPECT_EQ(distances.at(1.15, flight.poses())[53].state, State::SeenNothing);
}

TEST_F(DirectionsInFlight, LostDirectionBecomesUnknown) {
    Flight flight;
    // From the third turn on, each turn loses one packet in the middle of a sector.
    flight.isLost = [](int packet) {
        return packet >= 2 * kPacketsPerTurn && packet % kPacketsPerTurn == 42;
    };
    SectorDistances distances(sensor_, aheadFirst());
    flight.fly(0.4, distances);
    EXPECT_EQ(distances.at(0.4, flight.poses())[42].state, State::SeenNothing);
    flight.fly(0.7, distances);
    const Directions at = distances.at(0.7, flight.poses());
    for (std::size_t k = 0; k < 72; ++k) {
        // The packet spans two directions.
        EXPECT_EQ(at[k].state, k == 42 || k == 43 ? State::Unknown : State::SeenNothing) << k;
    }
}

/// A beam 4 degrees behind the head passes obstacles later than the head.
TEST_F(DirectionsInFlight, ObstacleStaysUntilAllBeamsPassed) {
    SectorDistances distances(sensorModel("VLP-32C"), aheadFirst());
    const SegmentationResult result;
    Scan none, wire;
    wire.x_m = {static_cast<float>(5 * std::cos(radians(10.0)))};
    wire.y_m = {static_cast<float>(-5 * std::sin(radians(10.0)))};
    wire.z_m = {0};
    const auto take = [&](const Scan& scan, double from_deg, double to_deg, double time_s) {
        const std::vector<Label> labels(scan.size(), Label::Roi);
        LabelledSector sector{scan,   labels,         Sweep{radians(from_deg), radians(to_deg)},
                              time_s, time_s + 0.001, true,
                              false,  false,          result};
        sector.offsets = {radians(4), radians(4)};
        distances.take(sector);
    };
    take(wire, 0, 180, 1);
    take(none, 180, 360, 1.05);
    take(none, 360, 374.4, 1.1);  // less than the end of the obstacle's degree (10.5) plus 4
    EXPECT_EQ(distances.at(1.11)[2].state, State::Obstacle);
    take(none, 374.4, 374.6, 1.104);
    EXPECT_EQ(distances.at(1.11)[2].state, State::SeenNothing);
}

/// An obstacle at the end of a sector is not passed until the next turn.
TEST_F(DirectionsInFlight, ObstacleStaysForOneTurn) {
    const auto stateAfter = [&](double turned_rad) {
        SectorDistances distances(sensor_, aheadFirst());
        Scan scan;
        scan.x_m = {6};
        scan.y_m = {0};
        scan.z_m = {0};
        const SegmentationResult result;
        distances.take(
            {scan, {Label::Roi}, Sweep{-2 * kPi, 0}, 1, 1.1, true, false, false, result});
        scan.clear();
        distances.take({scan,
                        {},
                        Sweep{turned_rad - 2 * kPi, turned_rad},
                        1.1,
                        1.15,
                        true,
                        false,
                        false,
                        result});
        return distances.at(1.15)[0].state;
    };
    EXPECT_EQ(stateAfter(kPi), State::Obstacle);
    EXPECT_EQ(stateAfter(radians(360)), State::Obstacle);  // within the obstacle's degree
    EXPECT_EQ(stateAfter(radians(361)), State::SeenNothing);
}

TEST_F(DirectionsInFlight, KeepsTiltWithoutAttitude) {
    Flight flight;
    flight.has_attitude = flight.has_place = false;
    flight.poles = around();
    SectorDistances distances(sensor_, aheadFirst());
    flight.fly(0.3, distances);
    EXPECT_GT(compare(flight, distances, 0.3), 3);
}

}  // namespace
}  // namespace hagen::live
