#include "avoidance/world_models/ObstacleTracks.h"
#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/Geometry>

#include "avoidance/world_models/Thinning.h"

namespace hagen::avoidance {
namespace {

// Limits of tracked obstacles.
constexpr float kMaxWidth_m = 6;
constexpr std::size_t kMinPoints = 3;
constexpr float kThinning_m = 0.1f;

// The Kalman filter.
constexpr double kAcceleration_m_s2 = 1;  // standard deviation
constexpr double kPlaceSigma_m = 0.05;    // of a centre, plus a fraction of the width
constexpr double kPlaceSigmaOfWidth = 0.05;
constexpr double kFirstSpeedSigma_m_s = 2;

// Matching.
constexpr double kGate_m = 0.6, kGateOfWidth = 0.25;
constexpr float kWidthChange_m = 1.4f, kWidthRatio = 1.4f;
constexpr int kMaxMissed = 10;

// Thresholds of moving obstacles.
constexpr int kMinSeen = 3;
constexpr double kMinTracked_m_s = 0.5, kSigmas = 3, kRemembered_s = 0.6;
constexpr std::size_t kCompared = 50;  // points compared per sighting
constexpr float kFarFit_m = 0.5f;      // upper limit of distances
constexpr double kBetterFit = 0.8;
constexpr float kMinHeight_m = 0.15f;
constexpr double kCrossedShare = 0.1;
constexpr int kMinCrossed = 2;

/// An obstacle in one scan.
struct Seen {
    std::int32_t obstacle;
    ObstacleTrack::Sight sight;
    Eigen::Vector2d middle_m;
    float width_m;
};

float widthOf(const std::vector<Eigen::Vector3f>& points_m) {
    Eigen::AlignedBox2f box;
    for (const Eigen::Vector3f& point : points_m) box.extend(Eigen::Vector2f(point.head<2>()));
    return box.sizes().maxCoeff();
}

Eigen::Vector2d middleOf(const std::vector<Eigen::Vector3f>& points_m) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Eigen::Vector3f& point : points_m) sum += point.head<2>().cast<double>();
    return sum / static_cast<double>(points_m.size());
}

/// The trackable obstacles of a scan, by number.
std::vector<Seen> seenIn(const observations::MappedScan& scan, float farthest_m) {
    struct Points {
        std::vector<Eigen::Vector3f> at_m;
        double age_s = 0;
        bool is_far = false;
    };
    std::vector<Points> by_obstacle;
    for (std::size_t i = 0; i < scan.obstacles.size(); ++i) {
        const auto obstacle = static_cast<std::size_t>(scan.obstacles[i]);
        if (obstacle == 0) continue;
        if (by_obstacle.size() <= obstacle) by_obstacle.resize(obstacle + 1);
        by_obstacle[obstacle].at_m.push_back(scan.points_m[i]);
        by_obstacle[obstacle].is_far |=
            (scan.points_m[i] - scan.origin_m).squaredNorm() > farthest_m * farthest_m;
        if (!scan.age_s.empty()) {
            by_obstacle[obstacle].age_s += static_cast<double>(scan.age_s[i]);
        }
    }
    std::vector<Seen> all;
    for (std::size_t obstacle = 1; obstacle < by_obstacle.size(); ++obstacle) {
        const Points& points = by_obstacle[obstacle];
        if (points.at_m.size() < kMinPoints || points.is_far) continue;
        const float width_m = widthOf(points.at_m);
        if (width_m > kMaxWidth_m) continue;
        const double age_s = points.age_s / static_cast<double>(points.at_m.size());
        Seen seen{static_cast<std::int32_t>(obstacle),
                  {scan.time_s - age_s, thinned(points.at_m, scan.origin_m, kThinning_m)},
                  {0, 0},
                  width_m};
        seen.middle_m = middleOf(seen.sight.points_m);
        all.push_back(std::move(seen));
    }
    return all;
}

// The Kalman filter.

double placeVariance(const Seen& seen) {
    const double sigma_m = kPlaceSigma_m + kPlaceSigmaOfWidth * static_cast<double>(seen.width_m);
    return sigma_m * sigma_m;
}

ObstacleTrack trackFrom(Seen& seen, std::uint32_t number) {
    ObstacleTrack track;
    track.number = number;
    track.at_m = seen.middle_m;
    track.covariance << placeVariance(seen), 0, 0, kFirstSpeedSigma_m_s * kFirstSpeedSigma_m_s;
    track.time_s = seen.sight.time_s;
    track.sights.push_front(std::move(seen.sight));
    return track;
}

void predict(double time_s, ObstacleTrack& track) {
    const double dt = time_s - track.time_s;
    Eigen::Matrix2d motion, noise;
    motion << 1, dt, 0, 1;
    noise << dt * dt * dt * dt / 4, dt * dt * dt / 2, dt * dt * dt / 2, dt * dt;
    track.at_m += dt * track.velocity_m_s;
    track.covariance = motion * track.covariance * motion.transpose() +
                       kAcceleration_m_s2 * kAcceleration_m_s2 * noise;
    track.time_s = time_s;
}

void correct(const Seen& seen, ObstacleTrack& track) {
    const Eigen::Vector2d gain =
        track.covariance.col(0) / (track.covariance(0, 0) + placeVariance(seen));
    const Eigen::Vector2d surprise_m = seen.middle_m - track.at_m;
    track.at_m += gain(0) * surprise_m;
    track.velocity_m_s += gain(1) * surprise_m;
    track.covariance -= (gain * track.covariance.row(0)).eval();
}

// Matching.

struct Match {
    double distance_m;
    std::size_t track, seen;
    bool operator<(const Match& other) const {
        return std::tie(distance_m, track, seen) <
               std::tie(other.distance_m, other.track, other.seen);
    }
};

/// The visible part of a car is half as long from the front as from the side.
bool isOfSimilarWidth(float a_m, float b_m) {
    return std::max(a_m, b_m) < kWidthRatio * std::min(a_m, b_m) + kWidthChange_m;
}

std::vector<Match> possibleMatches(const std::vector<ObstacleTrack>& tracks,
                                   const std::vector<Seen>& all) {
    std::vector<Match> matches;
    for (std::size_t t = 0; t < tracks.size(); ++t) {
        const float width_m = widthOf(tracks[t].sights.front().points_m);
        for (std::size_t s = 0; s < all.size(); ++s) {
            const double ahead_s = all[s].sight.time_s - tracks[t].time_s;
            const double distance_m =
                (tracks[t].at_m + ahead_s * tracks[t].velocity_m_s - all[s].middle_m).norm();
            const double gate_m = kGate_m + kGateOfWidth * static_cast<double>(width_m);
            if (distance_m < gate_m && isOfSimilarWidth(width_m, all[s].width_m)) {
                matches.push_back({distance_m, t, s});
            }
        }
    }
    std::sort(matches.begin(), matches.end());
    return matches;
}

// Motion detection.

/// At most kCompared of the points, evenly spread.
std::vector<Eigen::Vector3f> sampleOf(const std::vector<Eigen::Vector3f>& points_m) {
    const std::size_t step = (points_m.size() + kCompared - 1) / kCompared;
    std::vector<Eigen::Vector3f> sample;
    for (std::size_t i = 0; i < points_m.size(); i += std::max<std::size_t>(step, 1)) {
        sample.push_back(points_m[i]);
    }
    return sample;
}

/// The mean distance from each point to the nearest of the others, which are moved first.
double misfit_m(const std::vector<Eigen::Vector3f>& points_m,
                const std::vector<Eigen::Vector3f>& others_m, const Eigen::Vector3f& by_m) {
    double sum_m = 0;
    for (const Eigen::Vector3f& point : points_m) {
        float min_m2 = kFarFit_m * kFarFit_m;
        for (const Eigen::Vector3f& other : others_m) {
            min_m2 = std::min(min_m2, (other + by_m - point).squaredNorm());
        }
        sum_m += std::sqrt(static_cast<double>(min_m2));
    }
    return sum_m / static_cast<double>(points_m.size());
}

/// Whether the older points fit better after motion.
bool fitsBetterMoved(const ObstacleTrack& track) {
    const ObstacleTrack::Sight &now = track.sights.front(), &before = track.sights.back();
    const double passed_s = now.time_s - before.time_s;
    const Eigen::Vector2f shift_m = (passed_s * track.velocity_m_s).cast<float>();
    const Eigen::Vector3f by_m(shift_m.x(), shift_m.y(), 0), none(0, 0, 0);
    const auto points_m = sampleOf(now.points_m), older_m = sampleOf(before.points_m);
    const double still_m = misfit_m(points_m, older_m, none) + misfit_m(older_m, points_m, none);
    const double moved_m = misfit_m(points_m, older_m, by_m) + misfit_m(older_m, points_m, -by_m);
    return moved_m < kBetterFit * still_m;
}

float heightOf(const std::vector<Eigen::Vector3f>& points_m) {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& point : points_m) box.extend(point);
    return box.sizes().z();
}

/// Whether a scan saw free space at a tenth of these points.
bool sawFreeSpaceAt(const View& view, const std::vector<Eigen::Vector3f>& points_m) {
    int known = 0, free = 0;
    for (const Eigen::Vector3f& point_m : points_m) {
        const SeenDirections::Place place = view.seen.placeAt(point_m - view.origin_m);
        known += place != SeenDirections::Place::Unknown;
        free += place == SeenDirections::Place::Free;
    }
    return free >= kMinCrossed && free >= kCrossedShare * known;
}

using Views = std::deque<std::shared_ptr<const View>>;

const View& viewAt(double time_s, const Views& views) {
    return **std::min_element(views.begin(), views.end(), [&](const auto& a, const auto& b) {
        return std::abs(a->time_s - time_s) < std::abs(b->time_s - time_s);
    });
}

bool crossesFreeSpace(const ObstacleTrack& track, const Views& views) {
    const ObstacleTrack::Sight &now = track.sights.front(), &before = track.sights.back();
    const bool was_free = sawFreeSpaceAt(viewAt(before.time_s, views), sampleOf(now.points_m));
    const bool is_free = sawFreeSpaceAt(*views.front(), sampleOf(before.points_m));
    const bool is_flat = std::min(heightOf(now.points_m), heightOf(before.points_m)) < kMinHeight_m;
    return is_flat ? was_free && is_free : was_free || is_free;
}

bool isFastEnough(const ObstacleTrack& track) {
    const double speed_m_s = track.velocity_m_s.norm();
    return track.seen_scans >= kMinSeen && speed_m_s > kMinTracked_m_s &&
           speed_m_s > kSigmas * track.velocitySigma_m_s();
}

}  // namespace

double ObstacleTrack::velocitySigma_m_s() const { return std::sqrt(covariance(1, 1)); }

void ObstacleTracks::update(const observations::MappedScan& scan) {
    update(scan, std::make_shared<const View>(viewOf(scan)));
}

void ObstacleTracks::update(const observations::MappedScan& scan,
                            std::shared_ptr<const View> view) {
    views_.push_front(std::move(view));
    while (views_.front()->time_s - views_.back()->time_s > kRemembered_s) views_.pop_back();
    std::vector<Seen> all = seenIn(scan, farthest_m_);
    std::int32_t max = 0;
    for (const Seen& seen : all) max = std::max(max, seen.obstacle);
    track_of_obstacle_.assign(static_cast<std::size_t>(max) + 1, 0);

    std::vector<bool> is_track_taken(tracks_.size()), is_seen_taken(all.size());
    for (const Match& match : possibleMatches(tracks_, all)) {
        if (is_track_taken[match.track] || is_seen_taken[match.seen]) continue;
        is_track_taken[match.track] = is_seen_taken[match.seen] = true;
        ObstacleTrack& track = tracks_[match.track];
        Seen& seen = all[match.seen];
        predict(seen.sight.time_s, track);
        correct(seen, track);
        ++track.seen_scans;
        track.missed_scans = 0;
        track_of_obstacle_[static_cast<std::size_t>(seen.obstacle)] = track.number;
        track.sights.push_front(std::move(seen.sight));
        while (track.time_s - track.sights.back().time_s > kRemembered_s) track.sights.pop_back();
        track.is_moving =
            isFastEnough(track) && (track.crossed_free_space || fitsBetterMoved(track));
        if (!track.is_moving || track.crossed_free_space) continue;
        track.crossed_free_space = track.is_moving = crossesFreeSpace(track, views_);
    }
    for (std::size_t t = 0; t < is_track_taken.size(); ++t) {
        tracks_[t].missed_scans += !is_track_taken[t];
    }
    tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(),
                                 [](const auto& track) { return track.missed_scans > kMaxMissed; }),
                  tracks_.end());
    for (std::size_t s = 0; s < all.size(); ++s) {
        if (is_seen_taken[s]) continue;
        track_of_obstacle_[static_cast<std::size_t>(all[s].obstacle)] = ++tracks_begun_;
        tracks_.push_back(trackFrom(all[s], tracks_begun_));
    }
}

std::size_t ObstacleTracks::bytes() const {
    std::size_t bytes = sizeof(*this) + track_of_obstacle_.capacity() * sizeof(std::uint32_t);
    for (const ObstacleTrack& track : tracks_) {
        bytes += sizeof(track);
        for (const auto& sight : track.sights) {
            bytes += sizeof(sight) + sight.points_m.capacity() * sizeof(Eigen::Vector3f);
        }
    }
    return bytes;
}

}  // namespace hagen::avoidance
