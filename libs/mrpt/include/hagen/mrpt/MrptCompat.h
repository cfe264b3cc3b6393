#pragma once
// Differences between MRPT 2.5 and later versions up to 3; scenes are in MrptScene.h.
#include <hagen/mrpt/NewerClouds.h>
#include <hagen/mrpt/RotatingScan.h>
#include <mrpt/core/aligned_std_vector.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/registerAllClasses.h>
#include <mrpt/version.h>

// 0x258 is 2.5.8, 0x020f00 is 2.15.0.
#if MRPT_VERSION < 0x020f00
#include <mrpt/maps/CPointsMapXYZI.h>
#else
#include <mrpt/maps/CGenericPointsMap.h>
#endif

#include <cstddef>
#include <vector>

namespace hagen::observations {

/// Registers every class of mrpt-obs and mrpt-maps so that it can be read from a rawlog. Linking
/// the libraries is not enough, because the linker drops libraries without referenced symbols.
inline void registerMrptClasses() {
    // Registers only once, because later calls must not modify the registry while threads use it.
    static const bool is_done = [] {
        mrpt::obs::registerAllClasses_mrpt_obs();
        mrpt::maps::registerAllClasses_mrpt_maps();
        registerNewerClouds();
        registerNewerScans();
        return true;
    }();
    static_cast<void>(is_done);
}

/// The cloud class that all versions of MRPT from 2.5 to 3 can read.
using PortableCloud = mrpt::maps::CSimplePointsMap;
/// The cloud class with intensities: CPointsMapXYZI before 2.15, then the generic class, because
/// MRPT 3 reads no other cloud with intensities.
#if MRPT_VERSION < 0x020f00
using IntensityCloud = mrpt::maps::CPointsMapXYZI;
#else
class IntensityCloud : public mrpt::maps::CGenericPointsMap {
 public:
    IntensityCloud() { registerField_float("intensity"); }
    void setPointIntensity(std::size_t i, float intensity) {
        setPointField_float(i, "intensity", intensity);
    }
};
#endif

/// The intensity of each point; null if unknown.
inline const mrpt::aligned_std_vector<float>* intensitiesOf(const mrpt::maps::CPointsMap& cloud) {
#if MRPT_VERSION < 0x020f00
    const auto* const with_intensity = dynamic_cast<const IntensityCloud*>(&cloud);
    return with_intensity ? &with_intensity->getPointsBufferRef_intensity() : nullptr;
#else
    return cloud.getPointsBufferRef_float_field("intensity");
#endif
}

/// Deletes the points whose flag is set, with all their fields.
inline void deletePoints(const std::vector<bool>& is_deleted, mrpt::maps::CPointsMap& cloud) {
#if MRPT_VERSION < 0x020f00
    cloud.applyDeletionMask(is_deleted);
#else
    const mrpt::rtti::CObject::Ptr copy = cloud.duplicateGetSmartPtr();
    const auto& all = dynamic_cast<const mrpt::maps::CPointsMap&>(*copy);
    cloud.clear();
    cloud.registerPointFieldsFrom(all);
    const auto fields = cloud.prepareForInsertPointsFrom(all);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (is_deleted[i]) continue;
#if MRPT_VERSION < 0x020f03
        cloud.insertPointFrom(all, i, fields);
#else
        cloud.insertPointFrom(i, fields);
#endif
    }
    cloud.mark_as_modified();
#endif
}

}  // namespace hagen::observations
