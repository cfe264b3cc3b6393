#include <hagen/avoidance/Trial.h>
#include <hagen/avoidance/Vehicle.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include "avoidance/flights/FlightTrace.h"
#include "avoidance/flights/PoseBelief.h"
#include "avoidance/flights/TrialScore.h"
#include "avoidance/flights/TrialSensor.h"
#include "base/Quantile.h"

#include "avoidance/flights/ScanFeed.h"
#include "avoidance/flights/Stopwatch.h"
#include "avoidance/flights/Streams.h"
#include "avoidance/flights/TrialLatencies.h"

namespace hagen::avoidance {
namespace {

double groundHeight_m(const Course& course, const Eigen::Vector3d& at) {
    return course.scene.terrain().height_m(at.x(), at.y());
}

// Sectors arrive more often, but each direction is still measured once per turn.
FlightPace paceOf(const TrialSetup& setup) {
    return {setup.speed_m_s, TrialSensor::kTurn_s, setup.limits};
}

/// One flight, simulated in control steps.
class TrialFlight {
 public:
    TrialFlight(const Course& course, const TrialSetup& setup, const LatencyProfile& profile,
                TrialMeasurement* measurement, const TrialListener& listener)
        : course_(course),
          setup_(setup),
          listener_(listener),
          stopwatch_(measurement),
          feed_(makeFeed(course, setup, perceptionRangeFor_m(paceOf(setup)))),
          belief_(setup.pose_error, course.seed),
          latencies_(course, setup, profile),
          guidance_(makeGuidance(setup.guidance)),
          planner_(makePlanner(setup.planner)),
          state_{course.start_m, Eigen::Vector3d::Zero()},
          trace_(state_) {
        WorldModelSetting world;
        world.bounds_m = course.bounds_m.cast<float>();
        world.true_clearance_m = [this](const Eigen::Vector3f& believed_m, double after_s) {
            return course_.distance.at(believed_m - scan_offset_m_, scan_s_ + after_s);
        };
        world.distance = setup.distance;
        world.pace = paceOf(setup);
        world_ = setup.make_world ? setup.make_world(world) : makeWorldModel(setup.model, world);
    }

    TrialResult fly() {
        TrialJudge judge(course_, setup_.speed_m_s);
        for (int step = 0;; ++step) {
            const double time_s = kControlStep_s * step;
            const auto clearance_m =
                static_cast<double>(course_.distance.at(state_.position_m.cast<float>(), time_s));
            result_.min_clearance_m = std::min(result_.min_clearance_m, clearance_m);
            if (listener_.moved) listener_.moved(time_s, state_);
            const auto outcome =
                judge.judge(state_.position_m, clearance_m, setup_.limits.collision_m, time_s);
            if (outcome) return finish(*outcome, time_s);
            if (step > 0) feed_->receive(step, trace_, belief_);
            const bool is_free = free_s_ < time_s + kControlStep_s;
            if (feed_->isWaiting() && is_free) think(time_s);
            move(time_s);
        }
    }

 private:
    /// Plans with the waiting measurements as soon as the planner is free in this step.
    void think(double time_s) {
        const double start_s = std::max(time_s, free_s_);
        const double taken_s = latencies_.draw_s();
        const double expected_s = latencies_.median_s();
        free_s_ = start_s + taken_s;
        const FedScan fed = feed_->take(trace_, belief_, stopwatch_);
        const observations::MappedScan& scan = fed.scan;
        latency_ms_.push_back(1e3 * (free_s_ - fed.arrived_s));
        scan_s_ = scan.time_s;
        scan_offset_m_ = belief_.offset_m(trace_, scan_s_).cast<float>();
        const std::string prefix = setup_.model + "/";
        const std::string planner = prefix + setup_.guidance + "+" + setup_.planner;
        stopwatch_.time(prefix + "update", [&] { world_->update(scan); });

        const VehicleState now = commands_.advanced(state_, time_s, start_s, setup_.limits);
        VehicleState believed = now;
        believed.position_m += belief_.offset_m(trace_, start_s);
        const double followed_s = start_s + expected_s + setup_.limits.actuation_delay_s;
        const VehicleState then = commands_.advanced(believed, start_s, followed_s, setup_.limits);
        const double ground_m = believed.position_m.z() - altimeter_m(fed.stream, now.position_m);
        const Carrot carrot = stopwatch_.time(prefix + setup_.guidance, [&] {
            return guidance_->carrot(*world_, guidanceTask(then, ground_m));
        });
        const Plan plan = stopwatch_.time(planner, [&] {
            return planner_->plan(*world_,
                                  planningTask(then, followed_s - scan_s_, carrot, ground_m));
        });
        commands_.add(free_s_ + setup_.limits.actuation_delay_s, plan.command_m_s);
        note(plan, now, start_s);
        if (listener_.step) {
            listener_.step({free_s_, scan, *world_, carrot, plan, latency_ms_.back()});
        }
    }

    void move(double time_s) {
        const Eigen::Vector3d before_m_s = state_.velocity_m_s;
        commands_.forgetBefore(time_s);
        state_ = commands_.advanced(state_, time_s, time_s + kControlStep_s, setup_.limits);
        result_.path_m += (state_.position_m - trace_.at(time_s).position_m).norm();
        trace_.add(state_, (state_.velocity_m_s - before_m_s) / kControlStep_s);
    }

    /// Measured height above the ground.
    double altimeter_m(std::uint64_t stream, const Eigen::Vector3d& at) const {
        constexpr double kAltitudeNoise_m = 0.02;
        simulation::Random random(course_.seed, stream);
        return at.z() - groundHeight_m(course_, at) + kAltitudeNoise_m * random.normal();
    }

    GuidanceTask guidanceTask(const VehicleState& state, double ground_m) const {
        GuidanceTask task;
        task.position_m = state.position_m;
        task.goal_m = course_.goal_m;
        task.ground_m = ground_m;
        task.altitude_m = course_.altitude_m;
        task.bounds_m = course_.bounds_m;
        task.limits = setup_.limits;
        return task;
    }

    PlanningTask planningTask(const VehicleState& state, double after_s, const Carrot& carrot,
                              double ground_m) const {
        PlanningTask task;
        task.start = state;
        task.start_after_s = after_s;
        task.carrot_m = carrot.at_m;
        task.beyond_carrot_m = carrot.beyond_m;
        task.speed_m_s = setup_.speed_m_s;
        task.ground_m = ground_m;
        task.altitude_m = course_.altitude_m;
        task.limits = setup_.limits;
        task.period_s = std::max(feed_->period_s(), latencies_.median_s());
        task.brakes_in_known_space = setup_.brakes_in_known_space;
        task.keeps_candidates = listener_.keeps_candidates;
        return task;
    }

    void note(const Plan& plan, const VehicleState& now, double time_s) {
        if (plan.is_emergency && !in_emergency_) {
            ++result_.emergency_stops;
            notify("emergency stop");
        }
        in_emergency_ = plan.is_emergency;
        const Eigen::Vector3d to_goal = course_.goal_m - now.position_m;
        if (std::isnan(result_.first_reaction_m) &&
            leavesCourse(plan.command_m_s, to_goal, setup_.speed_m_s)) {
            result_.first_reaction_m =
                freeDistance_m(course_, now.position_m, setup_.limits.clearance_radius_m(), time_s);
        }
    }

    TrialResult finish(Outcome outcome, double time_s) {
        result_.outcome = outcome;
        result_.time_s = time_s;
        result_.scans = feed_->received();
        result_.dropped_scans = feed_->dropped();
        result_.rms_jerk_m_s3 = trace_.rmsJerk_m_s3();
        result_.latency_p50_ms = base::quantile(latency_ms_, 0.5);
        result_.latency_p95_ms = base::quantile(latency_ms_, 0.95);
        result_.latency_max_ms = base::quantile(latency_ms_, 1);
        notify(nameOf(outcome));
        return result_;
    }

    void notify(const std::string& what) const {
        if (listener_.event) listener_.event(what);
    }

    const Course& course_;
    const TrialSetup& setup_;
    const TrialListener& listener_;
    Stopwatch stopwatch_;
    std::unique_ptr<ScanFeed> feed_;
    PoseBelief belief_;
    TrialLatencies latencies_;
    std::unique_ptr<WorldModel> world_;
    std::unique_ptr<Guidance> guidance_;
    std::unique_ptr<Planner> planner_;

    VehicleState state_;  ///< true state
    FlightTrace trace_;
    CommandQueue commands_;
    double free_s_ = 0;  ///< time when the planner is free again
    double scan_s_ = 0;  ///< time of the last scan in the model
    Eigen::Vector3f scan_offset_m_{0, 0, 0};
    bool in_emergency_ = false;
    std::vector<double> latency_ms_;
    TrialResult result_;
};

}  // namespace

TrialResult runTrial(const Course& course, const TrialSetup& setup, const LatencyProfile& profile,
                     TrialMeasurement* measurement, const TrialListener& listener) {
    return TrialFlight(course, setup, profile, measurement, listener).fly();
}

}  // namespace hagen::avoidance
