#pragma once
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
/// They are not kept.
std::vector<std::string> fieldsNotKept(const mrpt::maps::CPointsMap& cloud);

}  // namespace hagen::observations
