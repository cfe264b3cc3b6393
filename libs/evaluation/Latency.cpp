#include "evaluation/Latency.h"
#include <algorithm>
#include <numeric>
#include "base/Quantile.h"

namespace hagen::evaluation {
Latency latencyOf(std::vector<double> runs_ms) {
    Latency latency;
    latency.runs = runs_ms.size();
    if (runs_ms.empty()) return latency;
    std::sort(runs_ms.begin(), runs_ms.end());
    const auto runs = static_cast<double>(runs_ms.size());
    latency.mean_ms = std::accumulate(runs_ms.begin(), runs_ms.end(), 0.0) / runs;
    double squares = 0;
    for (const double ms : runs_ms) squares += (ms - latency.mean_ms) * (ms - latency.mean_ms);
    if (runs_ms.size() > 1) latency.sd_ms = std::sqrt(squares / (runs - 1));
    latency.p50_ms = base::nearestRankOfSorted(runs_ms, 0.50);
    latency.p95_ms = base::nearestRankOfSorted(runs_ms, 0.95);
    latency.p99_ms = base::nearestRankOfSorted(runs_ms, 0.99);
    latency.max_ms = runs_ms.back();
    return latency;
}

}  // namespace hagen::evaluation
