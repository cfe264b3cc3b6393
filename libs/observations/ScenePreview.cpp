#include <hagen/observations/ScenePreview.h>
#include <hagen/segmentation/RoiBoxes.h>
#include <mrpt/img/TColor.h>
#include <mrpt/opengl/CBox.h>
#include <mrpt/opengl/CDisk.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/stock_objects.h>

namespace hagen::observations {
namespace {

// Colour-blind safe, and both distinct from the viewer's grey.
const mrpt::img::TColor kRoiColor(213, 94, 0), kRouColor(150, 190, 230), kZoneColor(240, 240, 240),
    kBoxColor(255, 190, 120);
constexpr std::uint32_t kLeastBoxed = 30;  // returns; boxes around fewer only hide them
constexpr float kRoiPixels = 4.0f, kRouPixels = 2.0f;

mrpt::opengl::CPointCloudColoured::Ptr coloured(const mrpt::maps::CPointsMap& points,
                                                const mrpt::img::TColor& color, float pixels) {
    auto cloud = mrpt::opengl::CPointCloudColoured::Create();
    cloud->setPointSize(pixels);
    cloud->reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        float x, y, z;
        points.getPointFast(i, x, y, z);
        cloud->insertPoint({x, y, z, color.R, color.G, color.B, color.A});
    }
    return cloud;
}

mrpt::opengl::CBox::Ptr frameAround(const RoiBox& box) {
    const auto corner = [](const Eigen::Vector3f& p) {
        return mrpt::math::TPoint3D(p.x(), p.y(), p.z());
    };
    auto frame =
        mrpt::opengl::CBox::Create(corner(box.extents_m.min()), corner(box.extents_m.max()), true);
    frame->setColor_u8(kBoxColor);
    frame->setBoxBorderColor(kBoxColor);
    return frame;
}

}  // namespace

mrpt::obs::CObservation3DScene::Ptr previewOf(const mrpt::obs::CObservation& observation,
                                              const ObservationSegmenter::Output& segmented,
                                              float zone_m) {
    auto sensor = mrpt::opengl::CSetOfObjects::Create();
    sensor->setPose(mrpt::poses::CPose3D(observation.sensorPose()));
    sensor->insert(coloured(*segmented.non_roi->pointcloud, kRouColor, kRouPixels));
    sensor->insert(coloured(*segmented.roi->pointcloud, kRoiColor, kRoiPixels));
    for (const RoiBox& box : boxRoiComponents(*segmented.scan, segmented.result->returns)) {
        if (box.returns >= kLeastBoxed) sensor->insert(frameAround(box));
    }
    sensor->insert(mrpt::opengl::stock_objects::CornerXYZSimple(1.0f, 2.0f));
    auto zone = mrpt::opengl::CDisk::Create(zone_m, zone_m - 0.15f, 100);
    zone->setColor_u8(kZoneColor);
    sensor->insert(zone);

    auto preview = mrpt::obs::CObservation3DScene::Create();
    preview->timestamp = observation.timestamp;
    preview->sensorLabel = observation.sensorLabel + "_preview";
    preview->sensorPose = mrpt::poses::CPose3D(observation.sensorPose());
    preview->scene = mrpt::opengl::COpenGLScene::Create();
    preview->scene->insert(sensor);
    return preview;
}

}  // namespace hagen::observations
