#pragma once
#include <hagen/mrpt/PointTable.h>

#include <cstdint>
#include <string>
#include <vector>

/// Standard fields of a cloud, by their case-insensitive names.
namespace hagen::observations {

/// Beam numbers or times of points.
template <class Number>
struct PointFieldValues {
    std::vector<Number> values;  ///< one per requested point; empty if unknown
    std::string field;           ///< name of the field; empty if missing or not used
    std::string remark;  ///< why the field is not used or its unit is doubtful; may be empty
};

/// Beam numbers of these points of a checked table, from the first of the fields ring, channel,
/// line. Ignores the field unless all values are integers from 0 to 65535.
PointFieldValues<std::int32_t> ringsOf(const PointTable& table,
                                       const std::vector<std::uint32_t>& points);

/// The first of the fields time, t, timestamp, time_stamp, offset_time, time_offset, gps_time,
/// gpstime; null if there is none.
const PointField* timeFieldOf(const PointTable& table);

/// Times of these points of a checked table [s], from timeFieldOf(). Unwraps uint32. Times from 0
/// to 1 are shares of the time between scans, `period_s` (0: unknown), if that is about 0.1 s;
/// unless it is longer, they get a remark. Otherwise guesses the unit: integers are nanoseconds, or
/// microseconds if the points would otherwise span less than 1 ms. Other numbers are seconds, or
/// the largest of ms, us, ns in which they span at most 2 s; gps_time is always in seconds. Times
/// within 2 s of 0 are relative to the scan's time; others are absolute and converted to times
/// relative to the earliest. Ignores the field if a time is not finite or the times span more than
/// 2 s.
PointFieldValues<float> timesOf(const PointTable& table, const std::vector<std::uint32_t>& points,
                                double period_s = 0);

/// Remarks on fields that look like beam numbers, times or intensities by their names and values,
/// if no field with a known name is there instead.
std::vector<std::string> remarksOnLookAlikes(const PointTable& table);

/// The first of the fields intensity, i, reflectivity, remission; null if there is none.
const PointField* intensityFieldOf(const PointTable& table);

}  // namespace hagen::observations
