#pragma once
#include <hagen/simulation/Scene.h>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::simulation {

/// Names of all scenarios:
///
///     orchard      rows of fruit trees, flight between two rows; weeds around the trunks
///     field        crop 0.3 to 0.9 m high, with trees, poles and a hedge in and around it
///     forest-0.02  random trees (number per square metre), bushes, fern
///     forest-0.05, forest-0.10
///     wires        poles and wires of 24 mm along and across the path
///     gap          walls; the path passes through gaps
///     street       parked cars, houses, lamps, trees
///     terrain      slopes up to 15 degrees with rocks and trees
///     u-trap       U-shaped walls, open towards the path
///     movers       people, cars and drones moving among trees
///     hall         walls, pillars and crates on a flat, bare floor; no roof
std::vector<std::string> scenarioNames();

/// Returns the scene of a scenario, identical for a seed on every machine. Throws
/// std::invalid_argument listing the valid names if the name is unknown.
Scene makeScene(const std::string& scenario, std::uint64_t seed);

}  // namespace hagen::simulation
