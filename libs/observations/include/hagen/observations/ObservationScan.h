#pragma once
#include <hagen/observations/Settings.h>
#include <hagen/observations/VelodyneDecoder.h>
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <mrpt/core/Clock.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hagen::observations {

/// Whether this project reads the observation as a LiDAR scan: a CObservationVelodyneScan, or a
/// CObservationPointCloud, unless its label ends in `_roi` or `_non_roi`: those are results.
bool isLidarScan(const mrpt::obs::CObservation& observation);

/// A LiDAR scan out of an observation.
struct ObservedScan {
    Scan scan;
    SensorModel sensor;
    bool is_sensor_assumed = false;  ///< neither the recording nor the settings name the sensor
    /// What a user should know: packet blocks left out, or settings that the recording overrules.
    /// Empty if there is nothing.
    std::string remark;

    /// Memory that readObservation() keeps from scan to scan.
    struct Workspace {
        DecoderWorkspace decoder;
        /// The sensor made of these settings, which is made anew only where they change.
        std::optional<Settings::Sensor> settings;
        SensorModel sensor_of_settings;
    };
    Workspace work;
};

/// Reads a scan in its sensor's frame. The sensor is the recording's own if it names one (packets),
/// otherwise that of the settings (clouds). A Velodyne scan without packets but with a stored cloud
/// gives that cloud. Throws std::runtime_error, saying why, for packets that cannot be decoded and
/// for a missing cloud. Reuses the memory of `observed`, so that reading many scans allocates
/// little.
void readObservation(const mrpt::obs::CObservation& observation, const Settings& settings,
                     ObservedScan& observed);

/// What a cloud is made of.
enum class CloudClass {
    Simple,        ///< CSimplePointsMap: coordinates alone; every MRPT from 2.5 to 3 reads it
    WithIntensity  ///< CPointsMapXYZI: intensities, too
};

/// The returns of a scan as an MRPT cloud; of those with these indices (ascending), of which any
/// beyond the scan are passed over.
mrpt::maps::CPointsMap::Ptr cloudOf(const Scan& scan, CloudClass cloud_class);
mrpt::maps::CPointsMap::Ptr cloudOf(const Scan& scan, const std::vector<std::uint32_t>& indices,
                                    CloudClass cloud_class);

/// An observation of these returns.
mrpt::obs::CObservationPointCloud::Ptr observationOf(
    const Scan& scan, const std::string& label, mrpt::Clock::time_point time,
    CloudClass cloud_class = CloudClass::WithIntensity);

}  // namespace hagen::observations
