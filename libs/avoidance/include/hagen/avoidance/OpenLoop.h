#pragma once
#include <hagen/avoidance/FreeDirections.h>
#include <hagen/avoidance/LoggedScans.h>
#include <hagen/avoidance/WorldModel.h>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// An open-loop comparison: all world models process the same scans of a recorded log.
struct OpenLoop {
    LogSource source;
    std::vector<std::string> models;

    /// The scene that the log was simulated in (rawlog-simulate), used as ground truth. Otherwise,
    /// ground truth comes from later scans (LaterScansTruth).
    struct SimulatedScene {
        std::string scenario;
        std::uint64_t seed = 1;
    };
    std::optional<SimulatedScene> scene;

    std::function<std::unique_ptr<WorldModel>(const std::string&, const WorldModelSetting&)> make =
        makeWorldModel;
};

/// The result of a model for a scan. Does not depend on the machine.
struct OpenLoopRow {
    std::size_t scan = 0;  ///< number of the processed scan, from 0
    std::size_t entry = 0;
    double time_s = 0;
    std::string model;
    std::size_t returns = 0, roi = 0;  ///< returns and RoI returns of the scan
    std::size_t obstacles = 0;         ///< points or voxels in the model
    std::size_t bytes = 0;             ///< memory of the model
    std::size_t blocked = 0;           ///< blocked directions in the model
    std::size_t truly_blocked = 0;     ///< blocked directions in the ground truth
    DirectionCounts all, level;        ///< `level`: without downward directions
};

/// The cost on this machine: CPU time of the thread, and heap.
struct OpenLoopCost {
    double filter_ms = 0;   ///< labelling the scan, the same for all models
    double update_ms = 0;   ///< updating the model
    double queries_ms = 0;  ///< querying all directions
    double heap_bytes = 0;  ///< heap of the model
};

/// A model's results over the whole log.
struct OpenLoopModel {
    std::string name;
    std::vector<double> obstacles, bytes, blocked;  ///< one entry per scan
    DirectionCounts all, level;
    std::array<DirectionCounts, kDirectionElevations> by_elevation;  ///< lowest first
    std::vector<double> update_ms, queries_ms;
    double peak_heap_bytes = 0;
};

struct OpenLoopResult {
    std::size_t scans = 0;                                     ///< processed scans
    std::size_t scans_without_pose = 0, unreadable_scans = 0;  ///< skipped scans
    std::string why_unreadable;                                ///< first error, or empty
    std::vector<std::string> remarks;                          ///< remarks about the log as a whole
    std::size_t scans_placed_by_one_pose = 0;                  ///< see LoggedScan
    std::size_t model_resets = 0;  ///< resets because the vehicle neared the border of the maps
    std::string poses;
    bool poses_have_horizon = true;
    std::vector<double> returns, roi, filter_ms;  ///< one entry per scan
    std::vector<OpenLoopModel> models;
    /// Mean Jaccard index of the free directions, for each pair of models.
    std::vector<std::vector<double>> agreement;
};

struct OpenLoopListener {
    std::function<void(const OpenLoopRow&, const OpenLoopCost&)> row = [](auto&, auto&) {};
    std::function<void(std::size_t scans_done, std::size_t scans)> progress = [](auto, auto) {};
    std::function<bool()> keep_going = [] { return true; };
};

/// The log is truncated, or the listener stopped the comparison. `result` covers the scans
/// processed so far.
struct OpenLoopEnded : std::runtime_error {
    OpenLoopEnded(const std::string& why, OpenLoopResult processed)
        : std::runtime_error(why), result(std::move(processed)) {}
    OpenLoopResult result;
};

/// Throws std::invalid_argument if a model is unknown or listed twice, if the scenario is unknown,
/// or if the oracle is listed without a scene.
void checkOpenLoop(const OpenLoop& open_loop);

/// Runs all models on a log. After each scan, every model is queried in all directions around the
/// vehicle; the answers are compared with the ground truth and among the models.
///
/// Maps cover a box: the whole flight and 20 m around it if that is at most 100 000 m3, otherwise
/// 60 x 60 x 20 m around the vehicle. When the vehicle nears the border of the latter, all models
/// are reset around it and process the last 3 s again, which is not timed.
///
/// Throws like checkOpenLoop(); std::runtime_error like LoggedScans, and if the log's obstacles do
/// not match the scene; OpenLoopEnded.
OpenLoopResult runOpenLoop(const OpenLoop& open_loop, const OpenLoopListener& listener = {});

}  // namespace hagen::avoidance
