#include <hagen/avoidance/ClearanceErrors.h>
#include <hagen/avoidance/TrialSensor.h>
#include <hagen/avoidance/WorldModel.h>
#include <hagen/base/NumberText.h>
#include <hagen/base/Quantile.h>
#include <hagen/scan/Angle.h>
#include <hagen/simulation/SceneBuilder.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "avoidance/flights/CsvNumbers.h"

namespace hagen::avoidance {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSpeed_m_s = 4, kAltitude_m = 2.5, kHeight_m = 6;
constexpr double kFirst_s = 1, kLast_s = 2.6;
constexpr double kNearest_m = 0.3, kFarthest_m = 1.5, kAboveOrBelow_m = 0.5;
constexpr double kMissed_m = 1;
constexpr int kQueriesPerScan = 40;
constexpr std::uint64_t kSceneStream = 1, kPathStream = 2, kQueryStream = 3;

/// Seen from above: a pole, or a wall if its radius is 0.
struct Obstacle {
    std::string name;
    double radius_m;
    double half_length_m = 0, half_thickness_m = 0;
};

const std::vector<Obstacle>& obstacles() {
    static const std::vector<Obstacle> all{{"wall", 0, 3, 0.15},
                                           {"pole of 5 cm radius", 0.05},
                                           {"pole of 15 cm radius", 0.15},
                                           {"pole of 30 cm radius", 0.30}};
    return all;
}

/// An obstacle in its place.
struct Placed {
    Obstacle obstacle;
    Vector2d middle_m;
    double yaw_rad;
};

struct Border {
    Vector2d at_m, outwards;
};

/// A random place on the outline of an obstacle, seen from above.
Border borderOf(const Placed& placed, simulation::Random& random) {
    const Obstacle& obstacle = placed.obstacle;
    Vector2d at_m, outwards;
    if (obstacle.radius_m > 0) {
        const double azimuth_rad = random.uniform(0, 2 * kPi);
        outwards = {std::cos(azimuth_rad), std::sin(azimuth_rad)};
        at_m = obstacle.radius_m * outwards;
    } else {
        const double length_m = obstacle.half_length_m, thickness_m = obstacle.half_thickness_m;
        const double side = random.chance(0.5) ? 1 : -1;
        const double along = random.uniform(-1, 1);
        const bool is_end = random.chance(thickness_m / (length_m + thickness_m));
        outwards = is_end ? Vector2d(side, 0) : Vector2d(0, side);
        at_m = is_end ? Vector2d(side * length_m, along * thickness_m)
                      : Vector2d(along * length_m, side * thickness_m);
    }
    const Eigen::Rotation2Dd turned(placed.yaw_rad);
    return {placed.middle_m + turned * at_m, turned * outwards};
}

/// Beside the straight path along x, 9 m ahead; how far beside depends on the seed, as does where
/// it lies in a map's voxels.
Placed placedBeside(const Obstacle& obstacle, simulation::Random& random) {
    const double aside_m = random.uniform(0.8, 3), side = random.chance(0.5) ? 1 : -1;
    const double x_m = 9 + random.uniform(-0.4, 0.4), y_m = random.uniform(-0.4, 0.4);
    const double yaw_rad = radians(random.uniform(-20, 20));
    const double reach_m =
        obstacle.radius_m > 0
            ? obstacle.radius_m
            : obstacle.half_length_m * std::abs(std::sin(yaw_rad)) + obstacle.half_thickness_m;
    return {obstacle, {x_m, y_m + side * (aside_m + 0.4 + reach_m)}, yaw_rad};
}

simulation::Scene sceneWith(const Placed& placed) {
    simulation::TerrainParameters level;
    level.max_slope_rad = level.bump_m = level.roughness_m = level.grass_m = 0;
    simulation::SceneBuilder builder(level, {40, 20, 90}, simulation::Random(1));
    simulation::Shape shape;
    const auto height_m = static_cast<float>(kHeight_m);
    const Obstacle& obstacle = placed.obstacle;
    const auto radius_m = static_cast<float>(obstacle.radius_m);
    const auto length_m = static_cast<float>(obstacle.half_length_m);
    const auto thickness_m = static_cast<float>(obstacle.half_thickness_m);
    if (obstacle.radius_m > 0) {
        shape.addRod({{0, 0, -0.5f, radius_m}, {0, 0, height_m, radius_m}});
    } else {
        shape.addBox({-length_m, -thickness_m, -0.5f}, {length_m, thickness_m, height_m});
    }
    const bool is_pole = obstacle.radius_m > 0;
    builder.place(is_pole ? simulation::ObjectClass::Pole : simulation::ObjectClass::Wall,
                  builder.addShape(std::move(shape)), placed.middle_m.x(), placed.middle_m.y(),
                  placed.yaw_rad);
    return builder.build();
}

/// Along x, weaving by some centimetres, so that rows fall elsewhere from scan to scan.
FlightTrace traceOf(simulation::Random& random) {
    constexpr double kAcross_m = 0.15, kUp_m = 0.1, kRate_rad_s = 2.5;
    const double across_rad = random.uniform(0, 2 * kPi), up_rad = random.uniform(0, 2 * kPi);
    const Vector3d middle(0, random.uniform(-0.2, 0.2), kAltitude_m);
    const auto weave = [&](double time_s) -> Vector3d {
        return {0, kAcross_m * std::sin(kRate_rad_s * time_s + across_rad),
                kUp_m * std::sin(kRate_rad_s * time_s + up_rad)};
    };
    const auto at = [&](double time_s) -> Vector3d {
        return middle + weave(time_s) + Vector3d(kSpeed_m_s * time_s, 0, 0);
    };
    FlightTrace trace({at(0), {kSpeed_m_s, 0, 0}});
    for (double time_s = avoidance::kControlStep_s; time_s < kLast_s + 0.2;
         time_s += avoidance::kControlStep_s) {
        trace.add({at(time_s), {kSpeed_m_s, 0, 0}}, -kRate_rad_s * kRate_rad_s * weave(time_s));
    }
    return trace;
}

void removeSpecks(simulation::SimulatedScan& measured) {
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (measured.kind[i] == simulation::ObjectClass::Dust) {
            measured.scan.range_m[i] = std::numeric_limits<float>::quiet_NaN();
        }
    }
}

/// The flight past one obstacle.
class Passing {
 public:
    Passing(const Obstacle& obstacle, std::uint64_t seed, const ClearanceMeasurement& measurement,
            ClearanceErrors* errors)
        : measurement_(measurement),
          errors_(errors),
          scene_random_(seed, kSceneStream),
          path_random_(seed, kPathStream),
          query_random_(seed, kQueryStream),
          placed_(placedBeside(obstacle, scene_random_)),
          course_(courseWith(placed_, seed)),
          trace_(traceOf(path_random_)) {}

    void fly() {
        avoidance::WorldModelSetting setting;
        setting.bounds_m = course_.bounds_m.cast<float>();
        setting.pace = {kSpeed_m_s, TrialSensor::kTurn_s, {}};
        setting.distance = measurement_.distance;
        std::vector<std::unique_ptr<avoidance::WorldModel>> models;
        for (const std::string& model : measurement_.models) {
            models.push_back(avoidance::makeWorldModel(model, setting));
        }
        TrialSensor sensor(course_, Air::Dusty);
        PoseBelief belief(PoseError::None, course_.seed);
        for (int turn = 0; (turn + 1) * TrialSensor::kTurn_s < kLast_s; ++turn) {
            simulation::SimulatedScan measured = sensor.measure(turn, trace_);
            if (!measurement_.has_specks) removeSpecks(measured);
            const LabelledReturns& returns = sensor.segment(turn, measured, trace_, belief);
            const observations::MappedScan scan =
                TrialSensor::place(turn, measured, returns, trace_, belief);
            for (const auto& model : models) model->update(scan);
            if (scan.time_s >= kFirst_s) query(models, scan.time_s);
            if (measurement_.continuing) measurement_.continuing();
        }
    }

 private:
    static Course courseWith(const Placed& placed, std::uint64_t seed) {
        const simulation::Scene scene = sceneWith(placed);
        const Eigen::AlignedBox3d bounds(Vector3d(-6, -10, -1), Vector3d(20, 10, 6));
        return {placed.obstacle.name,
                seed,
                scene,
                simulation::SceneDistance(scene, bounds, avoidance::WorldModel::kReach_m),
                {0, 0, kAltitude_m},
                {kLast_s * kSpeed_m_s, 0, kAltitude_m},
                kAltitude_m,
                bounds,
                0};
    }

    /// Whether the sensor sees a place, past the obstacle.
    static bool isSeen(const simulation::Scene::Snapshot& snapshot, const Eigen::Vector3f& from_m,
                       const Eigen::Vector3f& at_m) {
        const Eigen::Vector3f way_m = at_m - from_m;
        std::vector<simulation::RayHit> hits;
        snapshot.cast({{from_m, way_m.normalized(), 0, way_m.norm()}}, way_m.norm(), hits);
        return std::isnan(hits.front().range_m);
    }

    void query(const std::vector<std::unique_ptr<avoidance::WorldModel>>& models, double time_s) {
        const auto snapshot = course_.scene.snapshotOver(time_s, 1e-6);
        const Eigen::Vector3f sensor_m = trace_.at(time_s).position_m.cast<float>();
        for (int asked = 0; asked < kQueriesPerScan;) {
            const Border border = borderOf(placed_, query_random_);
            const Vector2d place =
                border.at_m + query_random_.uniform(kNearest_m, kFarthest_m) * border.outwards;
            const double up_m = query_random_.uniform(-kAboveOrBelow_m, kAboveOrBelow_m);
            const Eigen::Vector3f at_m =
                Vector3d(place.x(), place.y(), kAltitude_m + up_m).cast<float>();
            if (!isSeen(snapshot, sensor_m, at_m)) continue;
            ++asked;
            const float true_m = course_.distance.toStatic(at_m);
            for (std::size_t m = 0; m < models.size(); ++m) {
                const auto error_m = static_cast<double>(models[m]->clearance_m(at_m) - true_m);
                if (error_m > kMissed_m) {
                    ++errors_[m].missed;
                } else {
                    errors_[m].errors_m.push_back(error_m);
                }
            }
        }
    }

    const ClearanceMeasurement& measurement_;
    ClearanceErrors* errors_;  ///< of each model
    simulation::Random scene_random_, path_random_, query_random_;
    Placed placed_;
    Course course_;
    FlightTrace trace_;
};

double meanOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<std::string> modelsOf(const std::vector<ClearanceErrors>& all) {
    std::vector<std::string> models;
    for (const ClearanceErrors& one : all) {
        if (std::find(models.begin(), models.end(), one.model) == models.end()) {
            models.push_back(one.model);
        }
    }
    return models;
}

}  // namespace

const std::vector<std::string>& measuredObstacles() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> of_all;
        for (const Obstacle& obstacle : obstacles()) of_all.push_back(obstacle.name);
        return of_all;
    }();
    return names;
}

std::string kindOf(const std::string& obstacle) { return obstacle.substr(0, obstacle.find(' ')); }

std::vector<ClearanceErrors> measureClearances(const ClearanceMeasurement& measurement) {
    const std::size_t count = measurement.models.size();
    for (const std::string& model : measurement.models) {
        if (avoidance::needsTruth(model)) {
            throw std::invalid_argument("'" + model + "' answers with the truth");
        }
    }
    std::vector<ClearanceErrors> by_obstacle;
    for (const Obstacle& obstacle : obstacles()) {
        for (const std::string& model : measurement.models) {
            by_obstacle.push_back({model, obstacle.name, {}});
        }
    }
    for (std::uint64_t seed = measurement.first_seed; seed <= measurement.last_seed; ++seed) {
        if (measurement.doing) measurement.doing(seed);
        for (std::size_t o = 0; o < obstacles().size(); ++o) {
            Passing(obstacles()[o], seed, measurement, &by_obstacle[o * count]).fly();
        }
        if (seed == measurement.last_seed) break;  // it may be the greatest number
    }
    std::vector<ClearanceErrors> all;
    for (std::size_t m = 0; m < count; ++m) {
        for (std::size_t o = 0; o < obstacles().size(); ++o) {
            all.push_back(std::move(by_obstacle[o * count + m]));
        }
    }
    return all;
}

ErrorSpread spreadOf(const std::vector<ClearanceErrors>& all, const std::string& model,
                     const std::string& kind) {
    ErrorSpread spread{};
    std::vector<double> errors_m;
    for (const ClearanceErrors& one : all) {
        if (one.model != model || (one.obstacle != kind && kindOf(one.obstacle) != kind)) continue;
        errors_m.insert(errors_m.end(), one.errors_m.begin(), one.errors_m.end());
        spread.missed += one.missed;
    }
    spread.queries = static_cast<int>(errors_m.size()) + spread.missed;
    spread.mean_m = meanOf(errors_m);
    double squares_m2 = 0;
    for (const double error_m : errors_m) squares_m2 += std::pow(error_m - spread.mean_m, 2);
    spread.deviation_m = std::sqrt(squares_m2 / static_cast<double>(errors_m.size()));
    spread.p05_m = base::quantile(errors_m, 0.05);
    spread.median_m = base::quantile(errors_m, 0.5);
    spread.p95_m = base::quantile(errors_m, 0.95);
    return spread;
}

double biasOf_m(const std::vector<ClearanceErrors>& all, const std::string& model) {
    return (spreadOf(all, model, "wall").mean_m + spreadOf(all, model, "pole").mean_m) / 2;
}

std::string clearanceMarkdown(const std::vector<ClearanceErrors>& all) {
    std::string text =
        "| world model | obstacle | queries | missed | mean [cm] | median | standard deviation | "
        "5 % | 95 % | bias of the model |\n|---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    const auto cm = [](double value_m) { return base::fixedText(100 * value_m, 1); };
    for (const std::string& model : modelsOf(all)) {
        for (const char* kind : {"wall", "pole"}) {
            const ErrorSpread spread = spreadOf(all, model, kind);
            text += "| " + avoidance::displayName(model) + " | " + kind + " | " +
                    std::to_string(spread.queries) + " | " + std::to_string(spread.missed);
            for (const double value_m :
                 {spread.mean_m, spread.median_m, spread.deviation_m, spread.p05_m, spread.p95_m}) {
                text += " | " + cm(value_m);
            }
            text += " | " + cm(biasOf_m(all, model)) + " |\n";
        }
    }
    return text;
}

std::string clearanceCsv(const std::vector<ClearanceErrors>& all) {
    std::string text = "model,obstacle,queries,missed,mean_m,median_m,deviation_m,p05_m,p95_m\n";
    for (const ClearanceErrors& one : all) {
        const ErrorSpread spread = spreadOf(all, one.model, one.obstacle);
        text += one.model + "," + one.obstacle + "," + std::to_string(spread.queries) + "," +
                std::to_string(spread.missed);
        for (const double value_m :
             {spread.mean_m, spread.median_m, spread.deviation_m, spread.p05_m, spread.p95_m}) {
            text += "," + measureText(value_m, 4);
        }
        text += "\n";
    }
    return text;
}

std::string biasTable(const std::vector<ClearanceErrors>& all) {
    std::string text;
    for (const std::string& model : modelsOf(all)) {
        text += "        {\"" + model + "\", " + base::fixedText(biasOf_m(all, model), 3) + "f},\n";
    }
    return text;
}

}  // namespace hagen::avoidance
