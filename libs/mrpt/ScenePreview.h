#pragma once
#include <hagen/mrpt/ObservationSegmenter.h>
#include <mrpt/obs/CObservation3DScene.h>

namespace hagen::observations {

/// Returns a segmented scan as a scene for RawLogViewer, with the scan's time and sensor pose, and
/// the label `<label>_preview` (which MRPT 2.5 does not write). Its only object, kPreviewName
/// (Results.h), contains returns in colour (RoI vermilion, ROU pale blue), coordinate axes at the
/// sensor, a circle of radius `zone_m`, and boxes around obstacles (boxesToDraw()). MRPT 2 and 3
/// read all its classes.
mrpt::obs::CObservation3DScene::Ptr previewOf(const mrpt::obs::CObservation& observation,
                                              const ObservationSegmenter::Output& segmented,
                                              float zone_m);

}  // namespace hagen::observations
