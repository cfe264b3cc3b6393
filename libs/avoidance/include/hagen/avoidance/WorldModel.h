#pragma once
#include <hagen/avoidance/FlightConditions.h>
#include <hagen/avoidance/WindowSize.h>
#include <hagen/mrpt/MappedScan.h>
#include <hagen/mrpt/ScanMap.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// The known obstacles around a vehicle. A planner queries only this class, so that models can be
/// compared under one planner. Points are in the map frame, as estimated by the vehicle.
class WorldModel {
 public:
    /// Clearances are limited to this value.
    static constexpr float kReach_m = 3.0f;

    virtual ~WorldModel() = default;

    /// Updates the model with the next scan.
    virtual void update(const observations::MappedScan& scan) = 0;

    /// Distance from a point to the nearest known obstacle, at most kReach_m; 0 inside one. Unknown
    /// space is treated as free.
    virtual float clearance_m(const Eigen::Vector3f& point_m) const {
        return clearanceWithin_m(point_m, kReach_m);
    }
    /// Like clearance_m(), but at most `limit_m`, which may be faster to compute. A model overrides
    /// at least one of the two.
    virtual float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const {
        return std::min(clearance_m(point_m), limit_m);
    }

    /// clearance_m() at a time after the last scan, for models that predict motion. All other
    /// models assume a static world.
    virtual float clearanceAfter_m(const Eigen::Vector3f& point_m, double /*after_s*/) const {
        return clearance_m(point_m);
    }
    /// Maximum change of a point's clearance per second [m/s]; 0 if nothing moves.
    virtual float fastest_m_s() const { return 0; }

    /// Whether a point was observed, as free or occupied.
    virtual bool isKnown(const Eigen::Vector3f& point_m) const = 0;

    /// Memory of the model's data, computed from container sizes.
    virtual std::size_t bytes() const = 0;

    /// Obstacles for visualization: their centres, and the edge length of a voxel (0: points).
    struct Obstacles {
        std::vector<Eigen::Vector3f> centre_m;
        float edge_m = 0;
    };
    virtual Obstacles obstacles() const = 0;
};

/// Parameters of a world model known before the flight.
struct WorldModelSetting {
    Eigen::AlignedBox3f bounds_m;  ///< bounds of the flight; maps extend 3 m beyond
    /// The true distance to the nearest obstacle at a time after the last scan. Only for oracles.
    std::function<float(const Eigen::Vector3f& point_m, double after_s)> true_clearance_m;
    FlightPace pace;  ///< determines window sizes
    ModelDistance distance = ModelDistance::Unbiased;
};

/// Names of all world models, such as "W-RoI", for flags, files and hashes; people read
/// displayName(), such as "RoI window". docs/octomap-compare.md describes each.
const std::vector<std::string>& worldModelNames();

/// The display name of a model, such as "RoI window" for W-RoI. Names that are not in
/// worldModelNames(), such as those of other versions, are returned unchanged.
std::string displayName(const std::string& model);

/// The entry of worldModelNames() for user input: either that name, or displayName() in upper or
/// lower case. Any other text is returned unchanged, for the caller to reject.
std::string worldModelFrom(const std::string& text);

/// All names for error messages: "W-RoI (RoI window), W-Full (full window), ...".
std::string worldModelList();

/// Whether a model needs the filter's labels; if so, its latency includes the filter. Throws
/// std::invalid_argument for unknown names.
bool needsLabels(const std::string& model);

/// Whether a model needs the true scene, as oracles do. False for unknown names.
bool needsTruth(const std::string& model);

/// Whether a model predicts motion (clearanceAfter_m()). False for unknown names.
bool predictsMotion(const std::string& model);

/// Throws std::invalid_argument for unknown names, listing known names, and for an oracle
/// without true clearances.
std::unique_ptr<WorldModel> makeWorldModel(const std::string& name,
                                           const WorldModelSetting& setting);

/// An OctoMap with custom settings, to measure their effect.
std::unique_ptr<WorldModel> makeOctoMap(const observations::ScanMapOptions& options,
                                        const Eigen::AlignedBox3f& bounds_m);

}  // namespace hagen::avoidance
