#include "mrpt/ScenePreview.h"
#include <mrpt/img/TColor.h>
#include "filter/RoiBoxes.h"
#include "mrpt/MrptScene.h"
#include "mrpt/Results.h"

namespace hagen::observations {
namespace {

const mrpt::img::TColor kZoneColor(240, 240, 240), kBoxColor(255, 190, 120);
constexpr float kRoiPixels = 4.0f, kNonRoiPixels = 2.0f;

observations::viz::CPointCloudColoured::Ptr coloured(const mrpt::maps::CPointsMap& points,
                                                     const mrpt::img::TColor& color, float pixels) {
    auto cloud = observations::viz::CPointCloudColoured::Create();
    cloud->setPointSize(pixels);
    cloud->reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        float x, y, z;
        points.getPointFast(i, x, y, z);
        cloud->insertPoint({x, y, z, color.R, color.G, color.B, color.A});
    }
    return cloud;
}

/// Adds the twelve edges of a box.
void addEdges(const Eigen::AlignedBox3f& box, observations::viz::CSetOfLines& lines) {
    using Box = Eigen::AlignedBox3f;
    // Bit k of a corner's number is set if the corner is at the upper end of axis k.
    for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3f a = box.corner(static_cast<Box::CornerType>(corner));
        for (const int bit : {1, 2, 4}) {
            if ((corner & bit) != 0) continue;
            const Eigen::Vector3f b = box.corner(static_cast<Box::CornerType>(corner | bit));
            lines.appendLine(a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
        }
    }
}

}  // namespace

mrpt::obs::CObservation3DScene::Ptr previewOf(const mrpt::obs::CObservation& observation,
                                              const ObservationSegmenter::Output& segmented,
                                              float zone_m) {
    auto sensor = observations::viz::CSetOfObjects::Create();
    sensor->setName(kPreviewName);
    sensor->setPose(mrpt::poses::CPose3D(observation.sensorPose()));
    sensor->insert(coloured(*segmented.non_roi->pointcloud, kNonRoiColor, kNonRoiPixels));
    sensor->insert(coloured(*segmented.roi->pointcloud, kRoiColor, kRoiPixels));
    // Use lines, because MRPT 3 cannot read the boxes of MRPT 2.
    auto frames = observations::viz::CSetOfLines::Create();
    frames->setName("obstacles");
    frames->setColor_u8(kBoxColor);
    const auto boxes = boxRoiComponents(*segmented.scan, segmented.result->returns);
    for (const RoiBox& box : boxesToDraw(boxes)) addEdges(box.extents_m, *frames);
    sensor->insert(frames);
    sensor->insert(observations::viz::stock_objects::CornerXYZSimple(1.0f, 2.0f));
    auto zone = observations::viz::CDisk::Create(zone_m, zone_m - 0.15f, 100);
    zone->setColor_u8(kZoneColor);
    zone->setName(std::string(kPreviewOfPrefix) + observation.sensorLabel);
    sensor->insert(zone);

    auto preview = mrpt::obs::CObservation3DScene::Create();
    preview->timestamp = observation.timestamp;
    preview->sensorLabel = observation.sensorLabel + "_preview";
    preview->sensorPose = mrpt::poses::CPose3D(observation.sensorPose());
    preview->scene = std::make_shared<observations::Scene>();
    preview->scene->insert(sensor);
    return preview;
}

}  // namespace hagen::observations
