#pragma once
#include <hagen/base/ProcessCost.h>
#include <hagen/trials/TrialMeasurement.h>

#include <algorithm>
#include <string>

namespace hagen::trials {

/// Measures what stages cost. Does nothing without a measurement to write to.
class Stopwatch {
 public:
    explicit Stopwatch(TrialMeasurement* measurement) : measurement_(measurement) {}

    template <class Call>
    decltype(auto) time(const std::string& stage, Call call) {
        if (measurement_ == nullptr) return call();
        const Timer timer{*measurement_, stage};
        return call();
    }

    /// Times a call that changes only the world model; the heap's growth is the model's. An empty
    /// stage, of the call that makes the model, is not timed.
    template <class Call>
    void weigh(const std::string& stage, double path_m, Call call) {
        if (measurement_ == nullptr) return call();
        const double before = base::heapBytes(), start_ms = base::threadCpuTime_ms();
        call();
        const double taken_ms = base::threadCpuTime_ms() - start_ms;
        held_bytes_ += base::heapBytes() - before;
        if (!stage.empty()) measurement_->stage_ms[stage].push_back(taken_ms);
        measurement_->peak_model_bytes = std::max(measurement_->peak_model_bytes, held_bytes_);
        measurement_->model_bytes_by_path_m.emplace_back(path_m, held_bytes_);
    }

 private:
    struct Timer {
        TrialMeasurement& measurement;
        const std::string& stage;
        double start_ms = base::threadCpuTime_ms();
        ~Timer() { measurement.stage_ms[stage].push_back(base::threadCpuTime_ms() - start_ms); }
    };

    TrialMeasurement* measurement_;
    double held_bytes_ = 0;
};

}  // namespace hagen::trials
