#pragma once
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/PointTable.h>
#include <hagen/scan/Scan.h>
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace hagen::observations {

/// A cloud with all fields of its input. MRPT writes only coordinates and intensities. Field
/// names are case-insensitive:
///
/// - x, y, z: coordinates in the sensor's frame [m].
/// - the first of intensity, i, reflectivity, remission: scaled to 0..1 by the smallest of 1, 255,
///   65535 that is at least the maximum, otherwise by the maximum. 0 if not finite.
/// - ring, channel, line: the beam number (ringsOf()). It becomes the row only if it agrees with
///   the elevation (ringBeams()) and the settings name no sensor.
/// - time, t, timestamp and others: times (timesOf()).
///
/// Points with non-finite coordinates stay in the table, but are not in the cloud.
class TableCloud : public IntensityCloud {
 public:
    /// `period_s`: time between scans; 0 if unknown. Throws std::runtime_error with the reason if
    /// the table is invalid (check()), has no x, y or z, or more than 2^32 - 1 points.
    explicit TableCloud(std::shared_ptr<const PointTable> table, double period_s = 0);

    const PointTable& table() const { return *table_; }
    /// The table row of each return, ascending.
    const std::vector<std::uint32_t>& pointOfReturn() const { return point_of_return_; }
    const std::vector<std::int32_t>& rings() const { return rings_; }  ///< empty if unknown
    const std::vector<float>& times_s() const { return times_s_; }     ///< empty if unknown
    std::size_t pointsNotFinite() const { return table_->points - point_of_return_.size(); }

    /// Warnings about unusable fields and implausible coordinates.
    const std::vector<std::string>& remarks() const { return remarks_; }

 private:
    void takeIntensities();

    std::shared_ptr<const PointTable> table_;
    std::vector<std::uint32_t> point_of_return_;
    std::vector<std::int32_t> rings_;
    std::vector<float> times_s_;
    std::vector<std::string> remarks_;
};

/// An observation with a TableCloud. Throws like the constructor of TableCloud.
mrpt::obs::CObservationPointCloud::Ptr observationOf(std::shared_ptr<const PointTable> table,
                                                     const std::string& label,
                                                     mrpt::Clock::time_point time,
                                                     double period_s = 0);

/// The cloud of an observation if it is a TableCloud, otherwise null.
const TableCloud* tableCloudOf(const mrpt::obs::CObservation& observation);

/// The table of a scan: x, y, z, intensity (0..1), and `time` [s] if known; all float32.
PointTable tableOf(const Scan& scan);
/// Like tableOf(), but without times.
PointTable untimedTableOf(const Scan& scan);

}  // namespace hagen::observations
