#include "avoidance/replays/FlightRecording.h"

#include <hagen/scan/Angle.h>
#include <cmath>
#include "avoidance/flights/TrialScore.h"

#include "base/NumberText.h"

namespace hagen::avoidance {
namespace {

/// Evenly spread directions: a Fibonacci spiral from pole to pole.
std::vector<simulation::Ray> raysAround(const Eigen::Vector3f& at_m) {
    // 1.4 degrees apart, so that several rays hit a wire at 0.3 m.
    constexpr int kRays = 20000;
    const double golden = kPi * (3 - std::sqrt(5.0));
    std::vector<simulation::Ray> rays;
    rays.reserve(kRays);
    for (int i = 0; i < kRays; ++i) {
        const double z = 1 - (2 * i + 1.0) / kRays, r = std::sqrt(1 - z * z);
        const Eigen::Vector3d direction(r * std::cos(golden * i), r * std::sin(golden * i), z);
        rays.push_back({at_m, direction.cast<float>()});
    }
    return rays;
}

/// The class of the nearest object within `reach_m`; ObjectClass::None if there is none.
simulation::ObjectClass nearestKind(const simulation::Scene& scene, const Eigen::Vector3d& at_m,
                                    double time_s, double reach_m) {
    constexpr double kMoment_s = 0.001;
    std::vector<simulation::RayHit> hits;
    scene.snapshotOver(time_s, kMoment_s)
        .cast(raysAround(at_m.cast<float>()), static_cast<float>(reach_m), hits);
    simulation::RayHit nearest{static_cast<float>(reach_m)};
    for (const simulation::RayHit& hit : hits) {
        // Grass and crop bend and are not obstacles.
        if (hit.range_m <= nearest.range_m && hit.kind != simulation::ObjectClass::Canopy)
            nearest = hit;
    }
    return nearest.kind;
}

std::string wordsFor(simulation::ObjectClass kind) {
    switch (kind) {
        case simulation::ObjectClass::Terrain:
            return "the ground";
        case simulation::ObjectClass::Tree:
            return "a tree";
        case simulation::ObjectClass::Pole:
            return "a pole";
        case simulation::ObjectClass::Wire:
            return "a wire";
        case simulation::ObjectClass::Building:
            return "a building";
        case simulation::ObjectClass::Vehicle:
            return "a parked car";
        case simulation::ObjectClass::Wall:
            return "a wall or rock";
        case simulation::ObjectClass::Mover:
            return "a moving object";
        default:
            return "an obstacle";
    }
}

/// Which limit of TrialJudge a timeout exceeded.
std::string wordsForTimeout(const Course& course, const TrialResult& result, double speed_m_s,
                            const Eigen::Vector3d& end_m) {
    if (course.bounds_m.exteriorDistance(end_m) > TrialJudge::kOutside_m) return "left the course";
    if (result.time_s > TrialJudge::longestFlight_s(course, speed_m_s)) return "ran out of time";
    return "gave up for lack of progress";
}

}  // namespace

std::string endingOf(const Course& course, const TrialResult& result, double speed_m_s,
                     const Eigen::Vector3d& end_m) {
    const std::string at = " at " + base::fixedText(result.time_s, 2) + " s";
    if (result.outcome == Outcome::Success) return "reached the goal" + at;
    if (result.outcome == Outcome::Timeout) {
        return wordsForTimeout(course, result, speed_m_s, end_m) + at;
    }
    const auto clearance_m =
        static_cast<double>(course.distance.at(end_m.cast<float>(), result.time_s));
    constexpr double kMore_m = 0.05;  // because rays may miss the nearest point
    const simulation::ObjectClass kind =
        nearestKind(course.scene, end_m, result.time_s, clearance_m + kMore_m);
    return "hit " + wordsFor(kind) + at + ": " + base::fixedText(clearance_m, 2) +
           " m from the vehicle's centre";
}

}  // namespace hagen::avoidance
