#pragma once
#include <hagen/mrpt/PointTable.h>
#include <mrpt/maps/CPointsMap.h>

#include <array>
#include <string>
#include <vector>

namespace hagen::observations {

/// Makes logs of MRPT from 2.15 to 3 readable by older ones: their CGenericPointsMap, and
/// CSimplePointsMap with their insertion options. Such clouds are read as CPointsMapXYZI and
/// CSimplePointsMap, and written as these, unless writeAsGeneric() is called. Does nothing with an
/// MRPT that knows them. Call it once, after MRPT's own classes are registered
/// (registerMrptClasses()).
void registerNewerClouds();

/// The fields of a cloud that was read as a CGenericPointsMap other than coordinates and intensity.
/// They are not kept when it is written.
std::vector<std::string> fieldsNotKept(const mrpt::maps::CPointsMap& cloud);
/// The same fields with their numbers, a point of the table for each of the cloud; those with
/// another number of values are left out. Null if it was read as another class.
const PointTable* otherFieldsOf(const mrpt::maps::CPointsMap& cloud);

/// Fields that RawLogViewer of MRPT from 2.15 on shows as the colours of points: uint8.
constexpr std::array<const char*, 3> kColorFields{"color_r", "color_g", "color_b"};

/// A cloud that is written as a CGenericPointsMap (version 3) with all fields of a table: uint8,
/// uint16, float32 and float64 as they are, other numbers as float64 (above 2^53 rounded), and
/// several numbers per point as fields NAME_0, NAME_1. MRPT before 2.15 cannot read it. The table
/// is checked, in little-endian order, and has x, y, z, and intensity if that is known; it throws
/// std::invalid_argument if a coordinate is missing. The cloud's renderOptions have the colour of
/// its first point.
mrpt::maps::CPointsMap::Ptr genericCloudOf(const PointTable& table);

/// Has a cloud that was read as a CGenericPointsMap written as one again. Others stay as they are.
void writeAsGeneric(mrpt::maps::CPointsMap& cloud);

}  // namespace hagen::observations
