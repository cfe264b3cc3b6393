#pragma once
#include <hagen/avoidance/Distance.h>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// What is flown past to measure clearances: a wall, and poles with the radii of trunks.
const std::vector<std::string>& measuredObstacles();
/// "pole" for all poles, "wall".
std::string kindOf(const std::string& obstacle);

struct ClearanceMeasurement {
    std::vector<std::string> models;  ///< that need no truth
    std::uint64_t first_seed = 0, last_seed = 0;
    ModelDistance distance = ModelDistance::AsStored;
    bool has_specks = false;  ///< whether models get the returns of dust, too
    std::function<void(std::uint64_t seed)> doing = {};  ///< called before each seed
    std::function<void()> continuing = {};               ///< called after each scan; may throw
};

/// What a model makes of the distances to an obstacle.
struct ClearanceErrors {
    std::string model, obstacle;
    std::vector<double> errors_m;  ///< the model's clearance minus the true one
    int missed = 0;                ///< queries for which the model knew nothing within 1 m more
};

/// For each seed and obstacle, a VLP-16 flies past at 4 m/s, weaving a little, with the sensor
/// errors of dusty air and true poses. All models take in the same scans. After the first second,
/// they are queried after each scan at random points that the sensor sees, 0.3 to 1.5 m from the
/// obstacle and within 0.5 m of flight altitude. One entry per model and obstacle, in this order.
/// Throws std::invalid_argument for unknown names and for models that need the truth.
std::vector<ClearanceErrors> measureClearances(const ClearanceMeasurement& measurement);

struct ErrorSpread {
    int queries = 0, missed = 0;
    double mean_m, median_m, deviation_m, p05_m, p95_m;  ///< without those missed
};
/// Over all obstacles of a kind: "wall", "pole", or one of measuredObstacles().
ErrorSpread spreadOf(const std::vector<ClearanceErrors>& all, const std::string& model,
                     const std::string& kind);

/// The mean error over walls and poles with equal weight.
double biasOf_m(const std::vector<ClearanceErrors>& all, const std::string& model);

/// Tables by model and kind: Markdown in centimetres, CSV in metres with every obstacle.
std::string clearanceMarkdown(const std::vector<ClearanceErrors>& all);
std::string clearanceCsv(const std::vector<ClearanceErrors>& all);

/// The lines of libs/avoidance/DistanceBias.cpp.
std::string biasTable(const std::vector<ClearanceErrors>& all);

}  // namespace hagen::avoidance
