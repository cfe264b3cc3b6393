#pragma once
#include <mrpt/img/TColor.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <string>
#include <string_view>

namespace hagen::observations {

/// Colours of the results: colour-blind safe, and both distinct from a viewer's grey.
const mrpt::img::TColor kRoiColor(213, 94, 0), kNonRoiColor(150, 190, 230);

constexpr const char* kRoiSuffix = "_roi";
constexpr const char* kNonRoiSuffix = "_non_roi";
/// Name of the object in the scene of a preview. One of its parts is named after the scan, as
/// rawlogs do not keep the label of a scene.
constexpr const char* kPreviewName = "hagen preview";
constexpr std::string_view kPreviewOfPrefix = "zone of ";

/// A cloud as a result of the filter: its label is that of the scan and a suffix, its time and pose
/// are those of the scan. The mark of a result is the colour in its cloud's renderOptions, which
/// rawlogs keep and which viewers may use.
mrpt::obs::CObservationPointCloud::Ptr resultOf(const mrpt::obs::CObservation& scan, bool is_roi,
                                                const mrpt::maps::CPointsMap::Ptr& points);

/// Whether the filter made this observation: a cloud with suffix and mark, or a preview. A label
/// alone does not tell: a scan may be labelled "front_roi".
bool isResult(const mrpt::obs::CObservation& observation);

/// The label of the scan that a result comes from.
std::string scanLabelOf(const mrpt::obs::CObservation& result);

}  // namespace hagen::observations
