#pragma once
// Names for what MRPT 2.5 and later versions have different classes for.
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/registerAllClasses.h>

namespace hagen::observations {

/// Makes every class of mrpt-obs and mrpt-maps readable from a rawlog. Linking the libraries is not
/// enough: the linker drops one of which no symbol is used.
inline void registerMrptClasses() {
    mrpt::obs::registerAllClasses_mrpt_obs();
    mrpt::maps::registerAllClasses_mrpt_maps();
}

/// The cloud class that every MRPT from 2.5 to 3 reads.
using PortableCloud = mrpt::maps::CSimplePointsMap;
/// The one that has intensities.
using IntensityCloud = mrpt::maps::CPointsMapXYZI;

}  // namespace hagen::observations
