#include <hagen/scan/Angle.h>
#include <hagen/scan/Image.h>
#include <hagen/simulation/Lidar.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "simulation/BeamDirections.h"

namespace hagen::simulation {
namespace {

using Eigen::Vector3f;

constexpr int kBlock = 8;  // number of firings whose rays are cast together
constexpr double kPoseStep_s = 0.005;

/// Reflectivity of a surface; varies by 20 % between objects.
float reflectivityOf(ObjectClass kind, std::uint16_t number) {
    static const std::array<float, 12> shares{0.0f,  0.25f, 0.4f, 0.35f, 0.35f, 0.25f,
                                              0.35f, 0.3f,  0.3f, 0.3f,  0.1f,  0.1f};
    const float variation = static_cast<float>(number * 37 % 101) / 100.0f - 0.5f;
    return shares[static_cast<std::size_t>(kind)] * (1.0f + 0.4f * variation);
}

/// True for surfaces wider than a beam, where the range is measured at the footprint's centre.
bool isLargeSurface(ObjectClass kind) {
    return kind == ObjectClass::Terrain || kind == ObjectClass::Building ||
           kind == ObjectClass::Wall;
}

/// A part of the vehicle that occludes beams.
struct AirframeSpot {
    float azimuth_rad, half_width_rad, lowest_rad, highest_rad, range_m;
};

/// The parts of the vehicle: four legs and others.
const std::vector<AirframeSpot>& airframeOccluders() {
    static const std::vector<AirframeSpot> spots{
        {0.80f, 0.045f, -1.0f, -0.15f, 0.42f},  {2.35f, 0.045f, -1.0f, -0.15f, 0.44f},
        {-0.78f, 0.045f, -1.0f, -0.15f, 0.41f}, {-2.38f, 0.045f, -1.0f, -0.15f, 0.45f},
        {3.05f, 0.060f, 0.16f, 1.0f, 0.28f},    {1.57f, 0.020f, 0.20f, 1.0f, 0.66f}};
    return spots;
}

const AirframeSpot* airframeAt(float azimuth_rad, float elevation_rad) {
    for (const AirframeSpot& spot : airframeOccluders()) {
        if (elevation_rad >= spot.lowest_rad && elevation_rad <= spot.highest_rad &&
            std::abs(azimuth_rad - spot.azimuth_rad) < spot.half_width_rad) {
            return &spot;
        }
    }
    return nullptr;
}

bool isTilted(const Eigen::Quaterniond& mount) { return std::abs(mount.w()) < 1.0; }

/// The sensor's poses during a revolution, interpolated linearly between a few samples.
class RevolutionPoses {
 public:
    RevolutionPoses(const PoseAt& pose_at, double start_s, double duration_s) {
        for (double s = 0; s < duration_s + 2 * kPoseStep_s; s += kPoseStep_s) {
            poses_.push_back(pose_at(start_s + s));
        }
    }
    SensorPose at(double since_start_s) const {
        const double step = since_start_s / kPoseStep_s;
        const auto before = static_cast<std::size_t>(step);
        const double share = step - static_cast<double>(before);
        const SensorPose &a = poses_[before], &b = poses_[before + 1];
        return {a.position_m + share * (b.position_m - a.position_m),
                a.attitude.slerp(share, b.attitude)};
    }

 private:
    std::vector<SensorPose> poses_;
};

struct Beam : BeamDirection {
    Vector3f axis;  ///< direction in the map
};

/// All beams of a revolution or a part of it, each with a ray at a random position in its
/// footprint. Sorted by block of firings, then laser, then firing, so that eight similar rays are
/// adjacent.
struct Revolution {
    std::vector<Beam> beams;
    std::vector<Ray> rays;
    int lasers;
    FiringRange firings;

    std::size_t index(int firing, int laser) const {
        const int at = firing - firings.first;
        const int block = at / kBlock * kBlock;
        const int width = std::min(kBlock, firings.end - firings.first - block);
        return static_cast<std::size_t>(block * lasers + laser * width + at - block);
    }
};

/// Draws random positions in the footprints of beams.
struct Footprint {
    double width_rad;
    /// True if beams may be near the zenith, where the simpler footprint would shrink with the
    /// cosine of the elevation.
    bool may_be_steep;

    Vector3f random(const Vector3f& axis, Random& random) const {
        const auto aside = static_cast<float>(width_rad * (random.uniform() - 0.5));
        const auto up = static_cast<float>(width_rad * (random.uniform() - 0.5));
        const Vector3f left =
            may_be_steep ? Vector3f(axis.unitOrthogonal()) : Vector3f(-axis.y(), axis.x(), 0);
        return (axis + aside * left + up * axis.cross(left)).normalized();
    }
};

Revolution makeRevolution(const FiringPattern& pattern, const FiringRange& firings,
                          const DirectionsOfFiring& directions_of, const RevolutionPoses& poses,
                          const Footprint& footprint, Random& random) {
    Revolution turn;
    turn.lasers = pattern.lasers;
    turn.firings = firings;
    turn.beams.resize(static_cast<std::size_t>(turn.lasers) *
                      static_cast<std::size_t>(firings.end - firings.first));
    turn.rays.resize(turn.beams.size());
    std::vector<BeamDirection> directions(static_cast<std::size_t>(turn.lasers));
    for (int firing = firings.first; firing < firings.end; ++firing) {
        const SensorPose pose = poses.at(1e-6 * firing * pattern.firing_period_us);
        const Eigen::Matrix3f attitude = pose.attitude.toRotationMatrix().cast<float>();
        const Vector3f origin = pose.position_m.cast<float>();
        directions_of(firing, directions);
        for (int laser = 0; laser < turn.lasers; ++laser) {
            const std::size_t i = turn.index(firing, laser);
            Beam& beam = turn.beams[i];
            static_cast<BeamDirection&>(beam) = directions[static_cast<std::size_t>(laser)];
            beam.axis = attitude * beam.direction;
            const double time_s =
                1e-6 * (firing * pattern.firing_period_us + laser * pattern.laser_period_us);
            turn.rays[i] = {
                origin, footprint.random(beam.axis, random),
                static_cast<float>(std::min(1.0, time_s / pattern.revolutionPeriod_s()))};
        }
    }
    return turn;
}

/// Range at which the beam's axis intersects the plane that its ray hit; the ray's range if both
/// differ much.
float rangeAlongAxis(const RayHit& hit, const Vector3f& ray, const Vector3f& axis) {
    const float along = hit.normal.dot(axis);
    if (along > -0.01f) return hit.range_m;
    const float range_m = hit.range_m * hit.normal.dot(ray) / along;
    return std::abs(range_m - hit.range_m) < 0.1f * hit.range_m ? range_m : hit.range_m;
}

/// Casts a second ray for some beams. If it hits another surface at a similar range, the return
/// gets the nearer surface and a range between the two.
void mixEdges(const Scene::Snapshot& snapshot, const Revolution& turn, float max_range_m,
              const SensorErrorModel& faults, const Footprint& footprint, Random& random,
              std::vector<RayHit>& hits) {
    constexpr float kMinApart_m = 0.2f, kPulse_m = 1.2f;  // farther surfaces return separate pulses
    std::vector<std::size_t> chosen;
    std::vector<Ray> rays;
    const double gap = std::max(1e-9, faults.mixed);
    for (double at = random.exponential(1 / gap); at < static_cast<double>(hits.size());
         at += 1 + random.exponential(1 / gap)) {
        const auto i = static_cast<std::size_t>(at);
        if (hits[i].kind == ObjectClass::None) continue;
        chosen.push_back(i);
        rays.push_back(turn.rays[i]);
        rays.back().direction = footprint.random(turn.beams[i].axis, random);
        rays.back().reach_m = hits[i].range_m + 1.01f * kPulse_m;  // farther surfaces are not mixed
    }
    std::vector<RayHit> others;
    snapshot.cast(rays, max_range_m, others);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        RayHit& hit = hits[chosen[k]];
        const float apart_m = std::abs(others[k].range_m - hit.range_m);
        if (!(apart_m > kMinApart_m && apart_m < kPulse_m)) continue;
        if (isLargeSurface(hit.kind) && others[k].kind == hit.kind) continue;
        RayHit& nearer = others[k].range_m < hit.range_m ? others[k] : hit;
        hit = RayHit{nearer.range_m + static_cast<float>(random.uniform()) * apart_m, nearer.kind,
                     nearer.number, nearer.normal};
    }
}

struct Echo {
    float range_m = kNoValue;
    float intensity = 0;
    ObjectClass kind = ObjectClass::None;
    std::uint16_t object = 0;
};

class Receiver {
 public:
    Receiver(const Scene& scene, const SensorErrorModel& faults, const SensorModel& sensor,
             const Eigen::Quaterniond& mount, Random& random)
        : scene_(scene),
          faults_(faults),
          sensor_(sensor),
          is_tilted_(isTilted(mount)),
          vehicle_from_sensor_(mount.toRotationMatrix().cast<float>()),
          random_(random) {}

    Echo measure(const RayHit& hit, const Ray& ray, const Beam& beam) {
        const AirframeSpot* spot = faults_.airframe ? spotBefore(beam) : nullptr;
        if (spot && !(hit.kind == ObjectClass::Terrain && hit.range_m < spot->range_m)) {
            if (random_.chance(0.4)) return {};  // below the minimum range
            return {withNoise(spot->range_m, 1.0f), 0.1f, ObjectClass::Airframe, 0};
        }
        const bool is_hit = hit.kind != ObjectClass::None;
        if (random_.chance(kDust_m * faults_.dust_per_m)) {  // dust may be anywhere along the beam
            const auto speck_m = static_cast<float>(random_.uniform(0.5, kDust_m));
            if (!is_hit || speck_m < hit.range_m) return {speck_m, 0.02f, ObjectClass::Dust, 0};
        }
        if (!is_hit) return {};

        float range_m = hit.range_m;
        if (isLargeSurface(hit.kind)) range_m = rangeAlongAxis(hit, ray.direction, beam.axis);
        const float incidence = std::max(0.0f, -hit.normal.dot(ray.direction));
        if (hit.kind == ObjectClass::Terrain) range_m -= grass_m(ray, range_m, incidence);
        const float reflectivity = reflectivityOf(hit.kind, hit.number);
        // Rough surfaces return some light even at grazing incidence.
        const float strength = reflectivity / 0.3f * (0.05f + 0.95f * incidence);
        const auto half_m = static_cast<float>(faults_.half_range_m) * std::sqrt(strength);
        const float weakness = range_m / half_m;
        const float sixth = weakness * weakness * weakness * weakness * weakness * weakness;
        if (random_.chance(1.0 - (1.0 - faults_.lost) / (1.0 + static_cast<double>(sixth)))) {
            return {};
        }
        const float measured_m = withNoise(range_m, 1.0f + std::min(1.0f, 1.5f * weakness));
        if (!(measured_m > 0.1f && measured_m <= sensor_.max_range_m)) return {};
        const float shade = 0.9f + 0.2f * static_cast<float>(random_.uniform());
        return {measured_m, std::clamp(strength * 0.3f * shade, 0.01f, 1.0f), hit.kind, hit.number};
    }

 private:
    static constexpr double kDust_m = 15.0;  // dust beyond this range is too faint

    /// The part of the vehicle in front of a beam, for an arbitrary mount.
    const AirframeSpot* spotBefore(const Beam& beam) const {
        if (!is_tilted_) return airframeAt(beam.azimuth_rad, beam.elevation_rad);
        const Vector3f way = vehicle_from_sensor_ * beam.direction;
        return airframeAt(std::atan2(way.y(), way.x()),
                          std::asin(std::clamp(way.z(), -1.0f, 1.0f)));
    }

    float withNoise(float range_m, float times) {
        return range_m +
               static_cast<float>(faults_.min_noise_m * random_.approximateNormal()) * times;
    }

    /// Length of the beam between the grass and the soil behind it.
    float grass_m(const Ray& ray, float range_m, float incidence) {
        const Vector3f at = ray.origin_m + range_m * ray.direction;
        const double tallest_m = scene_.terrain().grassHeight_m(static_cast<double>(at.x()),
                                                                static_cast<double>(at.y()));
        if (tallest_m <= 0) return 0;
        const double share = random_.uniform();
        const double blade_m = tallest_m * share * share;  // few blades have the full height
        return std::min(static_cast<float>(blade_m) / std::max(incidence, 0.05f), 0.2f * range_m);
    }

    const Scene& scene_;
    const SensorErrorModel& faults_;
    const SensorModel& sensor_;
    bool is_tilted_;
    Eigen::Matrix3f vehicle_from_sensor_;
    Random& random_;
};

void reserve(std::size_t returns, SimulatedScan& out) {
    out.scan.reserve(returns);
    out.kind.reserve(returns);
    out.object.reserve(returns);
    out.firing.reserve(returns);
    out.laser.reserve(returns);
}

void append(const Echo& echo, const Beam& beam, int firing, int laser, float time_s,
            SimulatedScan& out) {
    const Vector3f at = echo.range_m * beam.direction;
    out.scan.x_m.push_back(at.x());
    out.scan.y_m.push_back(at.y());
    out.scan.z_m.push_back(at.z());
    out.scan.intensity.push_back(echo.intensity);
    out.scan.range_m.push_back(echo.range_m);
    out.scan.azimuth_rad.push_back(beam.azimuth_rad);
    out.scan.row.push_back(beam.row);
    out.scan.time_s.push_back(time_s);
    out.kind.push_back(echo.kind);
    out.object.push_back(echo.object);
    out.firing.push_back(firing);
    out.laser.push_back(static_cast<std::uint8_t>(laser));
}

}  // namespace

SimulatedScan simulateScan(const Scene& scene, const SensorModel& sensor, const PoseAt& pose_at,
                           double time_s, Random& random, const SensorErrorModel& faults,
                           const Eigen::Quaterniond& mount) {
    return simulateFirings(scene, sensor, pose_at, time_s,
                           {0, firingPattern(sensor).firings_per_revolution}, random, faults,
                           mount);
}

SimulatedScan simulateFirings(const Scene& scene, const SensorModel& sensor, const PoseAt& pose_at,
                              double time_s, const FiringRange& firings, Random& random,
                              const SensorErrorModel& faults, const Eigen::Quaterniond& mount) {
    const FiringPattern pattern = firingPattern(sensor);
    if (firings.first < 0 || firings.end <= firings.first ||
        firings.end > pattern.firings_per_revolution) {
        throw std::invalid_argument(
            "firings " + std::to_string(firings.first) + " to " + std::to_string(firings.end - 1) +
            " are outside the range 0 to " + std::to_string(pattern.firings_per_revolution - 1) +
            " of the " + sensor.name);
    }
    const Scene::Snapshot snapshot = scene.snapshotOver(time_s, pattern.revolutionPeriod_s());
    const PoseAt sensor_at = [&](double at_s) {
        const SensorPose vehicle = pose_at(at_s);
        return SensorPose{vehicle.position_m, vehicle.attitude * mount};
    };
    const RevolutionPoses poses(sensor_at, time_s, 1e-6 * pattern.firing_period_us * firings.end);
    const Footprint footprint{faults.footprint_rad, isTilted(mount) || !sensor.has_rings};
    const Revolution turn = makeRevolution(
        pattern, firings, directionsOfScan(sensor, pattern, time_s), poses, footprint, random);

    std::vector<RayHit> hits;
    snapshot.cast(turn.rays, sensor.max_range_m, hits);
    if (faults.mixed > 0) {
        mixEdges(snapshot, turn, sensor.max_range_m, faults, footprint, random, hits);
    }

    SimulatedScan out;
    reserve(turn.beams.size(), out);
    out.scan.beams = beamSpan(sensor);
    out.pose = sensor_at(time_s + 1e-6 * pattern.firing_period_us * firings.first);
    out.altitude_m = out.pose.position_m.z() -
                     scene.terrain().height_m(out.pose.position_m.x(), out.pose.position_m.y());
    Receiver receiver(scene, faults, sensor, mount, random);
    for (int firing = firings.first; firing < firings.end; ++firing) {
        for (int laser = 0; laser < turn.lasers; ++laser) {
            const std::size_t i = turn.index(firing, laser);
            const Echo echo = receiver.measure(hits[i], turn.rays[i], turn.beams[i]);
            if (echo.kind == ObjectClass::None) continue;
            const double since_s =
                1e-6 * (firing * pattern.firing_period_us + laser * pattern.laser_period_us);
            append(echo, turn.beams[i], firing, laser, static_cast<float>(since_s), out);
        }
    }
    return out;
}

SimulatedScan simulateScan(const Scene& scene, const SensorModel& sensor, const Flight& flight,
                           double time_s, Random& random, const SensorErrorModel& faults,
                           const Eigen::Quaterniond& mount) {
    const PoseAt pose_at = [&](double at_s) { return flight.at(at_s); };
    return simulateScan(scene, sensor, pose_at, time_s, random, faults, mount);
}

}  // namespace hagen::simulation
