#include <hagen/avoidance/Trial.h>
#include <algorithm>
#include <cmath>
#include <utility>
#include "avoidance/flights/FlightTrace.h"
#include "avoidance/flights/PoseBelief.h"
#include "avoidance/flights/TrialScore.h"
#include "avoidance/flights/TrialSensor.h"
#include "base/Quantile.h"

#include "avoidance/flights/SectorSensor.h"
#include "avoidance/flights/Stopwatch.h"
#include "avoidance/flights/Streams.h"

namespace hagen::avoidance {
namespace {

/// The input of a world model update.
struct FedScan {
    observations::MappedScan scan;
    double arrived_s;      ///< arrival time of the scan's last part
    std::uint64_t stream;  ///< random stream of the scan
};

/// Buffers measurements until the planner takes them.
class ScanFeed {
 public:
    virtual ~ScanFeed() = default;

    /// Adds the measurements up to a control step that the trace has reached.
    virtual void receive(int step, const FlightTrace& trace, PoseBelief& belief) = 0;
    virtual bool isWaiting() const = 0;
    /// Returns the waiting measurements, and times the filter.
    virtual FedScan take(const FlightTrace& trace, PoseBelief& belief, Stopwatch& stopwatch) = 0;

    virtual double period_s() const = 0;  ///< minimum time between updates
    virtual int received() const = 0;     ///< number of whole scans or sectors
    virtual int dropped() const = 0;      ///< number of scans or sectors never taken
};

constexpr int kStepsPerTurn = 5;
static_assert(kStepsPerTurn * 20 == 100);  // kControlStep_s per TrialSensor::kTurn_s

/// Keeps only the newest whole scan, and simulates it when it is taken; without `measures`, only
/// its time.
class WholeScans : public ScanFeed {
 public:
    WholeScans(const Course& course, Air air, float zone_m, bool measures)
        : sensor_(course, air, zone_m), measures_(measures) {}

    void receive(int step, const FlightTrace&, PoseBelief&) override {
        if (step % kStepsPerTurn != 0) return;
        ++received_;
        if (waiting_) ++dropped_;
        waiting_ = step / kStepsPerTurn - 1;
    }
    bool isWaiting() const override { return waiting_.has_value(); }
    FedScan take(const FlightTrace& trace, PoseBelief& belief, Stopwatch& stopwatch) override {
        const int turn = *std::exchange(waiting_, std::nullopt);
        const double start_s = TrialSensor::kTurn_s * turn;
        const double arrived_s = TrialSensor::kTurn_s * (turn + 1);
        const auto stream = streams::kAltimeter + static_cast<std::uint64_t>(turn);
        observations::MappedScan only_time;
        only_time.time_s = start_s + TrialSensor::kTurn_s;  // as TrialSensor::place() rounds it
        if (!measures_) return {only_time, arrived_s, stream};
        const simulation::SimulatedScan measured = sensor_.measure(turn, trace);
        const LabelledReturns& returns = stopwatch.time("filter", [&]() -> const LabelledReturns& {
            return sensor_.segment(turn, measured, trace, belief);
        });
        return {TrialSensor::place(turn, measured, returns, trace, belief), arrived_s, stream};
    }
    double period_s() const override { return TrialSensor::kTurn_s; }
    int received() const override { return received_; }
    int dropped() const override { return dropped_; }

 private:
    TrialSensor sensor_;
    bool measures_;
    int received_ = 0, dropped_ = 0;
    std::optional<int> waiting_;  ///< newest complete turn that is not used yet
};

/// Keeps all sectors since the last update. As with whole scans, the first update covers a whole
/// turn, so that the vehicle has seen all directions before it starts.
class Sectors : public ScanFeed {
 public:
    Sectors(const Course& course, Air air, float zone_m) : sensor_(course, air, zone_m) {}

    void receive(int step, const FlightTrace& trace, PoseBelief& belief) override {
        step_ = step;
        for (observations::MappedScan& sector :
             sensor_.measureUntil(kControlStep_s * step, trace, belief)) {
            ++received_;
            waiting_.push_back(std::move(sector));
        }
    }
    bool isWaiting() const override { return step_ >= kStepsPerTurn && !waiting_.empty(); }
    FedScan take(const FlightTrace&, PoseBelief&, Stopwatch&) override {
        const std::vector<observations::MappedScan> sectors = std::exchange(waiting_, {});
        return {joined(sectors), sectors.back().time_s,
                streams::kAltimeterStep + static_cast<std::uint64_t>(step_)};
    }
    double period_s() const override { return kControlStep_s; }
    int received() const override { return received_; }
    int dropped() const override { return 0; }

 private:
    SectorSensor sensor_;
    int step_ = 0, received_ = 0;
    std::vector<observations::MappedScan> waiting_;
};

/// Creates the feed for a setup's updates.
std::unique_ptr<ScanFeed> makeFeed(const Course& course, const TrialSetup& setup, float zone_m,
                                   bool has_listener) {
    if (setup.updates == Updates::Sectors) {
        return std::make_unique<Sectors>(course, setup.air, zone_m);
    }
    const bool measures = has_listener || setup.make_world || !needsTruth(setup.model);
    return std::make_unique<WholeScans>(course, setup.air, zone_m, measures);
}

/// Draws the latency of planning steps from the profile. Sectors are assumed to cost as much as a
/// whole scan: updates with a few sectors take less time, labelling about the same.
class TrialLatencies {
 public:
    TrialLatencies(const Course& course, const TrialSetup& setup, const LatencyProfile& profile)
        : profile_(profile), scale_(setup.latency_scale) {
        // Streams are numbered from the end, so that models with and without the filter share them.
        const std::vector<std::string> names = stagesOf(setup);
        for (std::size_t i = 0; i < names.size(); ++i) {
            const std::uint64_t stream = streams::kLatency + (names.size() - i);
            stages_.push_back({names[i], simulation::Random(course.seed, stream)});
        }
    }

    double draw_s() {
        double sum_ms = 0;
        for (Stage& stage : stages_) sum_ms += profile_.draw_ms(stage.name, stage.random);
        return 1e-3 * scale_ * sum_ms;
    }
    /// The latency that planners assume.
    double median_s() const {
        double sum_ms = 0;
        for (const Stage& stage : stages_) sum_ms += profile_.median_ms(stage.name);
        return 1e-3 * scale_ * sum_ms;
    }

 private:
    struct Stage {
        std::string name;
        simulation::Random random;
    };

    const LatencyProfile& profile_;
    double scale_;
    std::vector<Stage> stages_;
};

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
          feed_(makeFeed(course, setup, perceptionRangeFor_m(paceOf(setup)),
                         listener.step != nullptr)),
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

std::vector<std::string> stagesOf(const TrialSetup& setup) {
    std::vector<std::string> stages;
    if (needsLabels(setup.model)) stages.push_back("filter");
    const std::string prefix = setup.model + "/";
    for (const std::string& part :
         {std::string("update"), setup.guidance, setup.guidance + "+" + setup.planner}) {
        stages.push_back(prefix + part);
    }
    return stages;
}

TrialResult runTrial(const Course& course, const TrialSetup& setup, const LatencyProfile& profile,
                     TrialMeasurement* measurement, const TrialListener& listener) {
    return TrialFlight(course, setup, profile, measurement, listener).fly();
}

}  // namespace hagen::avoidance
