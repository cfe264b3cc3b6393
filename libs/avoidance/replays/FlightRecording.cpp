#include "avoidance/replays/FlightRecording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace hagen::avoidance {
namespace {

/// Every n-th item, at most `most` in total.
template <class Item>
std::vector<Item> sampled(const std::vector<Item>& all, std::size_t max) {
    const std::size_t every = (all.size() + max - 1) / std::max<std::size_t>(max, 1);
    std::vector<Item> kept;
    for (std::size_t i = 0; i < all.size(); i += std::max<std::size_t>(every, 1)) {
        kept.push_back(all[i]);
    }
    return kept;
}

void addReturns(const observations::MappedScan& scan, const FlightRecordingLimits& limits,
                RecordedStep& step) {
    const Eigen::Vector3f origin = scan.origin_m.cast<float>();
    for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
        if ((scan.points_m[i] - origin).norm() > limits.reach_m) continue;
        auto& points = scan.labels[i] == Label::Roi ? step.roi_m : step.rou_m;
        points.push_back(scan.points_m[i]);
    }
    step.roi_m = sampled(step.roi_m, limits.points);
    step.rou_m = sampled(step.rou_m, limits.points);
}

void addMotions(const Plan& plan, const FlightRecordingLimits& limits, RecordedStep& step) {
    constexpr std::size_t kPointsOfPath = 8;
    for (const CandidateMotion& motion : sampled(plan.candidates, limits.motions)) {
        RecordedMotion kept{sampled(motion.path_m, kPointsOfPath), motion.is_free};
        if (kept.path_m.empty()) continue;
        kept.path_m.push_back(motion.path_m.back());
        step.motions.push_back(kept);
    }
}

/// Collects the cells of all steps.
class ModelHistory {
 public:
    explicit ModelHistory(const FlightRecordingLimits& limits) : limits_(limits) {}

    void add(const WorldModel::Obstacles& obstacles, int step) {
        edge_m_ = obstacles.edge_m;
        const float grid_m = edge_m_ > 0 ? edge_m_ : limits_.point_grid_m;
        for (const Eigen::Vector3f& centre_m : obstacles.centre_m) {
            std::array<int, 3> key;
            for (int axis = 0; axis < 3; ++axis) {
                key[axis] = static_cast<int>(std::floor(centre_m[axis] / grid_m));
            }
            std::vector<ModelCell>& stays = cells_[key];
            if (!stays.empty() && stays.back().until_step >= step) {
                stays.back().until_step = step + 1;  // the cell remains, or is a duplicate
            } else {
                stays.push_back({centre_m, step, step + 1});
            }
        }
    }
    void writeTo(FlightRecording& recording) const {
        recording.model_edge_m = edge_m_;
        for (const auto& [key, stays] : cells_) {
            recording.model.insert(recording.model.end(), stays.begin(), stays.end());
        }
        recording.model = sampled(recording.model, limits_.cells);
    }

 private:
    const FlightRecordingLimits& limits_;
    float edge_m_ = 0;
    std::map<std::array<int, 3>, std::vector<ModelCell>> cells_;
};

RecordedStep recorded(const TrialStep& step, const WorldModel::Obstacles& obstacles,
                      const FlightRecordingLimits& limits) {
    RecordedStep kept{step.time_s,
                      step.latency_ms,
                      step.plan.command_m_s,
                      step.carrot.at_m,
                      step.plan.is_emergency,
                      obstacles.centre_m.size(),
                      {},
                      {},
                      {},
                      {}};
    for (const Eigen::Vector3d& at : sampled(step.carrot.path_m, 60)) {
        kept.path_m.push_back(at.cast<float>());
    }
    addReturns(step.scan, limits, kept);
    addMotions(step.plan, limits, kept);
    return kept;
}

/// Reduces the points per step of long runs.
void thinLongRun(const FlightRecordingLimits& limits, FlightRecording& recording) {
    const std::size_t steps = recording.steps.size();
    if (steps <= limits.full_steps) return;
    const auto share = [&](std::size_t max) { return max * limits.full_steps / steps; };
    for (RecordedStep& step : recording.steps) {
        step.roi_m = sampled(step.roi_m, share(limits.points));
        step.rou_m = sampled(step.rou_m, share(limits.points));
        step.motions = sampled(step.motions, share(limits.motions));
    }
}

/// Adds true clearances, the ending and the true scene.
void addTruth(const Course& course, const TrialResult& result, FlightRecording& recording) {
    for (std::size_t i = 0; i < recording.track.size(); ++i) {
        RecordedMoment& moment = recording.track[i];
        moment.clearance_m = static_cast<double>(
            course.distance.at(moment.at_m.cast<float>(), kControlStep_s * static_cast<double>(i)));
    }
    recording.ending =
        endingOf(course, result, recording.run.setup.speed_m_s, recording.track.back().at_m);
    recording.scene = trueSceneOf(course.scene, course.bounds_m, result.time_s);
}

}  // namespace

FlightRecording record(const Run& run, const LatencyProfile& profile,
                       const FlightRecordingLimits& limits,
                       const std::function<void()>& continuing) {
    FlightRecording recording;
    recording.run = run;
    ModelHistory model(limits);
    double now_s = 0;
    TrialListener listener;
    listener.keeps_candidates = true;
    listener.step = [&](const TrialStep& step) {
        continuing();
        const WorldModel::Obstacles obstacles = step.world.obstacles();
        model.add(obstacles, static_cast<int>(recording.steps.size()));
        recording.steps.push_back(recorded(step, obstacles, limits));
    };
    listener.moved = [&](double time_s, const VehicleState& state) {
        now_s = time_s;
        recording.track.push_back({state.position_m, state.velocity_m_s.norm(), 0});
    };
    listener.event = [&](const std::string& what) { recording.events.push_back({now_s, what}); };
    const Course course = makeCourse(run.scenario, run.seed);
    Run flown = run;
    flown.result = runTrial(course, run.setup, profile, nullptr, listener);
    flown.oracle_path_m = course.oracle_path_m;
    recording.is_same = rowOf(flown) == rowOf(run);
    recording.start_m = course.start_m;
    recording.goal_m = course.goal_m;
    recording.ground_m =
        course.scene.terrain().height_m(recording.start_m.x(), recording.start_m.y());
    addTruth(course, flown.result, recording);
    model.writeTo(recording);
    thinLongRun(limits, recording);
    return recording;
}

}  // namespace hagen::avoidance
