#pragma once
#include <hagen/observations/Settings.h>
#include <hagen/segmentation/HagenFilter.h>
#include <mrpt/maps/CPointCloudFilterBase.h>
#include <mrpt/poses/CPose3D.h>

namespace hagen::observations {

/// The filter where MRPT expects a point-cloud filter, such as in its reactive navigation: of one
/// LiDAR scan's points it keeps the RoI. Points out of the sensor's range are deleted too.
class RoiPointCloudFilter : public mrpt::maps::CPointCloudFilterBase {
 public:
    /// `sensor_pose`: the sensor in the cloud's frame; identity where points are in the sensor's
    /// own. Throws SettingsError where the options do not fit the sensor.
    explicit RoiPointCloudFilter(const Settings& settings,
                                 const mrpt::poses::CPose3D& sensor_pose = {});

    /// Deletes all but the RoI points. `params` as MRPT has it: a mask of what was deleted, and the
    /// wish not to delete. Time stamp and reference pose play no part: the filter uses no map.
    void filter(mrpt::maps::CPointsMap* inout_pointcloud, mrpt::system::TTimeStamp pc_timestamp,
                const mrpt::poses::CPose3D& pc_reference_pose,
                TExtraFilterParams* params = nullptr) override;

 private:
    mrpt::poses::CPose3D sensor_pose_;
    HagenFilter filter_;
    Scan scan_;
};

}  // namespace hagen::observations
