#pragma once
#include <hagen/observations/ObservationSegmenter.h>
#include <mrpt/obs/CObservation3DScene.h>

namespace hagen::observations {

/// A segmented scan as a scene that a stock RawLogViewer shows in its true colours: RoI vermilion,
/// ROU pale blue, returns out of the sensor's range left out; the vehicle's frame with a corner of
/// axes at the sensor, a circle of radius `zone_m` about it, and boxes around obstacles of 30
/// returns or more (those of the whole window). Label `<label>_preview` (which MRPT 2.5 does not
/// write), the scan's time and sensor pose.
mrpt::obs::CObservation3DScene::Ptr previewOf(const mrpt::obs::CObservation& observation,
                                              const ObservationSegmenter::Output& segmented,
                                              float zone_m);

}  // namespace hagen::observations
