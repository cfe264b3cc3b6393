#pragma once
#include <hagen/mrpt/CloudSensors.h>
#include <hagen/mrpt/RotatingScan.h>
#include <hagen/mrpt/VelodyneDecoder.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
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
/// (rotatingScanOf()), one of a depth camera (depthScanOf()), or a CObservationPointCloud that is
/// no result of the filter (isResult()).
bool isLidarScan(const mrpt::obs::CObservation& observation);

/// True if it is such a scan without packets, and no LocatedCloud: one that does not identify its
/// sensor. A rotating scan is one if it has points; otherwise somebody has to name its sensor.
bool isCloud(const mrpt::obs::CObservation& observation);

/// A LiDAR scan read from an observation.
struct ObservedScan {
    Scan scan;
    SensorModel sensor;
    /// Beams of a cloud whose sensor neither the recording nor the settings name; `sensor` is made
    /// of them. Null otherwise.
    SharedBeams recovered;
    bool is_sensor_assumed = false;  ///< nobody names the sensor, and no beams are known: VLP-16
    /// Warnings for the user: skipped packet blocks, or settings that the recording overrides.
    /// Empty: none.
    std::string remark;

    /// Buffers of readObservation(), reused across scans.
    struct Workspace {
        DecoderWorkspace decoder;
        RotatingReturns rotating;
        /// The sensor of these settings and beams; rebuilt only if they change.
        std::optional<Settings::Sensor> settings;
        SharedBeams beams;
        SensorModel sensor_of_settings;
    };
    Workspace work;
};

/// Reads a scan in its sensor's frame. The sensor is the recording's own if the recording names one
/// (packets), otherwise that of the settings (clouds), otherwise the one with the beams that were
/// recovered from such clouds (`beams`), otherwise a VLP-16. A Velodyne scan without packets but
/// with a stored cloud returns that cloud. Throws std::runtime_error if packets cannot be decoded
/// or the cloud is missing; the message says why. Reuses the memory of `observed`, so that reading
/// many scans allocates little.
void readObservation(const mrpt::obs::CObservation& observation, const Settings& settings,
                     ObservedScan& observed, const SharedBeams& beams = nullptr);

/// Reads the coordinates of a cloud, and its intensities, and the numbers of the rings of its
/// returns if it has some; otherwise `rings` becomes empty (null: not wanted). Returns false if it
/// is none (isCloud()). Throws like readObservation().
bool readCloudPoints(const mrpt::obs::CObservation& observation, Scan& scan,
                     std::vector<std::int32_t>* rings = nullptr);

/// Point type of a cloud.
enum class CloudClass {
    Simple,         ///< CSimplePointsMap: coordinates only; readable by every MRPT from 2.5 to 3
    WithIntensity,  ///< CPointsMapXYZI: coordinates and intensities
    Generic  ///< CGenericPointsMap: all fields; readable by MRPT from 2.15 on (NewerClouds.h)
};

/// Returns all returns, or those with these indices, as an MRPT cloud.
mrpt::maps::CPointsMap::Ptr cloudOf(const Scan& scan, CloudClass cloud_class);
mrpt::maps::CPointsMap::Ptr cloudOf(const Scan& scan, const std::vector<std::uint32_t>& indices,
                                    CloudClass cloud_class);

/// Returns an observation that contains these returns.
mrpt::obs::CObservationPointCloud::Ptr observationOf(
    const Scan& scan, const std::string& label, mrpt::Clock::time_point time,
    CloudClass cloud_class = CloudClass::WithIntensity);

}  // namespace hagen::observations
