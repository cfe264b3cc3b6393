#pragma once
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "support/CaptureWriter.h"

namespace hagen::test {

/// A laser of an HDL-64E, in the units of its calibration file.
struct Hdl64Laser {
    double rot_deg, vert_deg, dist_cm, vert_offset_cm, horiz_offset_cm;

    /// Where its light leaves the sensor and where it goes, if the packet's azimuth is this one: x
    /// forward, y left, z up. By vectors, where the decoder has the manual's formulas.
    Eigen::Vector3d origin_m(double azimuth_deg) const;
    Eigen::Vector3d direction(double azimuth_deg) const;
};

/// 64 lasers: the upper 32 first, with corrections of all kinds.
std::vector<Hdl64Laser> hdl64Lasers();
/// Their calibration as an XML file. Laser 0 first.
std::string hdl64Xml(const std::vector<Hdl64Laser>& lasers = hdl64Lasers());

/// The range along a laser's light; 0: no return.
using Hdl64Range = std::function<double(int laser, double azimuth_deg)>;
/// The packets of firings from 0 degrees on, every 0.18 degrees (10 turns per second).
std::vector<ByteString> hdl64Packets(int firings, const Hdl64Range& range_m);

}  // namespace hagen::test
