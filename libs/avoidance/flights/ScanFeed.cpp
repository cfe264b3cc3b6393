#include "avoidance/flights/ScanFeed.h"

#include "avoidance/flights/SectorSensor.h"
#include "avoidance/flights/TrialSensor.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "avoidance/flights/Streams.h"

namespace hagen::avoidance {
namespace {

constexpr int kStepsPerTurn = 5;
static_assert(kStepsPerTurn * 20 == 100);  // kControlStep_s per TrialSensor::kTurn_s

/// Keeps only the newest whole scan, and simulates it when it is taken.
class WholeScans : public ScanFeed {
 public:
    WholeScans(const Course& course, Air air, float zone_m) : sensor_(course, air, zone_m) {}

    void receive(int step, const FlightTrace&, PoseBelief&) override {
        if (step % kStepsPerTurn != 0) return;
        ++received_;
        if (waiting_) ++dropped_;
        waiting_ = step / kStepsPerTurn - 1;
    }
    bool isWaiting() const override { return waiting_.has_value(); }
    FedScan take(const FlightTrace& trace, PoseBelief& belief, Stopwatch& stopwatch) override {
        const int turn = *std::exchange(waiting_, std::nullopt);
        const simulation::SimulatedScan measured = sensor_.measure(turn, trace);
        const LabelledReturns& returns = stopwatch.time("filter", [&]() -> const LabelledReturns& {
            return sensor_.segment(turn, measured, trace, belief);
        });
        return {TrialSensor::place(turn, measured, returns, trace, belief),
                TrialSensor::kTurn_s * (turn + 1),
                streams::kAltimeter + static_cast<std::uint64_t>(turn)};
    }
    double period_s() const override { return TrialSensor::kTurn_s; }
    int received() const override { return received_; }
    int dropped() const override { return dropped_; }

 private:
    TrialSensor sensor_;
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

}  // namespace

std::unique_ptr<ScanFeed> makeFeed(const Course& course, const TrialSetup& setup, float zone_m) {
    if (setup.updates == Updates::Sectors) {
        return std::make_unique<Sectors>(course, setup.air, zone_m);
    }
    return std::make_unique<WholeScans>(course, setup.air, zone_m);
}

}  // namespace hagen::avoidance
