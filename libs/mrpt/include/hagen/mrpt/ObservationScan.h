#pragma once
#include <hagen/mrpt/RotatingScan.h>
#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/settings/CloudSensors.h>
#include <hagen/settings/Settings.h>
#include <mrpt/core/Clock.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hagen::observations {

/// True if the observation is read as a LiDAR scan: a CObservationVelodyneScan, a rotating scan
/// (rotatingScanOf()), a depth camera's scan (depthScanOf()), or a CObservationPointCloud that is
/// not a result of the filter (isResult()).
bool isLidarScan(const mrpt::obs::CObservation& observation);

/// True if the observation is a LiDAR scan that does not identify its sensor: it has no packets and
/// is neither a LocatedCloud nor a rotating scan without points.
bool isCloud(const mrpt::obs::CObservation& observation);

/// A LiDAR scan read from an observation.
struct ObservedScan {
    Scan scan;
    SensorModel sensor;
    /// The beams of `sensor` if neither the recording nor the settings name it; otherwise null.
    SharedBeams recovered;
    bool is_sensor_assumed = false;  ///< whether a VLP-16 is assumed for lack of a name and beams
    /// Warnings: skipped packet blocks, settings overridden by the recording. May be empty.
    std::string remark;

    /// Buffers of readObservation(), reused across scans.
    struct Workspace {
        ObservationWorkspace decoder;
        RotatingReturns rotating;
        /// The sensor for these settings and beams; rebuilt only if these change.
        std::optional<Settings::Sensor> settings;
        SharedBeams beams;
        SensorModel sensor_of_settings;
    };
    Workspace work;
};

/// Reads a scan in its sensor's frame. The sensor comes from the recording (packets), the settings,
/// or the recovered `beams`, in this order; the fallback is a VLP-16. If a Velodyne scan has no
/// packets, its stored cloud is read. Throws std::runtime_error if packets cannot be decoded or the
/// cloud is missing. Reuses the memory of `observed`.
void readObservation(const mrpt::obs::CObservation& observation, const Settings& settings,
                     ObservedScan& observed, const SharedBeams& beams = nullptr);

/// Reads the coordinates and intensities of a cloud, and its ring numbers, if any. Returns false if
/// not isCloud(). Throws like readObservation().
bool readCloudPoints(const mrpt::obs::CObservation& observation, Scan& scan,
                     std::vector<std::int32_t>* rings = nullptr);

/// Uses an observation to recover its sensor, if it is a readable cloud (not packets).
void showCloud(const mrpt::obs::CObservation& observation, CloudSensors& sensors);

/// Point type of a cloud.
enum class CloudClass {
    Simple,         ///< CSimplePointsMap: coordinates only; readable by MRPT 2.5 to 3
    WithIntensity,  ///< IntensityCloud: coordinates and intensities
    Generic         ///< CGenericPointsMap: all fields (genericCloudOf())
};

/// Converts all returns, or those with these indices, to an MRPT cloud.
mrpt::maps::CPointsMap::Ptr cloudOf(const Scan& scan, CloudClass cloud_class);
mrpt::maps::CPointsMap::Ptr cloudOf(const Scan& scan, const std::vector<std::uint32_t>& indices,
                                    CloudClass cloud_class);

/// Returns an observation that contains these returns.
mrpt::obs::CObservationPointCloud::Ptr observationOf(
    const Scan& scan, const std::string& label, mrpt::Clock::time_point time,
    CloudClass cloud_class = CloudClass::WithIntensity);

}  // namespace hagen::observations
