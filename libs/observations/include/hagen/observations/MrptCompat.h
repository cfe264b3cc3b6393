#pragma once
// Aliases for classes that differ between MRPT 2.5 and later versions.
#include <hagen/observations/NewerClouds.h>
#include <hagen/observations/RotatingScan.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/registerAllClasses.h>

namespace hagen::observations {

/// Registers every class of mrpt-obs and mrpt-maps so that it can be read from a rawlog. Linking
/// the libraries is not enough: the linker drops a library without referenced symbols.
inline void registerMrptClasses() {
    // Once: a later call, for another rawlog, must not touch the registry while threads use it.
    static const bool is_done = [] {
        mrpt::obs::registerAllClasses_mrpt_obs();
        mrpt::maps::registerAllClasses_mrpt_maps();
        registerNewerClouds();
        registerNewerScans();
        return true;
    }();
    static_cast<void>(is_done);
}

/// The cloud class that every MRPT from 2.5 to 3 can read.
using PortableCloud = mrpt::maps::CSimplePointsMap;
/// The cloud class with intensities.
using IntensityCloud = mrpt::maps::CPointsMapXYZI;

}  // namespace hagen::observations
