#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/settings/Settings.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationRotatingScan.h>

#include <cstdint>
#include <string>
#include <vector>

namespace hagen::observations {

/// The points of a range image's pixels, row by row.
struct OrganizedPoints {
    int rows = 0, columns = 0;
    std::vector<float> x_m, y_m, z_m;  ///< in the sensor's frame; all 0 or not finite if missing
};

/// Lets older MRPTs read the CObservationRotatingScan of MRPT 2.11.4 to 3. The layout differs under
/// the same version 0. The position of the image size distinguishes the layouts; an image without
/// pixels is read in the layout of the installed MRPT. Scans are written without their points.
/// Call once, after registering MRPT's own classes (registerMrptClasses()).
///
/// Reading throws std::runtime_error, naming the file, for a scan that is stored outside the log.
void registerNewerScans();

/// The observation if it is a CObservationRotatingScan with more than one row, otherwise null. (A
/// single row is a planar scan without ground.)
const mrpt::obs::CObservationRotatingScan* rotatingScanOf(
    const mrpt::obs::CObservation& observation);

/// The points of the scan's pixels, which newer MRPTs can store; null if the scan has none.
const OrganizedPoints* organizedPointsOf(const mrpt::obs::CObservationRotatingScan& observation);

/// Further results of reading a rotating scan.
struct RotatingReturns {
    std::vector<std::int32_t> image_row;  ///< image row of each return
    std::string remark;                   ///< warning for the user, or empty
};

/// Reads the returns of a scan that has points, column by column: coordinates, intensities, and
/// times if the duration of the turn is known. Range, azimuth and row are not set. A pixel with a
/// point is a return, as is each of its further ranges (`rangeOtherLayers`), in the same direction.
/// Throws std::runtime_error if images differ in size.
void readOrganizedPoints(const mrpt::obs::CObservationRotatingScan& observation, Scan& scan,
                         RotatingReturns& returns);

/// Reads the returns of a scan without points, column by column, with ranges, azimuths and rows.
///
/// The row elevations come from the sensor named by the scan (`lidarModel`), or from the settings
/// if that is unknown or if they list elevations. Row 0 is the lowest beam, or the highest for an
/// Ouster. Columns are evenly spaced from the first azimuth to the last, both inclusive,
/// counter-clockwise if `azimuthSpan` is positive.
///
/// An image that MRPT converted from Velodyne packets (fromVelodyne()) is recognized by its unused
/// columns. Its rows are lasers in firing order, its azimuths are clockwise and differ by laser,
/// and half of the returns are missing.
///
/// `sensor` gets these beams and the observation's range limits. Throws std::runtime_error if no
/// sensor with this number of rows is named, if the resolution or azimuths are not finite, or if
/// images differ in size.
void readRangeImage(const mrpt::obs::CObservationRotatingScan& observation,
                    const Settings& settings, Scan& scan, SensorModel& sensor,
                    RotatingReturns& returns);

/// Copies the range limits of the observation if they are valid.
void takeLimits(const mrpt::obs::CObservationRotatingScan& observation, SensorModel& sensor);

}  // namespace hagen::observations
