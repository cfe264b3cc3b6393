#pragma once
#include <hagen/simulation/Scene.h>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::simulation {

/// Names of all scenarios:
///
///     orchard      fruit trees in rows, flown between two rows; weeds at their feet
///     field        crop 0.3 to 0.9 m high, trees, poles and a hedge around and in it
///     forest-0.02  a wood, random trees of that many a square metre, bushes, fern
///     forest-0.05, forest-0.10
///     wires        poles and wires of 24 mm along and across the way
///     gap          walls with gaps that the way leads through
///     street       parked cars, houses, lamps, trees
///     terrain      slopes up to 15 degrees with rocks and trees
///     u-trap       walls in the shape of a U, open towards the way
///     movers       people, cars and drones that move among trees
std::vector<std::string> scenarioNames();

/// The scene of a scenario; a seed makes the same one everywhere.
/// Throws std::invalid_argument, naming the known ones, for any other name.
Scene makeScene(const std::string& scenario, std::uint64_t seed);

}  // namespace hagen::simulation
