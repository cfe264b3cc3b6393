#pragma once
#include <hagen/scan/Scan.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

namespace hagen::observations {

/// The observation if it comes from a depth camera and has points or a range image, otherwise null.
const mrpt::obs::CObservation3DRangeScan* depthScanOf(const mrpt::obs::CObservation& observation);

/// Reads the returns of a depth camera in its frame (x forward, y left, z up), if necessary from
/// files next to the log. Uses the points if available, otherwise the undistorted range image, row
/// by row, with a pixel's further ranges (`rangeImageOtherLayers`) after the first. Skips points at
/// the origin and pixels without a range. Intensities are 0; range, azimuth and row are not set.
///
/// Throws std::runtime_error if a file is missing, arrays differ in size, or camera parameters are
/// invalid or not supported.
void readDepthScan(const mrpt::obs::CObservation3DRangeScan& observation, Scan& scan);

}  // namespace hagen::observations
