#pragma once
#include <hagen/avoidance/WorldModel.h>
#include <hagen/openloop/FreeDirections.h>
#include <hagen/openloop/LoggedScans.h>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hagen::openloop {

/// World models that digest the scans of a recorded log, all of them the same.
struct OpenLoop {
    LogSource source;
    std::vector<std::string> models;

    /// The scene that a log was simulated in (rawlog-simulate): the truth. Without it, later scans
    /// are (LaterScansTruth).
    struct TrueScene {
        std::string scenario;
        std::uint64_t seed = 1;
    };
    std::optional<TrueScene> scene;

    std::function<std::unique_ptr<avoidance::WorldModel>(const std::string&,
                                                         const avoidance::WorldModelSetting&)>
        make = avoidance::makeWorldModel;
};

/// What a model made of a scan. Does not depend on the machine.
struct OpenLoopRow {
    std::size_t scan = 0;  ///< from 0, of those digested
    std::size_t entry = 0;
    double time_s = 0;
    std::string model;
    std::size_t returns = 0, roi = 0;  ///< of the scan
    std::size_t obstacles = 0;         ///< that the model holds: points, or voxels
    std::size_t bytes = 0;             ///< of the model
    std::size_t blocked = 0;           ///< directions
    std::size_t truly_blocked = 0;     ///< of those scored
    DirectionCounts all, level;        ///< `level`: directions that do not lead down
};

/// What this machine took for it: CPU time of the thread, and the heap.
struct OpenLoopCost {
    std::size_t scan = 0;
    std::string model;
    double filter_ms = 0;   ///< of the scan, whatever the model
    double update_ms = 0;   ///< of the model
    double queries_ms = 0;  ///< all directions asked
    double heap_bytes = 0;  ///< that the model holds
};

/// A model's figures over the log.
struct OpenLoopModel {
    std::string name;
    std::vector<double> obstacles, bytes, blocked;  ///< an entry a scan
    DirectionCounts all, level;
    std::array<DirectionCounts, kDirectionElevations> by_elevation;  ///< from the lowest
    std::vector<double> update_ms, queries_ms;
    double peak_heap_bytes = 0;
};

struct OpenLoopResult {
    std::size_t scans = 0;                                     ///< digested
    std::size_t scans_without_pose = 0, unreadable_scans = 0;  ///< left out
    std::size_t scans_moved_whole = 0;                         ///< placed by one pose each
    std::size_t maps_begun_anew = 0;  ///< the vehicle came near the border of their box
    std::string poses;
    bool poses_have_horizon = true;
    std::vector<double> returns, roi, filter_ms;  ///< an entry a scan
    std::vector<OpenLoopModel> models;
    /// Mean agreement on free directions (Jaccard), model by model.
    std::vector<std::vector<double>> agreement;
};

struct OpenLoopListener {
    std::function<void(const OpenLoopRow&, const OpenLoopCost&)> row = [](auto&, auto&) {};
    std::function<void(std::size_t scans_done, std::size_t scans)> progress = [](auto, auto) {};
    std::function<bool()> keep_going = [] { return true; };
};

/// A log that ended early: it breaks off, or the listener ended it. What was digested before is
/// whole.
struct OpenLoopEnded : std::runtime_error {
    OpenLoopEnded(const std::string& why, OpenLoopResult digested)
        : std::runtime_error(why), result(std::move(digested)) {}
    OpenLoopResult result;
};

/// Throws std::invalid_argument for a model that is unknown, or named twice, an unknown scenario,
/// and an oracle without a scene.
void checkOpenLoop(const OpenLoop& open_loop);

/// Lets world models digest a log. After each scan, every model is asked for all directions around
/// the vehicle; what it answers is held against the truth, and against the other models.
///
/// Maps lie within a box: all of the flight and 20 m around it, where that is at most 100 000 m3;
/// else 60 x 60 x 20 m around the vehicle. Where it comes near the border of that, all models are
/// begun anew around it, and digest the last 3 s again, which is not counted.
///
/// Throws as checkOpenLoop() does; std::runtime_error as LoggedScans does, and where the log's
/// obstacles are not those of the scene; OpenLoopEnded.
OpenLoopResult runOpenLoop(const OpenLoop& open_loop, const OpenLoopListener& listener = {});

}  // namespace hagen::openloop
