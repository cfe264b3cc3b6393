#pragma once
#include <hagen/avoidance/ObstacleTracks.h>
#include <hagen/avoidance/WorldModel.h>

namespace hagen::avoidance {

/// The obstacles that move, where they will be: the points of the last scan that saw one, moved
/// along at its velocity (ObstacleTracks), less the doubt in it.
class Movers {
 public:
    explicit Movers(float farthest_m) : tracks_(farthest_m) {}

    void update(const mapping::MappedScan& scan, const std::shared_ptr<const View>& view);

    const ObstacleTracks& tracks() const { return tracks_; }
    /// The numbers of the tracks that move.
    const std::vector<std::uint32_t>& moving() const { return moving_; }
    /// The distance from a point to the nearest of them a time after the last scan, at most
    /// `limit_m`.
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float after_s, float limit_m) const;
    float fastest_m_s() const { return fastest_m_s_; }
    std::size_t bytes() const;
    /// Their points, added to those of `obstacles`.
    void addTo(WorldModel::Obstacles& obstacles) const;

 private:
    struct Mover {
        std::vector<Eigen::Vector3f> points_m;  ///< at the time of the last scan
        Eigen::Vector3f middle_m;
        float radius_m;  ///< of a sphere around the points
        Eigen::Vector3f velocity_m_s;
        float doubt_m, doubt_m_s;  ///< clearance that is not certain, at once and per second
    };
    static Mover moverFrom(const ObstacleTrack& track, double time_s);

    ObstacleTracks tracks_;
    std::vector<Mover> movers_;
    std::vector<std::uint32_t> moving_;
    float fastest_m_s_ = 0;
};

}  // namespace hagen::avoidance
