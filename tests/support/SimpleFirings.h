#pragma once
#include "mrpt/VelodyneEncoder.h"

#include "support/SimpleScene.h"

namespace hagen::test {

/// The azimuth of a laser in a firing, clockwise from x, as decoded (up to rounding).
double firingAzimuthDeg(const sensors::VelodyneModel& model, const observations::Firings& firings,
                        int laser, int firing);

/// The measurements of a level Velodyne during a full revolution of 0.1 s, starting at `position_m`
/// and moving at `velocity_m_s`. Omits returns beyond `range_limit_m`.
observations::Firings fireAt(const SimpleScene& scene, const sensors::VelodyneModel& model,
                             const Eigen::Vector3d& position_m,
                             const Eigen::Vector3d& velocity_m_s = Eigen::Vector3d::Zero(),
                             double range_limit_m = 100.0);

std::vector<std::string> packetsOf(const sensors::VelodyneModel& model,
                                   const observations::Firings& firings);

/// Packets of several turns of a static sensor 2 m above the scene's ground.
std::vector<std::string> turnsOf(const SimpleScene& scene, const sensors::VelodyneModel& model,
                                 int turns, std::uint32_t first_us = 1000000, bool is_dual = false);

/// The packets that a VLP-16 sends if it is configured to be silent in a sector, clockwise from
/// `from_deg`: the other blocks, 12 per packet, whose times are those of their first blocks.
std::vector<std::string> withSilentSector(const std::vector<std::string>& packets, double from_deg,
                                          double width_deg);

/// A VLP-16 scan of a pole at (12, 2) on flat ground, measured from (x_m, 0, 2), x_m seconds after
/// a fixed time.
mrpt::obs::CObservationVelodyneScan::Ptr poleScanFrom(double x_m, const std::string& label);

}  // namespace hagen::test
