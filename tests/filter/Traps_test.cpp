// Scenes in which a filter may mistake dangerous objects for ground. Walls, ceilings, furniture and
// foliage in the zone must be RoI. If the floor is clearly visible, most of it must be ROU.
#include <gtest/gtest.h>
#include <hagen/filter/HagenFilter.h>

#include <functional>
#include <string>
#include <vector>

#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

using Eigen::Vector3d;
using test::Hit;
using test::SimpleScene;

/// The sensor's tilt, unknown to the filter.
struct Tilt {
    double pitch_rad = 0, roll_rad = 0;
};

struct Sight {
    SimpleScene scene;
    Vector3d sensor_m;
    Tilt tilt = {};
    /// Maximum height of floors; obstacles more than 0.3 m above them are dangers.
    double floor_m = 0;
    /// Changes the hit of a ray, e.g. for leaves or water.
    std::function<void(const Vector3d& direction, Hit&, test::Random&)> change = {};
    /// Omits the beams below the sensor's horizon.
    bool upwards_only = false;
};

/// Counts returns within the zone.
struct Outcome {
    int dangers = 0, missed_dangers = 0;
    int floors = 0, rou_floors = 0;
    int rou = 0;

    double floorShare() const { return floors > 0 ? 1.0 * rou_floors / floors : 0.0; }
};

Outcome outcome(const Sight& sight, const std::string& sensor_name) {
    const SensorModel sensor = sensorModel(sensor_name);
    const Eigen::Matrix3d world_from_sensor =
        (Eigen::AngleAxisd(sight.tilt.pitch_rad, Vector3d::UnitY()) *
         Eigen::AngleAxisd(sight.tilt.roll_rad, Vector3d::UnitX()))
            .toRotationMatrix();
    test::Random random(5);
    const auto change = [&](const Vector3d& direction, Hit& hit) {
        if (sight.change) sight.change(direction, hit, random);
        const double up = world_from_sensor.col(2).dot(direction);
        if (sight.upwards_only && up < 1e-9) hit = {};
    };
    const test::LabelledScan seen =
        test::scanScene(sight.scene, sensor, 870, sight.sensor_m, world_from_sensor, change);

    HagenFilter filter(sensor);
    const std::vector<Label>& label = filter.segment(seen.scan).returns.label;
    const auto heightOf = [&](std::size_t i) {  // above floor_m
        const Eigen::Vector3f at(seen.scan.x_m[i], seen.scan.y_m[i], seen.scan.z_m[i]);
        return (sight.sensor_m + world_from_sensor * at.cast<double>()).z() - sight.floor_m;
    };
    Outcome o;
    for (std::size_t i = 0; i < seen.scan.size(); ++i) {
        const float range_m = seen.scan.range_m[i];
        if (range_m > filter.options().zone_m || range_m < sensor.min_range_m) continue;
        o.rou += label[i] == Label::Rou;
        if (seen.truth[i] == Label::Rou) {
            ++o.floors;
            o.rou_floors += label[i] == Label::Rou;
        } else if (heightOf(i) > 0.3) {
            ++o.dangers;
            o.missed_dangers += label[i] != Label::Roi;
        }
    }
    return o;
}

const std::vector<std::string> kSensors{"VLP-16", "HDL-32E", "HDL-64E"};

/// Level, pitched and rolled, as in flight.
const std::vector<Tilt> kTilts{{0, 0}, {0.2, 0}, {0, 0.15}};

/// Calls visit(outcome, sensor) for all sensors when level, and for the VLP-16 also when tilted.
template <class Visit>
void forEachSensor(Sight sight, Visit visit) {
    for (const std::string& sensor : kSensors) {
        for (const Tilt& tilt : kTilts) {
            sight.tilt = tilt;
            SCOPED_TRACE(testing::Message()
                         << sensor << " at " << sight.sensor_m.transpose() << ", pitch "
                         << tilt.pitch_rad << ", roll " << tilt.roll_rad);
            visit(outcome(sight, sensor), sensor);
            if (sensor != "VLP-16") break;
        }
    }
}

void addWalls(SimpleScene& scene, const Eigen::Vector2d& low_m, const Eigen::Vector2d& high_m,
              double height_m) {
    constexpr double kThick_m = 0.2;
    const double x0 = low_m.x() - kThick_m, y0 = low_m.y() - kThick_m;
    const double x1 = high_m.x() + kThick_m, y1 = high_m.y() + kThick_m;
    scene.boxes.push_back({{x0, y0, 0}, {low_m.x(), y1, height_m}});
    scene.boxes.push_back({{high_m.x(), y0, 0}, {x1, y1, height_m}});
    scene.boxes.push_back({{x0, y0, 0}, {x1, low_m.y(), height_m}});
    scene.boxes.push_back({{x0, high_m.y(), 0}, {x1, y1, height_m}});
}

/// Walls and a ceiling.
SimpleScene indoors(const Eigen::Vector2d& low_m, const Eigen::Vector2d& high_m, double height_m) {
    SimpleScene scene;
    addWalls(scene, low_m, high_m, height_m);
    scene.boxes.push_back(
        {{low_m.x(), low_m.y(), height_m}, {high_m.x(), high_m.y(), height_m + 0.3}});
    return scene;
}

/// Adds a desk: a 0.75 m high board on two panels.
void addDesk(SimpleScene& scene, double x0, double y0, double x1, double y1) {
    scene.boxes.push_back({{x0, y0, 0.72}, {x1, y1, 0.75}});
    scene.boxes.push_back({{x0 + 0.05, y0 + 0.05, 0}, {x0 + 0.1, y1 - 0.05, 0.72}});
    scene.boxes.push_back({{x1 - 0.1, y0 + 0.05, 0}, {x1 - 0.05, y1 - 0.05, 0.72}});
}

SimpleScene emptyRoom() { return indoors({-3, -2.5}, {3, 2.5}, 2.6); }

SimpleScene furnishedRoom() {
    SimpleScene room = emptyRoom();
    addDesk(room, -3, -2.5, -1.4, -1.7);
    addDesk(room, -1.2, -2.5, 0.4, -1.7);
    addDesk(room, 0.9, 1.7, 2.5, 2.5);
    addDesk(room, 2.2, -1.5, 3, 0.1);
    room.boxes.push_back({{-3, 1.9, 0}, {-2, 2.5, 1.9}});            // a cupboard
    room.boxes.push_back({{-2, 2.1, 0}, {-0.6, 2.5, 0.85}});         // a sideboard
    room.boxes.push_back({{-1, -1.5, 0.42}, {-0.55, -1.05, 0.47}});  // two chairs
    room.boxes.push_back({{-1, -1.1, 0}, {-0.55, -1.05, 0.9}});
    room.boxes.push_back({{1.4, 1.0, 0.42}, {1.85, 1.45, 0.47}});
    room.boxes.push_back({{1.4, 1.0, 0}, {1.85, 1.05, 0.9}});
    return room;
}

const std::vector<Vector3d> kPlacesInRoom{
    {0.3, 0.2, 1.1},  {-1.5, -0.8, 1.1}, {-0.9, -0.5, 1.1}, {-0.3, -0.2, 1.1}, {0.9, -0.8, 1.1},
    {1.5, -0.5, 1.1}, {0.3, 0.2, 1.5},   {0.3, 0.2, 0.3},   {-0.9, -0.5, 0.2}, {0.9, -0.8, 0.6}};

TEST(Traps, ObstaclesAreRoiInFurnishedRoom) {
    forEachSensor({furnishedRoom(), kPlacesInRoom.front()},
                  [](const Outcome& o, const std::string& sensor) {
                      EXPECT_GT(o.dangers, 10000);
                      EXPECT_EQ(o.missed_dangers, 0);
                      // Other sensors see a lot of furniture at floor height.
                      if (sensor == "HDL-32E") {
                          EXPECT_GT(o.floorShare(), 0.95);
                      }
                  });
    for (const Vector3d& place_m : kPlacesInRoom) {
        EXPECT_EQ(outcome({furnishedRoom(), place_m}, "VLP-16").missed_dangers, 0)
            << place_m.transpose();
    }
}

// Desks are as high and dense as crops, but surrounded by walls.
TEST(Traps, FurnishedRoomIsNotCrop) {
    EXPECT_EQ(outcome({furnishedRoom(), {0.3, 0.2, 1.1}, {0, 0.15}}, "HDL-64E").missed_dangers, 0);
    const Outcome pitched = outcome({furnishedRoom(), {-0.9, -0.5, 1.1}, {0.2, 0}}, "HDL-64E");
    EXPECT_LE(pitched.missed_dangers, 0.002 * pitched.dangers);  // close to a tilted plane
}

SimpleScene corridor() { return indoors({-15, -1}, {15, 1}, 2.5); }

TEST(Traps, ObstaclesAreRoiInCorridor) {
    for (const std::string& sensor : kSensors) {
        for (const double x_m : {-12.0, 0.0}) {
            const Outcome o = outcome({corridor(), {x_m, 0.2, 1.1}}, sensor);
            EXPECT_GT(o.dangers, 10000) << sensor;
            EXPECT_EQ(o.missed_dangers, 0) << sensor << " " << x_m;
            // Near the end of the corridor, the VLP-16 sees too little of the floor.
            if (sensor != "VLP-16" || x_m == 0) {
                EXPECT_GT(o.floorShare(), 0.95) << sensor << " " << x_m;
            }
        }
    }
    const Outcome rolled = outcome({corridor(), {0, 0.2, 1.1}, {0, 0.15}}, "VLP-16");
    EXPECT_EQ(rolled.missed_dangers, 0);
    EXPECT_GT(rolled.floorShare(), 0.95);
}

TEST(Traps, CorridorEndIsNotCrop) {
    const Outcome pitched = outcome({corridor(), {-12, 0.2, 1.1}, {0.2, 0}}, "HDL-64E");
    EXPECT_LE(pitched.missed_dangers, 0.003 * pitched.dangers);  // close to a tilted plane
}

SimpleScene hall() { return indoors({-20, -15}, {20, 15}, 8); }

TEST(Traps, ObstaclesAreRoiInHall) {
    for (const std::string& sensor : kSensors) {
        for (const double height_m : {1.1, 4.0, 7.0}) {
            const Outcome o = outcome({hall(), {3, 2, height_m}}, sensor);
            EXPECT_GT(o.dangers, 4500) << sensor;
            EXPECT_EQ(o.missed_dangers, 0) << sensor << " " << height_m;
            if (o.floors > 0) {  // from 7 m, the VLP-16 sees no floor in its zone
                EXPECT_GT(o.floorShare(), 0.95) << sensor << " " << height_m;
            }
        }
    }
}

/// A deck 5 m above the ground, on pillars.
SimpleScene bridge() {
    SimpleScene scene;
    scene.boxes.push_back({{-6, -40, 5}, {6, 40, 6}});
    for (const double y_m : {-24.0, -12.0, 0.0, 12.0, 24.0}) {
        for (const double x_m : {-4.0, 4.0}) {
            scene.boxes.push_back({{x_m - 0.5, y_m - 0.5, 0}, {x_m + 0.5, y_m + 0.5, 5}});
        }
    }
    return scene;
}

TEST(Traps, BridgeIsRoi) {
    for (const double height_m : {1.5, 3.5}) {
        forEachSensor({bridge(), {1, 3, height_m}}, [](const Outcome& o, const std::string&) {
            EXPECT_GT(o.dangers, 2000);
            EXPECT_EQ(o.missed_dangers, 0);
            EXPECT_GT(o.floorShare(), 0.99);
        });
    }
}

/// A balcony 12 m above the street, 2 m deep, with a rail, between its house and another house.
SimpleScene balcony() {
    SimpleScene scene;
    scene.boxes = {{{2, -20, 0}, {10, 20, 30}}, {{-30, -40, 0}, {-14, 40, 15}}};
    scene.boxes.push_back({{0, -4, 11.8}, {2, 4, 11.99}});
    scene.floors.push_back({{0, -4}, {2, 4}, 12});
    scene.boxes.push_back({{-0.05, -4, 12.95}, {0, 4, 13}});
    scene.boxes.push_back({{0, -4, 12.95}, {2, -3.95, 13}});
    scene.boxes.push_back({{0, 3.95, 12.95}, {2, 4, 13}});
    for (int bar = 0; bar < 32; ++bar) {
        const double y_m = -4 + 0.25 * bar;
        scene.boxes.push_back({{-0.04, y_m, 12}, {-0.02, y_m + 0.02, 12.95}});
    }
    return scene;
}

TEST(Traps, BalconyRailIsRoi) {
    for (const Vector3d& place_m : {Vector3d(0.5, 0, 13.5), {-1.5, 0.3, 13.2}}) {
        Sight sight{balcony(), place_m};
        sight.floor_m = 12;
        forEachSensor(sight, [](const Outcome& o, const std::string&) {
            EXPECT_GT(o.dangers, 5000);
            EXPECT_EQ(o.missed_dangers, 0);
        });
    }
}

/// Walls, a roof, branches and masts.
SimpleScene yard() {
    SimpleScene scene;
    scene.boxes = {
        {{4, -9, 0}, {12, -7, 6}}, {{-14, 4, 0}, {-6, 5, 4}}, {{-40, -40, 7}, {40, -10, 7.3}}};
    scene.poles = {{7, 1, 0.1, 6}, {-5, -3, 0.15, 8}, {3, -4, 0.2, 7}};
    for (int branch = 0; branch < 12; ++branch) {
        const double k = branch;
        scene.boxes.push_back({{5 + 0.5 * k, 3 + 0.3 * k, 2.5 + 0.05 * k},
                               {7 + 0.5 * k, 5 + 0.3 * k, 2.8 + 0.05 * k}});
    }
    return scene;
}

TEST(Traps, ReturnsAboveHorizonAreRoi) {
    for (Sight sight :
         {Sight{yard(), {0, 0, 1.5}}, Sight{furnishedRoom(), {0.3, 0.2, 1.1}},
          Sight{hall(), {3, 2, 1.5}}, Sight{bridge(), {1, 3, 1.5}}, Sight{corridor(), {0, 0, 1}}}) {
        sight.upwards_only = true;
        forEachSensor(sight, [](const Outcome& o, const std::string&) {
            EXPECT_GT(o.dangers, 500);
            EXPECT_EQ(o.rou, 0);
        });
    }
}

/// Leaves 3 to 6 m away in every direction hide this share of the returns behind them.
auto leaves(double share) {
    return [share](const Vector3d&, Hit& hit, test::Random& random) {
        const bool is_hidden = random.chance(share);
        const double leaf_m = static_cast<double>(random.real(3, 6));
        if (is_hidden && leaf_m < hit.range_m) hit = {leaf_m, Label::Roi};
    };
}

TEST(Traps, FoliageWithoutGroundIsRoi) {
    SimpleScene nothing;
    nothing.has_ground = false;
    for (const std::string& sensor : kSensors) {
        for (const double share : {0.6, 0.9}) {
            Sight sight{nothing, {0, 0, 10}};
            sight.change = leaves(share);
            const Outcome o = outcome(sight, sensor);
            EXPECT_GT(o.dangers, 8000) << sensor;
            EXPECT_EQ(o.missed_dangers, 0) << sensor << " " << share;
        }
    }
}

TEST(Traps, FoliageOverLittleGroundIsRoi) {
    for (const std::string& sensor : kSensors) {
        for (const double share : {0.6, 0.95}) {
            for (const double height_m : {1.5, 3.0}) {
                if (sensor == "HDL-64E" && height_m < 2) continue;  // slow
                Sight sight{{}, {0, 0, height_m}};
                sight.change = leaves(share);
                const Outcome o = outcome(sight, sensor);
                EXPECT_GT(o.dangers, 7000) << sensor;
                EXPECT_LE(o.missed_dangers, 0.01 * o.dangers)  // measured: at most 0.6 %
                    << sensor << " " << share << " " << height_m;
                // From 3 m, dense leaves hide too much of the ground.
                if (height_m < 2 || share < 0.9) {
                    EXPECT_GT(o.floorShare(), 0.85) << sensor << " " << share << " " << height_m;
                }
            }
        }
    }
}

// The lowest leaves between the sensor and the first ring of ground, 11 m away, look like ground
// that rises to 1.5 m, slightly more than allowed for hidden ground.
TEST(Traps, LeavesBeforeFirstGroundRingAreRoi) {
    Sight sight{{}, {0, 0, 3}};
    sight.change = leaves(0.6);
    EXPECT_EQ(outcome(sight, "VLP-16").missed_dangers, 0);
}

/// Ground up to x = 3 m; the ground beyond is 20 m lower.
SimpleScene cliff() {
    SimpleScene scene;
    scene.has_ground = false;
    scene.floors = {{{-100, -100}, {3, 100}, 0}, {{3, -100}, {100, 100}, -20}};
    scene.poles = {{-5, 4, 0.2, 4}, {2, -3, 0.1, 2}};
    scene.boxes = {{{-9, -8, 0}, {-7, -5, 3}}};
    return scene;
}

TEST(Traps, ObstaclesAreRoiAtCliff) {
    for (const double x_m : {0.0, 6.0}) {
        forEachSensor({cliff(), {x_m, 0, 2}}, [](const Outcome& o, const std::string& sensor) {
            EXPECT_GT(o.dangers, 200);
            EXPECT_EQ(o.missed_dangers, 0);
            // The HDL-32E also sees the ground below the cliff and finds no plane.
            if (sensor != "HDL-32E") {
                EXPECT_GT(o.floorShare(), 0.95);
            }
        });
    }
}

/// Removes ground returns within `reach_m`, as over water.
auto water(double reach_m) {
    return [reach_m](const Vector3d& direction, Hit& hit, test::Random&) {
        const double distance_m = hit.range_m * direction.head<2>().norm();
        if (hit.label == Label::Rou && distance_m < reach_m) hit = {};
    };
}

/// Posts in the water and a house on the bank.
SimpleScene lake() {
    return test::sceneOf({{{17, -3, 0}, {19, 3, 4}}},
                         {{6, 1, 0.1, 3}, {-3, -5, 0.1, 1.5}, {4, 9, 0.4, 5}});
}

TEST(Traps, ObstaclesAreRoiInWaterUpToBank) {
    for (const auto& [reach_m, height_m] : {std::pair{10.0, 1.5}, {15.0, 1.5}, {15.0, 4.0}}) {
        Sight sight{lake(), {0, 0, height_m}};
        sight.change = water(reach_m);
        forEachSensor(sight, [](const Outcome& o, const std::string&) {
            EXPECT_GT(o.dangers, 100);
            EXPECT_EQ(o.missed_dangers, 0);
            EXPECT_GT(o.floorShare(), 0.95);
        });
    }
}

TEST(Traps, ObstaclesAreRoiOverOpenWater) {
    SimpleScene scene = lake();
    scene.has_ground = false;
    forEachSensor({scene, {0, 0, 4}}, [](const Outcome& o, const std::string&) {
        EXPECT_GT(o.dangers, 100);
        EXPECT_EQ(o.rou, 0);
    });
}

TEST(Traps, ObstaclesAreRoiWhenHoveringLow) {
    const SimpleScene scene =
        test::sceneOf({{{5, -4, 0}, {6, 0, 2}}, {{-3, -3, 0}, {-2.5, -2.5, 0.5}}},
                      {{3, 1, 0.1, 2}, {-4, 2, 0.05, 1}, {1, -2, 0.05, 1}});
    forEachSensor({scene, {0, 0, 0.3}}, [](const Outcome& o, const std::string&) {
        EXPECT_GT(o.dangers, 100);
        EXPECT_EQ(o.missed_dangers, 0);
        EXPECT_GT(o.floors, 6000);
        EXPECT_GT(o.floorShare(), 0.85);  // without evidence beyond 12 m
    });
}

TEST(Traps, TowerIsRoi) {
    const SimpleScene scene = test::sceneOf({{{10, -8, 0}, {20, 8, 60}}});
    forEachSensor({scene, {0, 0, 30}}, [](const Outcome& o, const std::string&) {
        EXPECT_GT(o.dangers, 2500);
        EXPECT_EQ(o.rou, 0);
    });
}

}  // namespace
}  // namespace hagen
