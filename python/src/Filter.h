#pragma once
#include <hagen/filter/ResultCheck.h>
#include <hagen/filter/SlidingWindow.h>
#include <hagen/settings/CloudSensors.h>
#include <hagen/settings/Settings.h>

#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "Arrays.h"
#include "PythonScan.h"
#include "RecordedFilter.h"

namespace hagen::python {

/// A segmented scan. It owns the images of all stages; NumPy arrays share its memory.
struct Segmented {
    Scan scan;
    SegmentationResult result;
    std::string sensor, remark;
};

/// The height of each return above the ground surface [m]; NaN without a surface or range.
std::vector<float> heightsOf(const Segmented& segmented);

/// The filter for Python. Thread-safe: each call has its own filter. Reuses the memory of results
/// that Python has dropped, so that a loop over scans soon stops allocating.
class Filter {
 public:
    /// Throws SettingsError if the options do not fit the sensor.
    explicit Filter(const Settings& settings);

    /// Segments the returns of one scan from the sensor in the settings, or with the beams
    /// recovered from the first scans. `map_from_sensor` moves the scans of a sliding window. Needs
    /// no GIL.
    std::shared_ptr<Segmented> segment(const PointsView& points,
                                       const std::optional<Attitude>& attitude,
                                       const std::optional<Eigen::Isometry3d>& map_from_sensor);
    /// Segments a scan of a recording with its own sensor, beams, tilt and mount. Throws
    /// std::runtime_error with the reason if it cannot be read. Needs no GIL.
    std::shared_ptr<Segmented> segment(const PythonScan& scan,
                                       const std::optional<Attitude>& attitude);

    /// Warnings about the results (ResultCheck) after the first, 10th and every 100th scan, each
    /// kind once.
    std::vector<std::string> newWarnings();

    const Settings& settings() const { return settings_; }
    SensorModel sensor() const;

 private:
    /// Results that Python has dropped.
    struct Pool {
        std::mutex mutex;
        std::vector<std::unique_ptr<Segmented>> idle;
    };
    std::shared_ptr<Segmented> newResult();
    SlidingWindow leaseFilter(const Scan& scan, int& generation);
    void giveBack(SlidingWindow&& filter, int generation);

    const Settings settings_;
    std::shared_ptr<Pool> pool_ = std::make_shared<Pool>();

    void check(const Segmented& segmented, const SensorModel& sensor, const Options& options);

    mutable std::mutex mutex_;  ///< guards all members below
    ResultCheck check_;
    std::size_t scans_ = 0;
    std::set<std::string> warned_;  ///< kinds of the warnings given
    std::vector<SlidingWindow> idle_;
    int generation_ = 0;  ///< number of sensor changes; filters of earlier sensors are dropped
    CloudSensors sensors_;
    SharedBeams beams_;

    std::mutex segmenting_recorded_;
    RecordedFilter recorded_;
};

}  // namespace hagen::python
