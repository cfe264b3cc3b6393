#pragma once
#include <hagen/mapping/MappedScan.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// What a vehicle knows of what is around it. A planner asks nothing else, so that models can be
/// compared under one planner. Points are in the map, as the vehicle believes it to be.
class WorldModel {
 public:
    /// Clearances are told up to here: what is farther off is no nearer than this.
    static constexpr float kReach_m = 3.0f;

    virtual ~WorldModel() = default;

    /// Takes in the next scan.
    virtual void update(const mapping::MappedScan& scan) = 0;

    /// From a point to the nearest obstacle known, at most kReach_m; 0 within one. What is unknown
    /// counts as free.
    virtual float clearance_m(const Eigen::Vector3f& point_m) const = 0;

    /// The same, at most `most_m`: a model may answer sooner where no more matters.
    virtual float clearanceWithin_m(const Eigen::Vector3f& point_m, float most_m) const {
        return std::min(clearance_m(point_m), most_m);
    }

    /// Whether a point was seen, free or not.
    virtual bool isKnown(const Eigen::Vector3f& point_m) const = 0;

    /// What the model holds, by the sizes of what it is made of.
    virtual std::size_t bytes() const = 0;

    /// Obstacles for a picture: their middles, and the edge of each (0: points).
    struct Obstacles {
        std::vector<Eigen::Vector3f> middle_m;
        float edge_m = 0;
    };
    virtual Obstacles obstacles() const = 0;
};

/// What a world model is told before the flight.
struct WorldModelSetting {
    Eigen::AlignedBox3f bounds_m;  ///< where the flight can lead; maps end 3 m beyond
    /// The true distance to the nearest obstacle at the time of the last scan, for the oracle.
    std::function<float(const Eigen::Vector3f&)> true_clearance_m;
};

/// Names of all world models:
///
///     W-RoI           sliding window of RoI points: 10 scans, within 15 m, one point a 10 cm cube
///     W-Full          the same of all points
///     O-Full-0.2      OctoMap of all points at 0.2 m; O-Full-0.4
///     O-RoI-0.2       of RoI points alone; O-RoI-0.4
///     O-RoI+rays-0.2  RoI points are hits, rays of all points clear; O-RoI+rays-0.4
///     G-Full          MRPT's COccupancyGridMap3D of all points at 0.2 m
///     oracle          the true scene
const std::vector<std::string>& worldModelNames();

/// Whether a model needs the filter's labels (its cost counts then).
bool needsLabels(const std::string& model);

/// Throws std::invalid_argument, naming the known ones, for any other name.
std::unique_ptr<WorldModel> makeWorldModel(const std::string& name,
                                           const WorldModelSetting& setting);

}  // namespace hagen::avoidance
