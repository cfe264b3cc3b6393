#pragma once
#include <hagen/scan/Airframe.h>
#include <vector>

namespace hagen {

/// Finds the airframe: near returns at the same range in most scans.
struct AirframeRules {
    int rows = 90;               ///< rows of bins: 2 degrees each
    float near_m = 1.5f;         ///< farther returns are never airframe
    double min_share = 0.5;      ///< min. share of scans with near returns in the bin
    float max_spread_m = 0.15f;  ///< range spread, 10th to 90th percentile
    float margin_m = 0.1f;       ///< mask this far beyond the 90th percentile
    int min_scans = 10;
};

struct LearnedAirframe {
    Image<float> bin_range_m;    ///< as in Airframe
    int bins = 0;                ///< masked bins
    double share_of_sphere = 0;  ///< solid angle of the masked bins
    double share_of_seen = 0;    ///< the same, relative to all bins with a return
};

/// Learns from scans which directions the airframe occludes, and up to which range. Objects that
/// move relative to the vehicle change their range and are not learned, but a wall beside a
/// stationary vehicle is.
class AirframeLearner {
 public:
    explicit AirframeLearner(const AirframeRules& rules = {});

    /// Adds a scan with ranges.
    void add(const Scan& scan);
    int scans() const { return scans_; }

    /// Masks each bin that fulfils the rules. Also masks a bin beside a masked one, up to the same
    /// range, if at least 2 scans and 2 % of the scans have returns within that range: the edge of
    /// a part rarely fills its bin. Throws std::invalid_argument after fewer scans than
    /// `min_scans`.
    LearnedAirframe learn() const;

 private:
    struct NearReturn {
        int scan;
        float range_m;
    };
    AirframeRules rules_;
    int scans_ = 0;
    std::vector<std::vector<NearReturn>> near_;  ///< by bin, column by column
    std::vector<bool> is_seen_;                  ///< the bin had a return, at any range
};

}  // namespace hagen
