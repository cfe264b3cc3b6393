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
        if (!hasPointField("intensity")) registerField_float("intensity");
        setPointField_float(i, "intensity", intensity);
    }
};
#endif

/// MRPT 2.5 returns fields by reference, 2.14 by pointer.
using FloatField = mrpt::aligned_std_vector<float>;
inline const FloatField* pointerTo(const FloatField& field) { return &field; }
inline const FloatField* pointerTo(const FloatField* field) { return field; }

/// The intensity of each point; null if unknown.
inline const FloatField* intensitiesOf(const mrpt::maps::CPointsMap& cloud) {
#if MRPT_VERSION < 0x020f00
    const auto* const with_intensity = dynamic_cast<const IntensityCloud*>(&cloud);
    if (with_intensity == nullptr) return nullptr;
    return pointerTo(with_intensity->getPointsBufferRef_intensity());
#else
    return cloud.getPointsBufferRef_float_field("intensity");
#endif
}

#if MRPT_VERSION >= 0x020f00
/// Appends the points whose flag is set, with all their fields.
inline void appendPoints(const mrpt::maps::CPointsMap& from, const std::vector<bool>& is_chosen,
                         mrpt::maps::CPointsMap& to) {
    to.registerPointFieldsFrom(from);
    const auto fields = to.prepareForInsertPointsFrom(from);
    for (std::size_t i = 0; i < from.size(); ++i) {
        if (is_chosen[i]) to.insertPointFrom(i, fields);
    }
    to.mark_as_modified();
}
#endif

/// Deletes the points whose flag is set, with all their fields.
inline void deletePoints(const std::vector<bool>& is_deleted, mrpt::maps::CPointsMap& cloud) {
#if MRPT_VERSION < 0x020f00
    cloud.applyDeletionMask(is_deleted);
#else
    const mrpt::rtti::CObject::Ptr all = cloud.duplicateGetSmartPtr();
    cloud.clear();
    std::vector<bool> is_kept = is_deleted;
    is_kept.flip();
    appendPoints(dynamic_cast<const mrpt::maps::CPointsMap&>(*all), is_kept, cloud);
#endif
}

}  // namespace hagen::observations
