#pragma once
#include <array>
#include <cstddef>

namespace hagen::live {

/// Times of a run of any length, in bounded memory: 1 us to 100 s in steps of 2 percent.
class LatencyHistogram {
 public:
    /// Adds a time; values that are not positive count as the minimum.
    void add(double seconds);

    std::size_t count() const { return count_; }
    /// The time that a fraction (0 to 1) of them does not exceed, at most 2 percent too high; NaN
    /// without any.
    double quantile_s(double share) const;
    double max_s() const { return max_s_; }  ///< exact; 0 without any

 private:
    static constexpr std::size_t kBins = 932;
    std::array<std::size_t, kBins> bins_{};
    std::size_t count_ = 0;
    double max_s_ = 0;
};

}  // namespace hagen::live
