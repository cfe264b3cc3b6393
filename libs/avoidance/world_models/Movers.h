#pragma once
#include <hagen/avoidance/WorldModel.h>
#include "avoidance/world_models/ObstacleTracks.h"

namespace hagen::avoidance {

/// Predicts moving obstacles: their last points move with the tracked velocity (ObstacleTracks),
/// and clearances are reduced by the uncertainty of that velocity.
class Movers {
 public:
    explicit Movers(float farthest_m);
    ~Movers();

    void update(const observations::MappedScan& scan, const std::shared_ptr<const View>& view);

    const ObstacleTracks& tracks() const { return tracks_; }
    /// The numbers of the moving tracks.
    const std::vector<std::uint32_t>& moving() const { return moving_; }
    /// The distance, at most `limit_m`, to the nearest mover at a time after the last scan.
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float after_s, float limit_m) const;
    float fastest_m_s() const { return fastest_m_s_; }
    std::size_t bytes() const;
    /// Adds the points of moving obstacles to `obstacles`.
    void addTo(WorldModel::Obstacles& obstacles) const;

 private:
    struct Mover;

    ObstacleTracks tracks_;
    std::vector<std::unique_ptr<Mover>> movers_;
    std::vector<std::uint32_t> moving_;
    float fastest_m_s_ = 0;
};

}  // namespace hagen::avoidance
