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

#include <cstddef>
#include <cstdlib>
#include <new>

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

/// Throws std::bad_alloc if there is no memory for the coordinates of so many points: MRPT's own
/// allocation does not look, and crashes. Another thread may take the memory in between.
inline void checkMemoryFor(std::size_t points) {
    constexpr std::size_t kColumns = 6, kBesides = 1 << 16;  // with those of derived classes
    // Volatile: compilers take an unused allocation for one that succeeds.
    void* volatile memory = std::malloc(kColumns * sizeof(float) * points + kBesides);
    if (memory == nullptr) throw std::bad_alloc();
    std::free(memory);
}

/// The cloud class that every MRPT from 2.5 to 3 can read.
using PortableCloud = mrpt::maps::CSimplePointsMap;
/// The cloud class with intensities.
using IntensityCloud = mrpt::maps::CPointsMapXYZI;

}  // namespace hagen::observations
