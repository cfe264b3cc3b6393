#pragma once
#include <hagen/scan/Scan.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

namespace hagen::observations {

/// The observation, if it is one of a depth camera that has points or a range image, in the log or
/// in files beside it; otherwise null.
const mrpt::obs::CObservation3DRangeScan* depthScanOf(const mrpt::obs::CObservation& observation);

/// Reads the coordinates of a depth camera's returns, in its frame (x forward, y left, z up):
/// its points if it has some, in their order; otherwise its range image, row by row, with the
/// further ranges of a pixel (`rangeImageOtherLayers`) after the first one. Lens distortion is
/// removed. Points at the origin, which MRPT takes for none, and pixels without a range are no
/// returns. Files beside the log are read. Intensities are 0; range, azimuth and row are not set.
///
/// Throws std::runtime_error that says why if a file is missing, arrays differ in size, or the
/// camera's parameters cannot be used.
void readDepthScan(const mrpt::obs::CObservation3DRangeScan& observation, Scan& scan);

}  // namespace hagen::observations
