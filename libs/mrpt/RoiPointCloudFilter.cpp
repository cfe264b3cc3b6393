#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/RoiPointCloudFilter.h>
#include "mrpt/Mount.h"

namespace hagen::observations {

RoiPointCloudFilter::RoiPointCloudFilter(const Settings& settings,
                                         const mrpt::poses::CPose3D& sensor_pose)
    : sensor_pose_(sensor_pose),
      tilt_(mountedPose({}, sensor_pose, settings.mount).attitude),
      settings_(settings),
      filter_(filterFor(settings.sensorModel(), settings.options)) {}

/// Adapts the filter to the sensor recovered from the clouds so far.
void RoiPointCloudFilter::recoverSensor() {
    if (settings_.sensor.model) return;
    sensors_.see("", scan_);
    const SharedBeams beams = sensors_.beamsOf("");
    if (beams == beams_) return;
    filter_ = filterFor(settings_.sensorModel(beams.get()), settings_.optionsFor(beams.get()));
    beams_ = beams;
}

void RoiPointCloudFilter::filter(mrpt::maps::CPointsMap* inout_pointcloud,
                                 mrpt::system::TTimeStamp /*pc_timestamp*/,
                                 const mrpt::poses::CPose3D& /*pc_reference_pose*/,
                                 TExtraFilterParams* params) {
    scan_.clear();
    for (std::size_t i = 0; i < inout_pointcloud->size(); ++i) {
        mrpt::math::TPoint3D point;
        inout_pointcloud->getPoint(i, point);
        const mrpt::math::TPoint3D seen = sensor_pose_.inverseComposePoint(point);
        scan_.x_m.push_back(static_cast<float>(seen.x));
        scan_.y_m.push_back(static_cast<float>(seen.y));
        scan_.z_m.push_back(static_cast<float>(seen.z));
    }
    scan_.intensity.assign(scan_.size(), 0.0f);
    recoverSensor();
    locateBeams(filter_.sensor(), scan_);
    maskAirframe(settings_.airframe.parts, scan_);

    std::vector<bool> deleted(scan_.size(), true);
    for (const std::uint32_t i : filter_.segment(scan_, tilt_).returns.roi) deleted[i] = false;
    if (params == nullptr || !params->do_not_delete) deletePoints(deleted, *inout_pointcloud);
    if (params != nullptr && params->out_deletion_mask != nullptr) {
        *params->out_deletion_mask = std::move(deleted);
    }
}

}  // namespace hagen::observations
