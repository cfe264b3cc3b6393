#include <hagen/avoidance/OpenLoop.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/simulation/LogClock.h>
#include <hagen/simulation/Scenarios.h>
#include <hagen/simulation/SceneDistance.h>
#include "avoidance/openloop/LaterScansTruth.h"
#include "base/MemoryLimit.h"
#include "base/ProcessCost.h"
#include "base/Text.h"

#include <algorithm>
#include <deque>
#include <stdexcept>

namespace hagen::avoidance {
namespace {

constexpr float kMapMargin_m = 20, kMapMarginUp_m = 10;  // around the whole flight
constexpr float kMaxMap_m3 = 100000;
constexpr float kHalfBox_m = 30, kHalfBoxUp_m = 10;  // around the vehicle
constexpr float kBorder_m = 12, kBorderUp_m = 5;     // beyond the reach of queries and clearances
constexpr double kReplayed_s = 3;                    // age of scans processed again after a reset

// Maximum median distance between a scan's obstacles and those of its scene (usually 1 to 2 cm).
constexpr float kMaxSceneDistance_m = 0.08f;
constexpr std::size_t kMinPointsToCheck = 100;

Eigen::AlignedBox3f widened(const Eigen::AlignedBox3f& box, float aside_m, float up_m) {
    const Eigen::Vector3f by(aside_m, aside_m, up_m);
    return {box.min() - by, box.max() + by};
}

/// The true scene of a simulated log.
class SceneTruth {
 public:
    SceneTruth(const OpenLoop::SimulatedScene& scene, const Eigen::AlignedBox3f& flight_m)
        : name_(scene.scenario + " with seed " + std::to_string(scene.seed)),
          distance_(simulation::makeScene(scene.scenario, scene.seed),
                    widened(flight_m, kMapMargin_m, kMapMarginUp_m).cast<double>(),
                    WorldModel::kReach_m) {}

    /// Clearance at the time of the last scan.
    float clearance_m(const Eigen::Vector3f& point_m) const {
        return distance_.at(point_m, time_s_);
    }

    /// Throws std::runtime_error if the scan's obstacles do not match the scene.
    void see(const observations::MappedScan& scan) {
        time_s_ = scan.time_s - simulation::kSimulatedLogStart_s;
        if (is_checked_) return;
        std::vector<float> off_m;
        for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
            if (scan.labels[i] == Label::Roi) off_m.push_back(clearance_m(scan.points_m[i]));
        }
        if (off_m.size() < kMinPointsToCheck) return;
        is_checked_ = true;
        const auto middle = off_m.begin() + static_cast<std::ptrdiff_t>(off_m.size() / 2);
        std::nth_element(off_m.begin(), middle, off_m.end());
        if (*middle < kMaxSceneDistance_m) return;
        throw std::runtime_error("the log was not simulated in " + name_ +
                                 ": half of the obstacle returns in a scan are at least " +
                                 std::to_string(*middle) + " m from the obstacles in the scene");
    }

 private:
    std::string name_;
    simulation::SceneDistance distance_;
    double time_s_ = 0;
    bool is_checked_ = false;
};

/// A scan whose ground truth is not known yet.
struct PendingScan {
    std::vector<OpenLoopRow> rows;  ///< one per model
    std::vector<OpenLoopCost> costs;
    std::vector<DirectionSet> blocked;
    double time_s = 0;
    LaterScansTruth later;
    std::optional<TrueDirections> truth;
};

DirectionSet levelDirections() {
    DirectionSet level;
    for (std::size_t n = 0; n < kDirections; ++n) level[n] = !pointsDown(n);
    return level;
}

DirectionSet directionsAt(std::size_t elevation) {
    DirectionSet at;
    for (std::size_t n = 0; n < kDirectionAzimuths; ++n) at.set(elevation * kDirectionAzimuths + n);
    return at;
}

class Walk {
 public:
    Walk(const OpenLoop& open_loop, const OpenLoopListener& listener)
        : open_loop_(open_loop),
          listener_(listener),
          scans_(open_loop.source, listener.keep_going) {
        result_.poses = scans_.poseSource();
        result_.poses_have_horizon = scans_.posesHaveHorizon();
        result_.scans_without_pose = scans_.scansWithoutPose();
        for (const std::string& name : open_loop.models) {
            result_.models.emplace_back().name = name;
        }
        const std::size_t models = open_loop.models.size();
        result_.agreement.assign(models, std::vector<double>(models, 0));
        models_.resize(models);
        heap_bytes_.resize(models);
        if (open_loop.scene) truth_.emplace(*open_loop.scene, scans_.flight_m());
        const Eigen::AlignedBox3f whole = widened(scans_.flight_m(), kMapMargin_m, kMapMarginUp_m);
        maps_whole_flight_ = whole.volume() <= kMaxMap_m3;
        if (maps_whole_flight_) box_m_ = whole;
    }

    OpenLoopResult result() {
        LoggedScan scan;
        try {
            while (listener_.keep_going() && scans_.next(scan)) {
                process(scan);
                listener_.progress(result_.scans, scans_.scans() - scans_.scansWithoutPose());
            }
        } catch (const SettingsError&) {
            throw;
        } catch (const std::bad_alloc&) {
            why_ended_ = base::outOfMemory();
        } catch (const std::exception& e) {  // earlier scores are kept
            why_ended_ = e.what();
        }
        if (why_ended_.empty() && !listener_.keep_going()) why_ended_ = "interrupted";
        return finish();
    }

 private:
    void process(const LoggedScan& scan) {
        if (truth_) truth_->see(scan.mapped);
        prepareModels(scan);
        PendingScan pending = pendingScanOf(scan);
        for (std::size_t m = 0; m < models_.size(); ++m) updateAndQuery(m, scan, pending);
        result_.returns.push_back(static_cast<double>(pending.rows.front().returns));
        result_.roi.push_back(static_cast<double>(pending.rows.front().roi));
        result_.filter_ms.push_back(scan.filter_ms);
        result_.scans_placed_by_one_pose += scan.is_placed_by_one_pose;
        ++result_.scans;

        const double now_s = scan.mapped.time_s;
        if (!kept_.empty() && now_s < kept_.back().time_s - LaterScansTruth::kDuration_s) {
            // The clock went back, so no later scans will follow.
            while (!waiting_.empty()) scoreOldest();
            kept_.clear();
            persistent_points_ = {};
        }
        while (!waiting_.empty() &&
               waiting_.front().time_s + LaterScansTruth::kDuration_s < now_s) {
            scoreOldest();
        }
        if (!truth_) {
            const SeenRanges ranges(scan.mapped);
            const auto persistent_m = persistent_points_.of(scan.mapped);
            for (PendingScan& earlier : waiting_) earlier.later.see(persistent_m, ranges);
        }
        waiting_.push_back(std::move(pending));
        if (truth_) scoreOldest();

        kept_.push_back(scan.mapped);
        while (kept_.front().time_s + kReplayed_s < now_s) kept_.pop_front();
    }
    /// Creates the models, and recreates them when the vehicle nears the border of their box.
    void prepareModels(const LoggedScan& scan) {
        const bool is_begun = result_.scans > 0;
        const Eigen::AlignedBox3f inner = widened(box_m_, -kBorder_m, -kBorderUp_m);
        if (is_begun && (maps_whole_flight_ || inner.contains(scan.vehicle_m))) return;
        result_.model_resets += is_begun;
        if (!maps_whole_flight_) {
            box_m_ = widened({scan.vehicle_m, scan.vehicle_m}, kHalfBox_m, kHalfBoxUp_m);
        }
        WorldModelSetting setting;
        setting.bounds_m = box_m_;
        if (truth_) {
            setting.true_clearance_m = [this](const auto& point_m, double) {
                return truth_->clearance_m(point_m);
            };
        }
        for (std::size_t m = 0; m < models_.size(); ++m) {
            models_[m].reset();
            const double before = base::heapBytes();
            models_[m] = open_loop_.make(open_loop_.models[m], setting);
            for (const observations::MappedScan& kept : kept_) models_[m]->update(kept);
            heap_bytes_[m] = base::heapBytes() - before;
        }
    }
    /// The pending scan, before the models are queried.
    PendingScan pendingScanOf(const LoggedScan& scan) const {
        const std::size_t models = models_.size();
        PendingScan pending{std::vector<OpenLoopRow>(models),  std::vector<OpenLoopCost>(models),
                            std::vector<DirectionSet>(models), scan.mapped.time_s,
                            LaterScansTruth(scan.vehicle_m),   {}};
        const auto& labels = scan.mapped.labels;
        for (std::size_t m = 0; m < models; ++m) {
            OpenLoopRow& row = pending.rows[m];
            row.scan = result_.scans;
            row.entry = scan.entry;
            row.time_s = scan.mapped.time_s;
            row.model = open_loop_.models[m];
            row.returns = labels.size();
            row.roi =
                static_cast<std::size_t>(std::count(labels.begin(), labels.end(), Label::Roi));
            pending.costs[m].filter_ms = scan.filter_ms;
        }
        if (!truth_) return pending;
        pending.truth.emplace();
        pending.truth->scored.set();
        pending.truth->blocked = blockedDirections(
            [this](const Eigen::Vector3f& point_m) { return truth_->clearance_m(point_m); },
            scan.vehicle_m);
        return pending;
    }
    void updateAndQuery(std::size_t m, const LoggedScan& scan, PendingScan& pending) {
        WorldModel& model = *models_[m];
        OpenLoopRow& row = pending.rows[m];
        OpenLoopCost& cost = pending.costs[m];
        const double before = base::heapBytes(), start_ms = base::threadCpuTime_ms();
        model.update(scan.mapped);
        cost.update_ms = base::threadCpuTime_ms() - start_ms;
        heap_bytes_[m] += base::heapBytes() - before;
        cost.heap_bytes = heap_bytes_[m];

        const double asking_ms = base::threadCpuTime_ms();
        pending.blocked[m] = blockedDirections(
            [&](const Eigen::Vector3f& point_m) { return model.clearance_m(point_m); },
            scan.vehicle_m);
        cost.queries_ms = base::threadCpuTime_ms() - asking_ms;

        row.obstacles = model.obstacles().centre_m.size();
        row.bytes = model.bytes();
        row.blocked = pending.blocked[m].count();
    }
    /// Scores the models on the oldest pending scan and reports its rows.
    void scoreOldest() {
        static const DirectionSet level = levelDirections();
        PendingScan& oldest = waiting_.front();
        const TrueDirections truth = oldest.truth ? *oldest.truth : oldest.later.directions();
        for (std::size_t m = 0; m < models_.size(); ++m) {
            OpenLoopRow& row = oldest.rows[m];
            const DirectionSet& blocked = oldest.blocked[m];
            row.truly_blocked = (truth.blocked & truth.scored).count();
            row.all = countBlocked(blocked, truth.blocked, truth.scored);
            row.level = countBlocked(blocked, truth.blocked, truth.scored & level);

            OpenLoopModel& model = result_.models[m];
            model.all += row.all;
            model.level += row.level;
            for (std::size_t e = 0; e < kDirectionElevations; ++e) {
                model.by_elevation[e] +=
                    countBlocked(blocked, truth.blocked, truth.scored & directionsAt(e));
            }
            model.obstacles.push_back(static_cast<double>(row.obstacles));
            model.bytes.push_back(static_cast<double>(row.bytes));
            model.blocked.push_back(static_cast<double>(row.blocked));
            const OpenLoopCost& cost = oldest.costs[m];
            model.update_ms.push_back(cost.update_ms);
            model.queries_ms.push_back(cost.queries_ms);
            model.peak_heap_bytes = std::max(model.peak_heap_bytes, cost.heap_bytes);
            listener_.row(row, cost);
        }
        agree(oldest);
        waiting_.pop_front();
    }
    void agree(const PendingScan& pending) {
        for (std::size_t a = 0; a < models_.size(); ++a) {
            for (std::size_t b = 0; b < models_.size(); ++b) {
                result_.agreement[a][b] += freeAgreement(pending.blocked[a], pending.blocked[b]);
            }
        }
    }
    OpenLoopResult finish() {
        while (!waiting_.empty()) scoreOldest();
        result_.unreadable_scans = scans_.unreadableScans();
        result_.why_unreadable = scans_.whyUnreadable();
        result_.remarks = scans_.remarks();
        if (result_.scans == 0) {
            const std::string why = why_ended_.empty() ? scans_.whyUnreadable() : why_ended_;
            throw std::runtime_error(open_loop_.source.log.string() +
                                     ": none of its scans could be processed: " + why);
        }
        for (auto& line : result_.agreement) {
            for (double& sum : line) sum /= static_cast<double>(result_.scans);
        }
        if (!why_ended_.empty()) throw OpenLoopEnded(why_ended_, std::move(result_));
        return std::move(result_);
    }

    const OpenLoop& open_loop_;
    const OpenLoopListener& listener_;
    LoggedScans scans_;
    std::optional<SceneTruth> truth_;
    bool maps_whole_flight_ = false;
    Eigen::AlignedBox3f box_m_;
    std::vector<std::unique_ptr<WorldModel>> models_;
    std::vector<double> heap_bytes_;
    std::deque<observations::MappedScan> kept_;
    std::deque<PendingScan> waiting_;
    PersistentPoints persistent_points_;
    OpenLoopResult result_;
    std::string why_ended_;
};

}  // namespace

void checkOpenLoop(const OpenLoop& open_loop) {
    if (open_loop.models.empty()) throw std::invalid_argument("no world model given");
    for (const std::string& model : open_loop.models) {
        needsLabels(model);  // throws for unknown names
        if (std::count(open_loop.models.begin(), open_loop.models.end(), model) > 1) {
            throw std::invalid_argument("world model '" + model + "' is listed twice");
        }
        if (predictsMotion(model)) {
            throw std::invalid_argument("'" + model +
                                        "' predicts motion, which openloop does not evaluate");
        }
        if (needsTruth(model) && !open_loop.scene) {
            throw std::invalid_argument(
                "the true scene (oracle) needs the simulated scenario "
                "(--truth-scenario, --truth-seed)");
        }
    }
    if (!open_loop.scene) return;
    const auto known = simulation::scenarioNames();
    if (std::find(known.begin(), known.end(), open_loop.scene->scenario) != known.end()) return;
    throw std::invalid_argument("unknown scenario '" + open_loop.scene->scenario +
                                "'; known: " + base::joined(known, " "));
}

OpenLoopResult runOpenLoop(const OpenLoop& open_loop, const OpenLoopListener& listener) {
    checkOpenLoop(open_loop);
    return Walk(open_loop, listener).result();
}

}  // namespace hagen::avoidance
