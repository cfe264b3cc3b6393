#pragma once
#include <hagen/filter/HagenFilter.h>
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

namespace hagen {

/// Stage 10, the paper's sliding window (section I): the latest `window_scans` scans are moved to
/// the sensor frame of the newest, concatenated, and segmented as one cloud. With one scan, equals
/// HagenFilter. All state between scans is in this object.
///
/// Scans are moved by the change of pose or, without poses, by the change of height and tilt above
/// the ground plane of each scan. Scans with unknown motion stay as measured or, if the window only
/// fills gaps, are not used.
///
///     SlidingWindow window(HagenFilter(sensorModel("Mid-360"), options));
///     const SegmentationResult& result = window.segment(scan, attitude, map_from_sensor);
///     // result.returns are those of window.labelled()
///
/// After the first scans, does not allocate memory.
class SlidingWindow {
 public:
    explicit SlidingWindow(HagenFilter filter);

    /// Segments the newest scan with the previous ones. Throws like HagenFilter::segment(). The
    /// result is valid until the next call.
    const SegmentationResult& segment(const Scan& newest,
                                      const std::optional<Attitude>& attitude = {},
                                      const std::optional<Eigen::Isometry3d>& map_from_sensor = {});

    /// The labelled returns of the last call: the newest scan or, if the options ask for them, all
    /// returns of the window, from the newest scan to the oldest, in the frame of the newest.
    const Scan& labelled() const {
        const Options& o = filter_.options();
        return o.label_window && o.window_scans > 1 ? window_ : *newest_;
    }

    /// The numbers of older scans used by the last call, and of those not moved or left out because
    /// the motion is unknown.
    std::size_t olderScans() const { return older_scans_; }
    std::size_t scansWithoutMotion() const { return without_motion_; }

    void forget();

    HagenFilter& filter() { return filter_; }
    const HagenFilter& filter() const { return filter_; }

 private:
    /// What a place is relative to; only equal kinds are comparable.
    enum class Reference { None, Map, Ground };
    struct Place {
        Reference to = Reference::None;
        Eigen::Isometry3d from_sensor = Eigen::Isometry3d::Identity();
    };
    struct Older {
        Scan scan;
        Place place;
    };
    Place placeOf(const Scan& scan, const std::optional<Attitude>& attitude,
                  const std::optional<Eigen::Isometry3d>& map_from_sensor);
    void append(const Older& older, const Place& now);

    HagenFilter filter_;
    std::vector<Older> older_;  ///< a ring of window_scans - 1 scans
    std::size_t seen_ = 0;      ///< scans so far
    std::size_t older_scans_ = 0, without_motion_ = 0;
    Scan window_, moved_;           ///< reused
    const Scan* newest_ = nullptr;  ///< of the last call
};

}  // namespace hagen
