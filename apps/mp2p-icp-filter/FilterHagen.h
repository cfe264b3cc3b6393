#pragma once
#include <hagen/mrpt/RoiPointCloudFilter.h>
#include <mp2p_icp_filters/FilterBase.h>

#include <mutex>
#include <optional>
#include <string>

namespace hagen {

/// The filter in a pipeline of mp2p_icp: splits a layer of one LiDAR scan into RoI and ROU points.
/// With MRPT 2.15 or later, outputs keep all fields of the points and have a uint8 field `label`
/// (Label.h). Parameters (examples/mp2p_icp/pipeline.yaml):
///   input_pointcloud_layer   default: raw. The layer is in the frame of the vehicle.
///   output_layer_roi         points of regions of interest (near obstacles)
///   output_layer_rou         all others: ground, far returns, the vehicle itself
///   settings                 preset or file (docs/settings.md); default: recovers the sensor
///   sensor_pose              of the sensor on the vehicle: [x, y, z, yaw, pitch, roll], in metres
///                            and degrees
/// At least one output is required. If both name the same layer, it contains all points. Existing
/// layers are appended to.
class FilterHagen : public mp2p_icp_filters::FilterBase {
    DEFINE_MRPT_OBJECT(FilterHagen, hagen)

 public:
    FilterHagen();

    /// Both throw std::runtime_error naming the wrong parameter, or SettingsError. mp2p_icp 1.8
    /// calls the first, later versions the second.
    void initialize(const mrpt::containers::yaml& parameters);  // NOLINT(modernize-use-override)
    void initialize_filter(const mrpt::containers::yaml& parameters);

    /// Throws std::runtime_error if a layer is missing or not a point cloud.
    void filter(mp2p_icp::metric_map_t& map) const override;

 private:
    std::string input_layer_, roi_layer_, rou_layer_;
    mutable std::mutex segmenting_;
    mutable std::optional<observations::RoiPointCloudFilter> filter_;
};

}  // namespace hagen
