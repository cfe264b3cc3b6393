#pragma once
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <mrpt/maps/CPointsMapXYZI.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace hagen::observations {

/// A cloud whose sensor, beams and times are known, as from the packets of an Ouster. It lives in
/// memory only: MRPT writes it as the CPointsMapXYZI that it is, and the rest is lost.
class LocatedCloud : public mrpt::maps::CPointsMapXYZI {
 public:
    /// Takes coordinates, intensities, rows and times of a scan.
    LocatedCloud(const Scan& scan, std::shared_ptr<const SensorModel> sensor);

    const SensorModel& sensor() const { return *sensor_; }
    const std::vector<std::uint8_t>& rows() const { return rows_; }
    const std::vector<float>& times_s() const { return times_s_; }

 private:
    std::shared_ptr<const SensorModel> sensor_;
    std::vector<std::uint8_t> rows_;
    std::vector<float> times_s_;
};

}  // namespace hagen::observations
