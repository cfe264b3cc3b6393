#pragma once
#include <hagen/mrpt/ObservationSegmenter.h>
#include <mrpt/obs/CObservation3DScene.h>

namespace hagen::observations {

/// Returns a segmented scan as a scene that a stock RawLogViewer shows in true colours: RoI
/// vermilion, ROU pale blue, what has no range omitted. It contains the
/// vehicle's frame with coordinate axes at the sensor, a circle of radius `zone_m` around it, and
/// boxes around obstacles of 30 returns or more that are not inside another one. Label
/// `<label>_preview` (which MRPT 2.5 does not write), with the scan's time and sensor pose. The
/// object is called kPreviewName (Results.h), which tells it from other scenes. MRPT 3 reads all
/// its classes.
mrpt::obs::CObservation3DScene::Ptr previewOf(const mrpt::obs::CObservation& observation,
                                              const ObservationSegmenter::Output& segmented,
                                              float zone_m);

}  // namespace hagen::observations
