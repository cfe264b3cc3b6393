#pragma once
#include <array>
#include <cstddef>

namespace hagen::live {

/// Latency statistics in constant memory, however long the run: 1 us to 100 s in steps of 2 %.
class LatencyHistogram {
 public:
    /// Adds a time; values that are not positive are treated as the minimum.
    void add(double seconds);

    std::size_t count() const { return count_; }
    /// The quantile for a fraction (0 to 1), at most 2 % too high; NaN if empty.
    double quantile_s(double share) const;
    double max_s() const { return max_s_; }  ///< the exact maximum; 0 if empty

 private:
    static constexpr std::size_t kBins = 932;
    std::array<std::size_t, kBins> bins_{};
    std::size_t count_ = 0;
    double max_s_ = 0;
};

}  // namespace hagen::live
