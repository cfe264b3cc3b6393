#pragma once
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/PointTable.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace hagen::observations {

/// A cloud with known sensor, beams and times, such as from Ouster packets. MRPT writes it
/// without this information.
class LocatedCloud : public IntensityCloud {
 public:
    /// Copies coordinates, intensities, rows and times of a scan, and further fields. Throws
    /// std::invalid_argument if their sizes differ.
    LocatedCloud(const Scan& scan, std::shared_ptr<const SensorModel> sensor,
                 PointTable other_fields = {});

    const SensorModel& sensor() const { return *sensor_; }
    const std::vector<std::uint8_t>& rows() const { return rows_; }
    const std::vector<float>& times_s() const { return times_s_; }
    /// Further fields, such as `tag` of a Livox; may be empty.
    const PointTable& otherFields() const { return other_fields_; }

 private:
    std::shared_ptr<const SensorModel> sensor_;
    std::vector<std::uint8_t> rows_;
    std::vector<float> times_s_;
    PointTable other_fields_;
};

}  // namespace hagen::observations
