#pragma once
#include <hagen/scan/Airframe.h>
#include <vector>

namespace hagen {

/// Finds the airframe: near returns at the same range in most scans.
struct AirframeRules {
    int rows = 90;                ///< of the bins: 2 degrees each
    float near_m = 1.5f;          ///< farther returns are never the airframe's
    double least_share = 0.5;     ///< of the scans have near returns in the bin
    float most_spread_m = 0.15f;  ///< between the 10th and the 90th percentile of their ranges
    float margin_m = 0.1f;        ///< masked beyond the 90th percentile
    int least_scans = 10;
};

struct LearnedAirframe {
    Image<float> bin_range_m;    ///< as in Airframe
    int bins = 0;                ///< masked ones
    double share_of_sphere = 0;  ///< solid angle of the masked bins
    double share_of_seen = 0;    ///< the same, of that of all bins with a return
};

/// Learns from scans which directions the airframe occludes, and up to which range. The range
/// of anything that moves relative to the vehicle changes, so it is not learned. A wall beside a
/// standing vehicle is.
class AirframeLearner {
 public:
    explicit AirframeLearner(const AirframeRules& rules = {});

    /// Takes a scan with ranges.
    void add(const Scan& scan);
    int scans() const { return scans_; }

    /// A bin is masked if it fulfils the rules. So is a bin beside a masked one, up to the same
    /// range, if it has returns within that range in at least 2 scans and 2 % of them: the edge of
    /// a part fills its bin seldom. Throws std::invalid_argument after fewer scans than
    /// `least_scans`.
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
