#pragma once
#include <hagen/scan/Image.h>
#include <hagen/sensors/VelodyneModel.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <cstdint>
#include <vector>

namespace hagen::observations {

/// Measurements of a Velodyne in several firings, as arrays (laser, firing), with lasers in firing
/// order.
struct Firings {
    Image<float> range_m;             ///< NaN or 0 if there is no return
    Image<float> intensity;           ///< 0..1
    Image<float> last_range_m;        ///< the farther return in dual mode; empty in strongest mode
    double first_azimuth_deg = 0;     ///< azimuth of the first firing, clockwise from x
    double azimuth_step_deg = 0.2;    ///< angle from a firing to the next
    std::uint32_t first_time_us = 0;  ///< time of the first firing since the full hour
};

/// Encodes raw packets, the inverse of decodePackets(). Ranges are rounded to the model's unit (2
/// or 4 mm); ranges above the packet's maximum (131.07 or 262.14 m) become missing returns. The
/// last packet is padded. Throws std::invalid_argument if array sizes do not match the model.
std::vector<mrpt::obs::CObservationVelodyneScan::TVelodyneRawPacket> encodePackets(
    const sensors::VelodyneModel& model, const Firings& firings);

/// Returns an observation of these firings, with the model's default calibration.
mrpt::obs::CObservationVelodyneScan::Ptr encodeScan(const sensors::VelodyneModel& model,
                                                    const Firings& firings);

}  // namespace hagen::observations
