#pragma once
#include <hagen/mrpt/PointTable.h>

#include <cstdint>
#include <string>
#include <vector>

/// What fields of a cloud mean by their names, without regard to case.
namespace hagen::observations {

/// Numbers of the beams of points, or their times, with what is wrong with the field.
template <class Number>
struct PointFieldValues {
    std::vector<Number> values;  ///< one per point that was asked for; empty: not known
    std::string field;           ///< that they are from; empty: there is none, or it is not used
    std::string remark;          ///< why the field is not used; empty: it is, or there is none
};

/// Numbers of the beams of these points, from the first of the fields ring, channel, line: whole
/// numbers from 0 to 65535, otherwise the field is not used. The table is checked.
PointFieldValues<std::int32_t> ringsOf(const PointTable& table,
                                       const std::vector<std::uint32_t>& points);

/// The first of the fields time, t, timestamp, time_stamp, offset_time, time_offset, gps_time,
/// gpstime; null if there is none.
const PointField* timeFieldOf(const PointTable& table);

/// When these points were measured [s], from timeFieldOf(). The unit is not in the files. Integers
/// are nanoseconds, as of Ouster and Livox, or microseconds if the points otherwise take less than
/// a millisecond. Other numbers are seconds, or the greatest of ms, us, ns in which they take at
/// most 2 s; those of a gps_time are seconds always. Times within 2 s of 0 are relative to the
/// scan's time; others are absolute and count from the earliest. If one is not finite, or if they
/// span more than 2 s, the field is not used. The table is checked.
PointFieldValues<float> timesOf(const PointTable& table, const std::vector<std::uint32_t>& points);

}  // namespace hagen::observations
