#include <algorithm>
#include <cmath>

#include "avoidance/world_models/Maps.h"
#include "avoidance/world_models/Nearest.h"
#include "avoidance/world_models/ObstacleTracks.h"
#include "avoidance/world_models/WindowModel.h"

namespace hagen::avoidance {
namespace {

// Velocity error as a fraction of the speed (turns are not predicted) and of its standard
// deviation.
constexpr float kDoubtOfSpeed = 0.2f, kDoubtOfSigma = 0.5f;

struct Mover {
    Mover(const ObstacleTrack& track, double time_s) : tree(3, points) {
        const Eigen::Vector2f level_m_s = track.velocity_m_s.cast<float>();
        const auto since_s = static_cast<float>(time_s - track.sights.front().time_s);
        velocity_m_s << level_m_s, 0;
        for (const Eigen::Vector3f& point_m : track.sights.front().points_m) {
            points.at_m.push_back(point_m + since_s * velocity_m_s);
            middle_m += points.at_m.back();
        }
        middle_m /= static_cast<float>(points.at_m.size());
        for (const Eigen::Vector3f& point_m : points.at_m) {
            radius_m = std::max(radius_m, (point_m - middle_m).norm());
        }
        doubt_m_s = kDoubtOfSpeed * level_m_s.norm() +
                    kDoubtOfSigma * static_cast<float>(track.velocitySigma_m_s());
        doubt_m = since_s * doubt_m_s;
        tree.buildIndex();
    }

    TreePoints points;  ///< positions at the time of the last scan
    PointTree tree;
    Eigen::Vector3f middle_m{0, 0, 0};
    float radius_m = 0;  ///< bounding sphere of the points
    Eigen::Vector3f velocity_m_s;
    float doubt_m, doubt_m_s;  ///< clearance uncertainty, initially and per second
};

/// Predicts moving obstacles: their last points move with the tracked velocity (ObstacleTracks),
/// and clearances are reduced by the uncertainty of that velocity.
class Movers {
 public:
    explicit Movers(float farthest_m) : tracks_(farthest_m) {}

    void update(const observations::MappedScan& scan, const std::shared_ptr<const View>& view) {
        tracks_.update(scan, view);
        movers_.clear();
        moving_.clear();
        fastest_m_s_ = 0;
        for (const ObstacleTrack& track : tracks_.tracks()) {
            if (!track.is_moving) continue;
            moving_.push_back(track.number);
            movers_.push_back(std::make_unique<Mover>(track, scan.time_s));
            const Mover& mover = *movers_.back();
            fastest_m_s_ =
                std::max(fastest_m_s_, mover.velocity_m_s.head<2>().norm() + mover.doubt_m_s);
        }
    }

    const ObstacleTracks& tracks() const { return tracks_; }
    /// The numbers of the moving tracks.
    const std::vector<std::uint32_t>& moving() const { return moving_; }
    /// The distance, at most `limit_m`, to the nearest mover at a time after the last scan.
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float after_s, float limit_m) const {
        float min_m = limit_m;
        for (const auto& mover : movers_) {
            const Eigen::Vector3f at_m = point_m - after_s * mover->velocity_m_s;
            const float doubt_m = mover->doubt_m + after_s * mover->doubt_m_s;
            if ((at_m - mover->middle_m).norm() - mover->radius_m - doubt_m >= min_m) continue;
            Nearest nearest(min_m + doubt_m);
            mover->tree.findNeighbors(nearest, at_m.data(), {});
            min_m = std::min(min_m, std::max(0.0f, std::sqrt(nearest.worstDist()) - doubt_m));
        }
        return min_m;
    }
    float fastest_m_s() const { return fastest_m_s_; }
    std::size_t bytes() const {
        std::size_t bytes = sizeof(*this) + tracks_.bytes();
        for (const auto& mover : movers_) {
            bytes += sizeof(Mover) + mover->points.at_m.capacity() * sizeof(Eigen::Vector3f) +
                     mover->tree.usedMemory(mover->tree);
        }
        return bytes;
    }
    /// Adds the points of moving obstacles to `obstacles`.
    void addTo(WorldModel::Obstacles& obstacles) const {
        for (const auto& mover : movers_) {
            const std::vector<Eigen::Vector3f>& points_m = mover->points.at_m;
            obstacles.centre_m.insert(obstacles.centre_m.end(), points_m.begin(), points_m.end());
        }
    }

 private:
    ObstacleTracks tracks_;
    std::vector<std::unique_ptr<Mover>> movers_;
    std::vector<std::uint32_t> moving_;
    float fastest_m_s_ = 0;
};

constexpr float kBefore_m = 0.2f;  // one cell

/// Removes obstacles but keeps the rays up to them, which clear earlier obstacles in between.
observations::MappedScan withoutObstacles(const observations::MappedScan& scan,
                                          const std::vector<bool>& is_left_out) {
    observations::MappedScan rest;
    rest.time_s = scan.time_s;
    rest.origin_m = scan.origin_m;
    for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
        const auto obstacle = static_cast<std::size_t>(scan.obstacles[i]);
        if (obstacle < is_left_out.size() && is_left_out[obstacle]) {
            const Eigen::Vector3f ray = scan.points_m[i] - rest.origin_m;
            const float range_m = ray.norm();
            if (range_m > kBefore_m) {
                rest.passed_to_m.push_back(rest.origin_m + ray * (1 - kBefore_m / range_m));
            }
            continue;
        }
        rest.points_m.push_back(scan.points_m[i]);
        rest.labels.push_back(scan.labels[i]);
        rest.obstacles.push_back(scan.obstacles[i]);
        if (!scan.age_s.empty()) rest.age_s.push_back(scan.age_s[i]);
    }
    return rest;
}

/// A model of static obstacles, combined with predicted moving obstacles (Movers).
class ModelWithMotion : public WorldModel {
 public:
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override {
        return movers_.clearanceWithin_m(point_m, 0, still_->clearanceWithin_m(point_m, limit_m));
    }
    float clearanceAfter_m(const Eigen::Vector3f& point_m, double after_s) const override {
        return movers_.clearanceWithin_m(point_m, static_cast<float>(after_s),
                                         still_->clearance_m(point_m));
    }
    float fastest_m_s() const override { return movers_.fastest_m_s(); }
    bool isKnown(const Eigen::Vector3f& point_m) const override { return still_->isKnown(point_m); }
    std::size_t bytes() const override { return still_->bytes() + movers_.bytes(); }
    /// Includes the points of movers, drawn as voxels if the model has voxels.
    Obstacles obstacles() const override {
        Obstacles obstacles = still_->obstacles();
        movers_.addTo(obstacles);
        return obstacles;
    }

 protected:
    ModelWithMotion(std::unique_ptr<WorldModel> still, float farthest_m)
        : still_(std::move(still)), movers_(farthest_m) {}

    std::unique_ptr<WorldModel> still_;
    Movers movers_;
};

/// A window without the points of moving obstacles while these are tracked. When a track ends, its
/// points are restored, because the position of the obstacle is unknown.
class WindowWithMotion : public ModelWithMotion {
 public:
    WindowWithMotion(bool roi_only, WindowSize size)
        : ModelWithMotion(std::make_unique<WindowModel>(roi_only, size), size.radius_m) {}

    void update(const observations::MappedScan& scan) override {
        const auto view = std::make_shared<const View>(viewOf(scan));
        movers_.update(scan, view);
        auto& window = static_cast<WindowModel&>(*still_);
        window.update(scan, view, movers_.tracks().trackOfObstacle());
        window.hide(movers_.moving());
    }
};

/// A map without the returns of moving obstacles, except for the rays up to them. Cells entered
/// before an obstacle was known to move stay until rays clear them.
class MapWithMotion : public ModelWithMotion {
 public:
    MapWithMotion(std::unique_ptr<WorldModel> map, float farthest_m)
        : ModelWithMotion(std::move(map), farthest_m) {}

    void update(const observations::MappedScan& scan) override {
        movers_.update(scan, std::make_shared<const View>(viewOf(scan)));
        const std::vector<std::uint32_t>&moving = movers_.moving(),
              &track_of = movers_.tracks().trackOfObstacle();
        if (moving.empty() || scan.obstacles.empty()) return still_->update(scan);
        std::vector<bool> is_moving(track_of.size());
        for (std::size_t obstacle = 1; obstacle < track_of.size(); ++obstacle) {
            is_moving[obstacle] =
                std::find(moving.begin(), moving.end(), track_of[obstacle]) != moving.end();
        }
        still_->update(withoutObstacles(scan, is_moving));
    }
};

}  // namespace

std::unique_ptr<WorldModel> makeWindowWithMotion(bool roi_only, WindowSize size) {
    return std::make_unique<WindowWithMotion>(roi_only, size);
}

std::unique_ptr<WorldModel> makeMapWithMotion(std::unique_ptr<WorldModel> map, float farthest_m) {
    return std::make_unique<MapWithMotion>(std::move(map), farthest_m);
}

}  // namespace hagen::avoidance
