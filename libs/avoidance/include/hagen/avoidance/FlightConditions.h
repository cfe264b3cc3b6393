#pragma once
#include <string>

/// The named conditions of a flight in flags and runs.csv. Each ...From() is the inverse of
/// nameOf() and throws std::invalid_argument, listing the known names.
namespace hagen::avoidance {

/// Error of the estimated pose (details in PoseBelief.h): "none", "noise", "drift".
enum class PoseError { None, Noise, Drift };
std::string nameOf(PoseError error);
PoseError poseErrorFrom(const std::string& name);

/// Disturbances of the LiDAR.
///
///     dusty  the default errors of the simulation: 1.5e-5 dust specks per metre of beam,
///            15 % mixed ranges at edges, and the vehicle's own legs, which the settings mask
///     clear  no disturbances
enum class Air { Dusty, Clear };
std::string nameOf(Air air);
Air airFrom(const std::string& name);

/// The distances that a world model returns: "unbiased", "as-stored". Models measure to different
/// geometry: windows to thinned points, maps to the faces of voxels. Unbiased distances are
/// corrected by the measured mean error.
enum class ModelDistance { Unbiased, AsStored };
std::string nameOf(ModelDistance distance);
ModelDistance distanceFrom(const std::string& name);

/// When the world model is updated.
///
///     scans    whole scans, each when the sensor's turn is complete: 10 Hz
///     sectors  sectors of 15 degrees, labelled by a StreamingSegmenter, each after its last
///              packet; the planner runs at 50 Hz, on all sectors since its last run
enum class Updates { Scans, Sectors };
std::string nameOf(Updates updates);
Updates updatesFrom(const std::string& name);

/// "success", "collision", "timeout".
enum class Outcome { Success, Collision, Timeout };
std::string nameOf(Outcome outcome);
Outcome outcomeFrom(const std::string& name);

}  // namespace hagen::avoidance
