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

/// A cloud with everything that its input holds for each point. It lives in memory only: MRPT
/// writes it as the CPointsMapXYZI that it is, and the other fields are lost.
///
/// Fields are known by their names, without regard to case:
///
/// - x, y, z: coordinates in the sensor's frame [m].
/// - intensity, i, reflectivity, remission, the first of these: scaled to 0..1 by its greatest
///   value, which is at most 1, 255, 65535, or else is the scale itself. Not finite: 0.
/// - ring, channel, line: the number of the beam. It becomes the row only if it agrees with the
///   elevation (ringBeams() of RecoverBeams.h) and no sensor is named in the settings.
/// - time, t, timestamp and others: when the point was measured (timesOf() of PointFields.h).
///
/// Points with a coordinate that is not finite are no returns: they stay in the table, but are not
/// in the cloud.
class TableCloud : public IntensityCloud {
 public:
    /// Throws std::runtime_error that says why if the table is unsound (check()), has no x, y or z,
    /// or more points than 32 bits can number.
    explicit TableCloud(std::shared_ptr<const PointTable> table);

    const PointTable& table() const { return *table_; }
    /// The point of the table of each return, ascending.
    const std::vector<std::uint32_t>& pointOfReturn() const { return point_of_return_; }
    const std::vector<std::int32_t>& rings() const { return rings_; }  ///< empty: none
    const std::vector<float>& times_s() const { return times_s_; }     ///< empty: none
    std::size_t pointsNotFinite() const { return table_->points - point_of_return_.size(); }

    /// What the user should know of the fields of this cloud: those that are not what their name
    /// says, or coordinates that cannot be a scan's. Clouds of one recording usually have the same.
    const std::vector<std::string>& remarks() const { return remarks_; }

 private:
    void takeIntensities();

    std::shared_ptr<const PointTable> table_;
    std::vector<std::uint32_t> point_of_return_;
    std::vector<std::int32_t> rings_;
    std::vector<float> times_s_;
    std::vector<std::string> remarks_;
};

/// An observation of a table's points. Throws like TableCloud.
mrpt::obs::CObservationPointCloud::Ptr observationOf(std::shared_ptr<const PointTable> table,
                                                     const std::string& label,
                                                     mrpt::Clock::time_point time);

/// The cloud of an observation, if it is such a cloud; otherwise null.
const TableCloud* tableCloudOf(const mrpt::obs::CObservation& observation);

/// A table of a scan: x, y, z, intensity (0..1), and if they are known `time` [s]; all float32.
PointTable tableOf(const Scan& scan);
/// The same without times.
PointTable untimedTableOf(const Scan& scan);

}  // namespace hagen::observations
