#include <hagen/observations/LocatedCloud.h>

namespace hagen::observations {

LocatedCloud::LocatedCloud(const Scan& scan, std::shared_ptr<const SensorModel> sensor)
    : sensor_(std::move(sensor)), rows_(scan.row), times_s_(scan.time_s) {
    setSize(scan.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
        setPointFast(i, scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        setPointIntensity(i, scan.intensity[i]);
    }
    mark_as_modified();
}

}  // namespace hagen::observations
