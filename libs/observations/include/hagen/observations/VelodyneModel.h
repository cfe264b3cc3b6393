#pragma once
#include <hagen/range_image/SensorModel.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::observations {

/// How a Velodyne sensor fires, as its manual tells; shared by the packet decoder and encoder. A
/// packet holds 12 blocks, a block 32 returns: the lasers of one firing after the other.
struct VelodyneModel {
    std::string name;         ///< as in settings: "VLP-16"
    std::uint8_t id;          ///< product id in the packet's last byte
    int lasers;               ///< returns of one firing
    int firings_per_block;    ///< lasers * firings_per_block = 32
    double laser_period_us;   ///< from one laser of a firing to the next
    double firing_period_us;  ///< from one firing to the next
    std::string calibration;  ///< its name in mrpt::obs::VelodyneCalibration

    double blockPeriodUs() const { return firings_per_block * firing_period_us; }
    /// Where in its block's rotation a laser fires: 0 with the block's azimuth, 1 with the next
    /// one's.
    double turnWithinBlock(int firing, int laser) const {
        return (firing * firing_period_us + laser * laser_period_us) / blockPeriodUs();
    }
};

/// The model with this product id (VLP-16 0x22, HDL-32E 0x21), or nullptr.
const VelodyneModel* findVelodyneModel(std::uint8_t id);
/// The model with this name. Throws std::invalid_argument for others than VLP-16 and HDL-32E.
const VelodyneModel& velodyneModel(const std::string& name);

/// The direction of a packet's azimuth reading (0.01 degrees, fractions allowed): degrees clockwise
/// from x, within +-180. As MRPT's own decoder has it, so that clouds of both lie on one another:
/// it spreads the 36000 readings over a whole turn with both ends in it, and so points 0 to 0.01
/// degrees ahead.
double azimuthOfReadingDeg(double reading);

/// MRPT's default calibration of a model. May be called from several threads.
const mrpt::obs::VelodyneCalibration& defaultCalibration(const VelodyneModel& model);

/// The image row of a laser, and of each (row 0 the lowest beam), by the calibration's elevations.
std::uint8_t rowOfLaser(const mrpt::obs::VelodyneCalibration& calibration, std::size_t laser);
std::vector<std::uint8_t> rowsOfLasers(const mrpt::obs::VelodyneCalibration& calibration);

/// The elevations of the calibration's beams, lowest first.
void beamsOf(const mrpt::obs::VelodyneCalibration& calibration, std::vector<float>& elevations_rad);

/// The calibration's beams as a sensor, lowest first. Range limits are those of SensorModel.
SensorModel sensorOf(const mrpt::obs::VelodyneCalibration& calibration, const std::string& name);

}  // namespace hagen::observations
