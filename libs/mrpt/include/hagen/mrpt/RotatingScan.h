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

/// The points of a range image, a pixel each, row by row.
struct OrganizedPoints {
    int rows = 0, columns = 0;
    std::vector<float> x_m, y_m, z_m;  ///< in the sensor's frame; 0, 0, 0 or not finite: none
};

/// Makes CObservationRotatingScan as MRPT from 2.9 to 3 writes it readable by older ones, which
/// keep the class's version 0 for another layout. Both layouts are read, told apart by the size of
/// the image, which the older one has where the newer one has a byte more. (An image without
/// pixels is taken to be of the older layout.) Such scans are written in the older layout, without
/// their points. Call it once, after MRPT's own classes are registered (registerMrptClasses()).
///
/// Reading throws std::runtime_error, naming the file, for a scan that is stored outside the log.
void registerNewerScans();

/// The observation, if it is a CObservationRotatingScan with more than one row; otherwise null. (A
/// single row is a planar scan, in which there is no ground to tell apart.)
const mrpt::obs::CObservationRotatingScan* rotatingScanOf(
    const mrpt::obs::CObservation& observation);

/// The points of the scan's pixels, which newer MRPTs can store; null without.
const OrganizedPoints* organizedPointsOf(const mrpt::obs::CObservationRotatingScan& observation);

/// What was read of a rotating scan, beside its returns.
struct RotatingReturns {
    std::vector<std::int32_t> image_row;  ///< of each return
    std::string remark;                   ///< what the user should know; empty: nothing
};

/// Reads the returns of a scan that has points, column by column: coordinates, intensities, and
/// times if the duration of the turn is known. Range, azimuth and row are not set. A return is a
/// pixel with a point, and every further range of that pixel (`rangeOtherLayers`), in the same
/// direction. Throws std::runtime_error if images differ in size.
void readOrganizedPoints(const mrpt::obs::CObservationRotatingScan& observation, Scan& scan,
                         RotatingReturns& returns);

/// Reads the returns of a scan without points, column by column, with ranges, azimuths and rows.
///
/// The elevations of the rows are those of the sensor that the scan names (`lidarModel`) or, if it
/// names none that is known, or the settings list elevations, that of the settings. Row 0 is the
/// lowest beam, but of an Ouster the highest. Columns go evenly from the first azimuth to the last,
/// both inclusive: counter-clockwise if `azimuthSpan` is positive. All returns of a column have its
/// azimuth.
///
/// An image that MRPT made of Velodyne packets (fromVelodyne()) is known by its unused columns, as
/// many in total as a packet has bytes for: its rows are lasers in the order of firing, its
/// azimuths are clockwise, and each laser has its own. MRPT leaves out half of the returns.
///
/// `sensor` gets those beams, and the range limits of the settings or else of the observation.
/// Throws std::runtime_error, saying what to do, if nobody names a sensor with these rows, if the
/// resolution or azimuths are not finite, or if images differ in size.
void readRangeImage(const mrpt::obs::CObservationRotatingScan& observation,
                    const Settings& settings, Scan& scan, SensorModel& sensor,
                    RotatingReturns& returns);

/// Takes the range limits of the settings, otherwise those of the observation if they are sound.
void takeLimits(const mrpt::obs::CObservationRotatingScan& observation, const Settings& settings,
                SensorModel& sensor);

}  // namespace hagen::observations
