#pragma once
#include <mrpt/img/TColor.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <string>
#include <string_view>

namespace hagen::observations {

/// Colours of the results: colour-blind safe and distinct from a viewer's grey.
const mrpt::img::TColor kRoiColor(213, 94, 0), kNonRoiColor(150, 190, 230);

constexpr const char* kRoiSuffix = "_roi";
constexpr const char* kNonRoiSuffix = "_non_roi";
/// Name of the object in a preview's scene. A part of the object is named after the scan, because
/// rawlogs do not store scene labels.
constexpr const char* kPreviewName = "hagen preview";
constexpr std::string_view kPreviewOfPrefix = "zone of ";

/// A cloud as a result of the filter, with the scan's time, pose and suffixed label. The colour in
/// its renderOptions, which rawlogs store, marks the cloud as a result.
mrpt::obs::CObservationPointCloud::Ptr resultOf(const mrpt::obs::CObservation& scan, bool is_roi,
                                                const mrpt::maps::CPointsMap::Ptr& points);

/// Whether the observation is a result of the filter: a cloud with suffix and mark, or a preview.
/// The suffix alone is not sufficient, because a scan may be labelled "front_roi".
bool isResult(const mrpt::obs::CObservation& observation);

/// The label of the scan that a result comes from.
std::string scanLabelOf(const mrpt::obs::CObservation& result);

}  // namespace hagen::observations
