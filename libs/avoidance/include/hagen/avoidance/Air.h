#pragma once
#include <hagen/scan/Airframe.h>
#include <hagen/simulation/Lidar.h>
#include <string>

namespace hagen::avoidance {

/// What the LiDAR meets besides the scene.
///
///     dusty  the standard errors of the simulation: 1.5e-5 specks of dust per metre of a beam,
///            15 % mixed ranges at edges, and the vehicle's own legs, which the settings mask
///     clear  none of these
enum class Air { Dusty, Clear };

/// "dusty", "clear".
std::string nameOf(Air air);
/// Throws std::invalid_argument, naming the known ones.
Air airFrom(const std::string& name);

/// The LiDAR's faults in a trial: 2 cm of noise, 1 % of returns lost, thin wires missed more often
/// with distance, and those of the air.
simulation::SensorErrorModel trialErrorModel(Air air);

/// The vehicle's own parts as its settings mask them: those of config/airframe_simulated.yaml. None
/// in clear air, where the sensor does not see them.
Airframe trialAirframe(Air air);

}  // namespace hagen::avoidance
