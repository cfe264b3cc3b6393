#include "ScanObject.h"

#include <hagen/observations/MrptCompat.h>
#include <mrpt/obs/CObservationPointCloud.h>

namespace hagen::logs {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationPointCloud;

mrpt::serialization::CSerializable::Ptr objectOf(
    const CObservation::Ptr& scan, const std::optional<observations::CloudClass>& cloud_class) {
    const auto cloud = std::dynamic_pointer_cast<CObservationPointCloud>(scan);
    if (!cloud) return scan;
    if (!cloud_class) return nullptr;
    auto copy = CObservationPointCloud::Create(*cloud);
    if (*cloud_class == observations::CloudClass::Simple) {
        const auto points = observations::PortableCloud::Create();
        const mrpt::maps::CPointsMap& all = *cloud->pointcloud;
        points->setSize(all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            points->setPointFast(i, all.getPointsBufferRef_x()[i], all.getPointsBufferRef_y()[i],
                                 all.getPointsBufferRef_z()[i]);
        }
        points->mark_as_modified();
        copy->pointcloud = points;
    }
    return copy;
}

}  // namespace hagen::logs
