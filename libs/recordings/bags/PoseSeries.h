#pragma once
#include <mrpt/poses/CPose3D.h>
#include <string>
#include <vector>
#include "recordings/bags/BagSurvey.h"

namespace hagen::recordings {

mrpt::poses::CPose3D poseOf(const RecordedPose& pose);

constexpr double kMinApart_ns = 1e7;  ///< of poses that are kept

/// Whether poses are close enough to place scans with them.
bool isDense(const PoseSeries& series);

/// Whether all poses are the same. Not of an empty series.
bool isStill(const PoseSeries& series);

/// The total time with poses, without gaps that are too long to interpolate.
double covered_s(const PoseSeries& series);

/// One of several series that move a frame one after the other, and where in its child frame the
/// series before it are.
struct MovingStep {
    mrpt::poses::CPose3D in_child;
    const PoseSeries* series;
};

/// The poses of the first step's child in `top`, where the last one's parent is at `in_top`, at the
/// times of any step that all of them cover.
PoseSeries composed(const std::vector<MovingStep>& steps, const std::string& top,
                    const mrpt::poses::CPose3D& in_top);

}  // namespace hagen::recordings
