#pragma once
#include <mrpt/poses/CPose3D.h>
#include <string>
#include <vector>
#include "recordings/bags/BagSurvey.h"

namespace hagen::recordings {

mrpt::poses::CPose3D poseOf(const RecordedPose& pose);

constexpr double kMinApart_ns = 1e7;  ///< between stored poses

/// True if poses are close enough in time to locate scans.
bool isDense(const PoseSeries& series);

/// True if all poses are equal. The series must not be empty.
bool isStill(const PoseSeries& series);

/// The total time with poses, excluding gaps that are too long for interpolation.
double covered_s(const PoseSeries& series);

/// One of several consecutive moving transforms, and the pose of the previous series in its child
/// frame.
struct MovingStep {
    mrpt::poses::CPose3D in_child;
    const PoseSeries* series;
};

/// The poses of the first step's child in `top`, where `in_top` is the pose of the last step's
/// parent. Uses the times of any step that all steps cover.
PoseSeries composed(const std::vector<MovingStep>& steps, const std::string& top,
                    const mrpt::poses::CPose3D& in_top);

}  // namespace hagen::recordings
