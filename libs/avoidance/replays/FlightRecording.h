#pragma once
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/Trial.h>
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>
#include "avoidance/flights/RunTable.h"
#include "avoidance/replays/TrueScene.h"

namespace hagen::avoidance {

/// How a flight ended: "hit a tree at 7.42 s: 0.28 m from the vehicle's centre".
/// `speed_m_s` is the maximum speed of the run, `end_m` the vehicle's last position.
std::string endingOf(const Course& course, const TrialResult& result, double speed_m_s,
                     const Eigen::Vector3d& end_m);

/// A voxel or point of the world model, present in the steps [from_step, until_step).
struct ModelCell {
    Eigen::Vector3f centre_m;
    int from_step, until_step;
};

struct RecordedMotion {
    std::vector<Eigen::Vector3f> path_m;
    bool is_free;
};

/// A planning step, thinned for visualization.
struct RecordedStep {
    double time_s, latency_ms;
    Eigen::Vector3d command_m_s, carrot_m;
    bool is_emergency;
    std::size_t model_size;                     ///< total voxels or points in the model
    std::vector<Eigen::Vector3f> roi_m, rou_m;  ///< returns of the scan
    std::vector<Eigen::Vector3f> path_m;        ///< path of the guidance
    std::vector<RecordedMotion> motions;
};

/// The vehicle's true state.
struct RecordedMoment {
    Eigen::Vector3d at_m;
    double speed_m_s, clearance_m;
};

struct RecordedEvent {
    double time_s;
    std::string what;
};

/// A whole run, small enough for a web page.
struct FlightRecording {
    Run run{};
    bool is_same = false;  ///< the run was reproduced exactly
    Eigen::Vector3d start_m{0, 0, 0}, goal_m{0, 0, 0};
    double ground_m = 0;  ///< height of the ground below the start
    std::vector<RecordedStep> steps;
    std::vector<RecordedMoment> track;  ///< every kControlStep_s until the end of the flight
    std::string ending;                 ///< from endingOf()
    TrueScene scene;
    std::vector<ModelCell> model;
    float model_edge_m = 0;  ///< edge of a cell; 0 for points
    std::vector<RecordedEvent> events;
};

struct FlightRecordingLimits {
    std::size_t full_steps = 150;  ///< longer runs keep fewer points per step
    std::size_t points = 2500;     ///< per label and step
    std::size_t motions = 60;      ///< per step
    std::size_t cells = 150000;    ///< in the model's history
    float point_grid_m = 0.1f;     ///< point models: one point per cube of this size
    float reach_m = 25;            ///< maximum range of stored returns
};

/// Repeats the flight and records it. Throws like makeCourse() and runTrial(), and exceptions of
/// `continuing`, which is called at each planning step.
FlightRecording record(
    const Run& run, const LatencyProfile& profile, const FlightRecordingLimits& limits = {},
    const std::function<void()>& continuing = [] {});

}  // namespace hagen::avoidance
