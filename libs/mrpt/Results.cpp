#include "mrpt/Results.h"
#include <hagen/mrpt/NewerClouds.h>
#include "base/Text.h"
#include "mrpt/MrptScene.h"

#include <mrpt/obs/CObservation3DScene.h>

#include <algorithm>
#include <cmath>

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationPointCloud;

const char* suffixOf(bool is_roi) { return is_roi ? kRoiSuffix : kNonRoiSuffix; }
const mrpt::img::TColor& colorOf(bool is_roi) { return is_roi ? kRoiColor : kNonRoiColor; }

bool isAbout(const mrpt::img::TColorf& a, const mrpt::img::TColorf& b) {
    const float half_step = 0.5f / 255.0f;
    return std::abs(a.R - b.R) < half_step && std::abs(a.G - b.G) < half_step &&
           std::abs(a.B - b.B) < half_step;
}

/// Whether a cloud is marked as a result. CGenericPointsMap does not store renderOptions, but has
/// colour fields, even if empty.
bool isMarked(const mrpt::maps::CPointsMap& cloud, bool is_roi) {
    if (isAbout(cloud.renderOptions.color, mrpt::img::TColorf(colorOf(is_roi)))) return true;
    if (!cloud.empty()) return false;
    const auto others = otherFieldsOf(cloud);
    return others && std::all_of(kColorFields.begin(), kColorFields.end(), [&](const char* name) {
               return findField(*others, {name}) != nullptr;
           });
}

/// The suffix of a result's label; empty for other observations.
std::string suffixOf(const mrpt::obs::CObservation& observation) {
    const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&observation);
    // A cloud in an external file has not been read and is not a result.
    if (cloud == nullptr || cloud->pointcloud == nullptr) return "";
    for (const bool is_roi : {false, true}) {  // "_non_roi" last, because it also ends in "_roi"
        if (base::endsWith(cloud->sensorLabel, suffixOf(is_roi)) &&
            isMarked(*cloud->pointcloud, is_roi)) {
            return suffixOf(is_roi);
        }
    }
    return "";
}

/// The object of a preview; null for other observations.
observations::viz::CSetOfObjects::Ptr previewIn(const mrpt::obs::CObservation& observation) {
    const auto* scene = dynamic_cast<const mrpt::obs::CObservation3DScene*>(&observation);
    if (scene == nullptr || !scene->scene) return nullptr;
    return std::dynamic_pointer_cast<observations::viz::CSetOfObjects>(
        scene->scene->getByName(kPreviewName));
}

}  // namespace

CObservationPointCloud::Ptr resultOf(const mrpt::obs::CObservation& scan, bool is_roi,
                                     const mrpt::maps::CPointsMap::Ptr& points) {
    points->renderOptions.color = mrpt::img::TColorf(colorOf(is_roi));
    auto result = CObservationPointCloud::Create();
    result->timestamp = scan.timestamp;
    result->sensorLabel = scan.sensorLabel + suffixOf(is_roi);
    result->sensorPose = mrpt::poses::CPose3D(scan.sensorPose());
    result->pointcloud = points;
    return result;
}

bool isResult(const mrpt::obs::CObservation& observation) {
    return !suffixOf(observation).empty() || previewIn(observation) != nullptr;
}

std::string scanLabelOf(const mrpt::obs::CObservation& result) {
    if (const auto preview = previewIn(result)) {
        for (const auto& part : *preview) {
            const std::string& name = part->getName();
            if (name.rfind(kPreviewOfPrefix, 0) == 0) return name.substr(kPreviewOfPrefix.size());
        }
        return "";
    }
    const std::string& label = result.sensorLabel;
    const std::string suffix = suffixOf(result);
    return suffix.empty() ? "" : label.substr(0, label.size() - suffix.size());
}

}  // namespace hagen::observations
