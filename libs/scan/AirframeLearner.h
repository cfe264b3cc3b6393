#pragma once
#include <hagen/scan/Airframe.h>
#include <vector>

namespace hagen {

/// Thresholds for learning the airframe: near returns at the same range in most scans.
struct AirframeRules {
    int rows = 90;               ///< number of bin rows: 2 degrees each
    float near_m = 1.5f;         ///< returns beyond this range are not learned
    double min_share = 0.5;      ///< min. share of scans with near returns in the bin
    float max_spread_m = 0.15f;  ///< max. range spread (10th to 90th percentile)
    float margin_m = 0.1f;       ///< added to the 90th percentile of the range
    int min_scans = 10;
};

struct LearnedAirframe {
    Image<float> bin_range_m;    ///< as in Airframe
    int bins = 0;                ///< masked bins
    double share_of_sphere = 0;  ///< share of the sphere covered by masked bins
    double share_of_seen = 0;    ///< share of the solid angle with returns covered by masked bins
};

/// Learns from scans in which directions, and up to which range, the airframe occludes the view.
/// Ignores objects that move relative to the vehicle, because their range changes, but learns a
/// wall beside a stationary vehicle.
class AirframeLearner {
 public:
    explicit AirframeLearner(const AirframeRules& rules = {});

    /// Adds a scan; its returns must have ranges.
    void add(const Scan& scan);
    int scans() const { return scans_; }

    /// Masks each bin that meets the thresholds. Also masks a neighbour of a masked bin, up to the
    /// same range, if at least 2 scans and 2 % of the scans have returns within that range, because
    /// parts rarely fill the bins at their edges. Throws std::invalid_argument after fewer scans
    /// than `min_scans`.
    LearnedAirframe learn() const;

 private:
    struct NearReturn {
        int scan;
        float range_m;
    };
    AirframeRules rules_;
    int scans_ = 0;
    std::vector<std::vector<NearReturn>> near_;  ///< near returns of each bin
    std::vector<bool> is_seen_;                  ///< bins with returns at any range
};

}  // namespace hagen
