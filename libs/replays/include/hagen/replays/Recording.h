#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "Refly.h"
#include "TrueScene.h"

namespace hagen::replays {

/// A cell of the map, or a point of it, and from which step until before which it was there.
struct ModelCell {
    Eigen::Vector3f middle_m;
    int from_step, until_step;
};

struct RecordedMotion {
    std::vector<Eigen::Vector3f> way_m;
    bool is_free;
};

/// A planning step, thinned out for a picture.
struct RecordedStep {
    double time_s, latency_ms;
    Eigen::Vector3d command_m_s, carrot_m;
    bool is_emergency;
    std::vector<Eigen::Vector3f> roi_m, rou_m;  ///< returns of the scan
    std::vector<Eigen::Vector3f> path_m;        ///< of guidance
    std::vector<RecordedMotion> motions;
};

/// The vehicle as it truly was.
struct RecordedMoment {
    Eigen::Vector3d at_m;
    double speed_m_s, clearance_m;
};

struct RecordedEvent {
    double time_s;
    std::string what;
};

/// A whole run, small enough to be looked at in a page.
struct Recording {
    trials::Run run{};
    bool is_same = false;
    Eigen::Vector3d start_m{0, 0, 0}, goal_m{0, 0, 0};
    double ground_m = 0;  ///< height of the ground below the start
    std::vector<RecordedStep> steps;
    std::vector<RecordedMoment> track;  ///< every kControlStep_s, to the very end of the flight
    std::string ending;                 ///< how it ended, in words
    TrueScene scene;
    std::vector<ModelCell> model;
    float model_edge_m = 0;  ///< of its cells; 0: points
    std::vector<RecordedEvent> events;
};

struct RecordingLimits {
    std::size_t full_steps = 150;  ///< runs of more keep less of each, so that pages stay small
    std::size_t points = 2500;     ///< of each label, a step
    std::size_t motions = 60;      ///< a step
    std::size_t cells = 150000;    ///< of the model
    float point_grid_m = 0.1f;     ///< of models made of points: one in each such cube
    float reach_m = 25;            ///< of points
};

/// Flies the run again, and keeps what can be seen. Throws as flyAgain() does.
Recording record(const trials::Run& run, const trials::LatencyProfile& profile,
                 const RecordingLimits& limits = {});

}  // namespace hagen::replays
