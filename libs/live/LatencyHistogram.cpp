#include <hagen/live/LatencyHistogram.h>

#include <algorithm>
#include <cmath>

namespace hagen::live {
namespace {

constexpr double kMin_s = 1e-6, kStep = 1.02;

}  // namespace

void LatencyHistogram::add(double seconds) {
    const double steps =
        seconds > kMin_s ? std::ceil(std::log(seconds / kMin_s) / std::log(kStep)) : 0.0;
    ++bins_[static_cast<std::size_t>(std::min(steps, static_cast<double>(kBins - 1)))];
    ++count_;
    max_s_ = std::max(max_s_, seconds);
}

double LatencyHistogram::quantile_s(double share) const {
    if (count_ == 0) return std::nan("");
    const double wanted = share * static_cast<double>(count_);
    std::size_t so_far = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
        so_far += bins_[bin];
        if (so_far > 0 && static_cast<double>(so_far) >= wanted) {
            return std::min(max_s_, kMin_s * std::pow(kStep, static_cast<double>(bin)));
        }
    }
    return max_s_;
}

}  // namespace hagen::live
