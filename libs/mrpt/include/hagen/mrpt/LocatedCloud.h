#pragma once
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/PointTable.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace hagen::observations {

/// A cloud whose sensor, beams and times are known, as from the packets of an Ouster. It lives in
/// memory only: MRPT writes it as the CPointsMapXYZI that it is, and the rest is lost.
class LocatedCloud : public IntensityCloud {
 public:
    /// Takes coordinates, intensities, rows and times of a scan, and what else the sensor tells of
    /// each point. Throws std::invalid_argument if that has fields of another number of points.
    LocatedCloud(const Scan& scan, std::shared_ptr<const SensorModel> sensor,
                 PointTable other_fields = {});

    const SensorModel& sensor() const { return *sensor_; }
    const std::vector<std::uint8_t>& rows() const { return rows_; }
    const std::vector<float>& times_s() const { return times_s_; }
    /// Fields besides these, such as `tag` of a Livox; of no points if there are none.
    const PointTable& otherFields() const { return other_fields_; }

 private:
    std::shared_ptr<const SensorModel> sensor_;
    std::vector<std::uint8_t> rows_;
    std::vector<float> times_s_;
    PointTable other_fields_;
};

}  // namespace hagen::observations
