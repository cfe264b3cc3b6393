#pragma once
#include <hagen/observations/PointTable.h>
#include <mrpt/maps/CPointsMap.h>

#include <string>
#include <vector>

namespace hagen::observations {

/// Makes logs of MRPT from 2.15 to 3 readable by older ones: their CGenericPointsMap, and
/// CSimplePointsMap with their insertion options. Such clouds are read as CPointsMapXYZI and
/// CSimplePointsMap, and written as these. Does nothing with an MRPT that knows them. Call it once,
/// after MRPT's own classes are registered (registerMrptClasses()).
void registerNewerClouds();

/// The fields of a cloud that was read as a CGenericPointsMap other than coordinates and intensity.
/// They are not kept when it is written.
std::vector<std::string> fieldsNotKept(const mrpt::maps::CPointsMap& cloud);
/// The same fields with their numbers, a point of the table for each of the cloud; those with
/// another number of values are left out. Null if it was read as another class.
const PointTable* otherFieldsOf(const mrpt::maps::CPointsMap& cloud);

}  // namespace hagen::observations
