#pragma once
#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DInterpolator.h>

#include <cstddef>
#include <optional>

namespace hagen::observations {

/// Where the vehicle was: its poses in the map over time.
class Trajectory {
 public:
    Trajectory();

    void add(mrpt::Clock::time_point time, const mrpt::poses::CPose3D& vehicle_pose);

    /// The pose at a time, interpolated between the two poses around it; none where there are not
    /// two such within 0.2 s of one another, nor one of that very time.
    std::optional<mrpt::poses::CPose3D> at(mrpt::Clock::time_point time) const;

    /// Whether the map's z axis points against gravity, so that a pose tells how the vehicle is
    /// tilted. It does not where poses are summed from movements, or seen from the first one.
    bool has_horizon = true;

    /// Poses it was given, one a time.
    std::size_t size() const { return poses_.size(); }

 private:
    mrpt::poses::CPose3DInterpolator poses_;
};

}  // namespace hagen::observations
