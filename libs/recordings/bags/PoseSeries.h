#pragma once
#include <mrpt/poses/CPose3D.h>
#include <string>
#include <vector>
#include "recordings/bags/BagSurvey.h"

namespace hagen::recordings {

mrpt::poses::CPose3D poseOf(const RecordedPose& pose);

constexpr double kMinApart_ns = 1e7;  ///< minimum time between stored poses

/// True if poses are close enough in time to locate scans.
bool isDense(const PoseSeries& series);

/// True if all poses are equal. The series must not be empty.
bool isStill(const PoseSeries& series);

/// The total time covered by poses, excluding gaps that are too long for interpolation.
double covered_s(const PoseSeries& series);

/// A moving transform of a path, and the pose of the previous step's parent in its child frame.
struct MovingStep {
    mrpt::poses::CPose3D in_child;
    const PoseSeries* series;
};

/// Composes the poses of the first step's child in `top`. `in_top`: pose of the last step's parent
/// in `top`. Uses the times of all steps at which every step has a pose.
PoseSeries composed(const std::vector<MovingStep>& steps, const std::string& top,
                    const mrpt::poses::CPose3D& in_top);

}  // namespace hagen::recordings
