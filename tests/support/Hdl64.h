#pragma once
#include <Eigen/Core>
#include <functional>

#include "support/CaptureWriter.h"

namespace hagen::test {

/// A laser of an HDL-64E, in the units of its calibration file.
struct Hdl64Laser {
    double rot_deg, vert_deg, dist_cm, vert_offset_cm, horiz_offset_cm;

    /// Origin and direction of the laser beam at a packet's azimuth: x forward, y left, z up. Uses
    /// vectors instead of the manual's formulas, which the decoder uses.
    Eigen::Vector3d origin_m(double azimuth_deg) const;
    Eigen::Vector3d direction(double azimuth_deg) const;
};

/// 64 lasers with corrections of all kinds, upper 32 first.
std::vector<Hdl64Laser> hdl64Lasers();
/// The calibration of these lasers as an XML file, laser 0 first.
std::string hdl64Xml(const std::vector<Hdl64Laser>& lasers = hdl64Lasers());

/// The range along a laser beam; 0 without a return.
using Hdl64Range = std::function<double(int laser, double azimuth_deg)>;
/// The packets of firings from 0 degrees on, every 0.18 degrees (10 Hz).
std::vector<ByteString> hdl64Packets(int firings, const Hdl64Range& range_m);

}  // namespace hagen::test
