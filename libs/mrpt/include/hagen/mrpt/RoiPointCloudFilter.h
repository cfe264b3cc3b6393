#pragma once
#include <hagen/filter/HagenFilter.h>
#include <hagen/settings/CloudSensors.h>
#include <hagen/settings/Settings.h>
#include <mrpt/maps/CPointCloudFilterBase.h>
#include <mrpt/poses/CPose3D.h>

#include <optional>

namespace hagen::observations {

/// The filter as an MRPT point-cloud filter, as used by its reactive navigation: keeps only the RoI
/// points of a LiDAR scan, without the airframe in the settings. If the settings name no sensor, it
/// is recovered from the first clouds (CloudSensors.h).
class RoiPointCloudFilter : public mrpt::maps::CPointCloudFilterBase {
 public:
    /// `sensor_pose` is the sensor's pose in the cloud's frame, which is assumed level. Throws
    /// SettingsError if the options do not fit the sensor of the settings.
    explicit RoiPointCloudFilter(const Settings& settings,
                                 const mrpt::poses::CPose3D& sensor_pose = {});

    /// Deletes all points except RoI. `params` as in MRPT: an output mask of deleted points, and an
    /// option to keep points. Ignores time stamp and reference pose. Throws SettingsError if the
    /// options do not fit a recovered sensor.
    void filter(mrpt::maps::CPointsMap* inout_pointcloud, mrpt::system::TTimeStamp pc_timestamp,
                const mrpt::poses::CPose3D& pc_reference_pose,
                TExtraFilterParams* params = nullptr) override;

 private:
    void recoverSensor();

    mrpt::poses::CPose3D sensor_pose_;
    std::optional<Attitude> tilt_;
    Settings settings_;
    HagenFilter filter_;
    CloudSensors sensors_;
    SharedBeams beams_;  ///< beams of filter_; null if from the settings
    Scan scan_;
};

}  // namespace hagen::observations
