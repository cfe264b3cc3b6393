#include <hagen/mrpt/LocatedCloud.h>

#include <stdexcept>
#include <utility>

namespace hagen::observations {

LocatedCloud::LocatedCloud(const Scan& scan, std::shared_ptr<const SensorModel> sensor,
                           PointTable other_fields)
    : sensor_(std::move(sensor)),
      rows_(scan.row),
      times_s_(scan.time_s),
      other_fields_(std::move(other_fields)) {
    if (!other_fields_.fields.empty() && other_fields_.points != scan.size()) {
        throw std::invalid_argument("the fields of a cloud differ in size");
    }
    setSize(scan.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
        setPointFast(i, scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        setPointIntensity(i, scan.intensity[i]);
    }
    mark_as_modified();
}

}  // namespace hagen::observations
