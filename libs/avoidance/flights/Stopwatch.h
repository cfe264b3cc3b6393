#pragma once
#include <hagen/avoidance/Trial.h>
#include "base/ProcessCost.h"

#include <string>

namespace hagen::avoidance {

/// Measures the run time of stages. Without an output, it only runs them.
class Stopwatch {
 public:
    explicit Stopwatch(TrialMeasurement* measurement) : measurement_(measurement) {}

    template <class Call>
    decltype(auto) time(const std::string& stage, Call call) {
        if (measurement_ == nullptr) return call();
        const Timer timer{*measurement_, stage};
        return call();
    }

 private:
    struct Timer {
        TrialMeasurement& measurement;
        const std::string& stage;
        double start_ms = base::threadCpuTime_ms();
        ~Timer() { measurement.stage_ms[stage].push_back(base::threadCpuTime_ms() - start_ms); }
    };

    TrialMeasurement* measurement_;
};

}  // namespace hagen::avoidance
