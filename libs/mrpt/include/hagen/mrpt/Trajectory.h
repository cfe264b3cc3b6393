#pragma once
#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DInterpolator.h>

#include <cstddef>
#include <optional>

namespace hagen::observations {

bool isFinite(const mrpt::poses::CPose3D& pose);

/// The vehicle's trajectory: its poses in the map over time.
class Trajectory {
 public:
    Trajectory();

    /// Adds a pose. Ignores poses without a valid time (isTime()); ignores and counts poses that
    /// are not finite.
    void add(mrpt::Clock::time_point time, const mrpt::poses::CPose3D& vehicle_pose);

    /// Returns the pose at a time, interpolated between its neighbours; nullopt unless the
    /// neighbours are at most 0.2 s apart or a pose has exactly this time.
    std::optional<mrpt::poses::CPose3D> at(mrpt::Clock::time_point time) const;

    /// Whether the map is gravity-aligned, so that a pose provides the vehicle's attitude. False if
    /// poses are integrated from odometry or relative to the first pose.
    bool has_horizon = true;
    std::size_t not_finite = 0;  ///< number of ignored poses

    std::size_t size() const { return poses_.size(); }

 private:
    mrpt::poses::CPose3DInterpolator poses_;
};

}  // namespace hagen::observations
