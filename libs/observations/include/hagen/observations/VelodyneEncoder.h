#pragma once
#include <hagen/observations/VelodyneModel.h>
#include <hagen/range_image/Image.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <cstdint>
#include <vector>

namespace hagen::observations {

/// What a Velodyne measured over some firings: an array entry (laser, firing), lasers in the order
/// in which they fire (not by elevation).
struct Firings {
    Image<float> range_m;             ///< NaN or 0: nothing came back
    Image<float> intensity;           ///< 0..1
    Image<float> last_range_m;        ///< dual mode: the farther return; empty: strongest mode
    double first_azimuth_deg = 0;     ///< of the first firing, clockwise from x
    double azimuth_step_deg = 0.2;    ///< from one firing to the next
    std::uint32_t first_time_us = 0;  ///< since the full hour
};

/// The azimuth at which a laser of a firing points, degrees clockwise from x, as the decoder finds
/// it (up to rounding): where to look for a range to encode.
double firingAzimuthDeg(const VelodyneModel& model, const Firings& firings, int laser, int firing);

/// Makes raw packets, the mirror of decodePackets(). Ranges are rounded to 2 mm; those that a
/// packet cannot hold (131.07 m and more) become no return, as the sensor would have it. The last
/// packet is filled up with firings without returns. Throws std::invalid_argument where array sizes
/// differ or do not fit the model.
std::vector<mrpt::obs::CObservationVelodyneScan::TVelodyneRawPacket> encodePackets(
    const VelodyneModel& model, const Firings& firings);

/// A whole observation of these firings, with the model's default calibration.
mrpt::obs::CObservationVelodyneScan::Ptr encodeScan(const VelodyneModel& model,
                                                    const Firings& firings);

}  // namespace hagen::observations
