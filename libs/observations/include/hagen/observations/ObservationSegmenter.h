#pragma once
#include <hagen/observations/Horizon.h>
#include <hagen/observations/ObservationScan.h>
#include <hagen/observations/ScanPose.h>
#include <hagen/observations/Settings.h>
#include <hagen/observations/SlidingWindow.h>
#include <hagen/observations/Trajectory.h>
#include <hagen/segmentation/HagenFilter.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/system/COutputLogger.h>
#include <mrpt/system/CTimeLogger.h>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace hagen::observations {

/// The filter as an MRPT observation processor.
///
///     hagen::observations::ObservationSegmenter segmenter;      // or by name, with
///     mrpt::rtti::classFactory() segmenter.initialize(settings);
///     hagen::observations::ObservationSegmenter::Output out;
///     if (segmenter.process(*observation, out)) rawlog.insert(out.roi);
///
/// Takes every LiDAR scan of a log, of several sensors too: each sensor label has its own filter
/// and its own window.
class ObservationSegmenter : public mrpt::rtti::CObject, public mrpt::system::COutputLogger {
    DEFINE_MRPT_OBJECT(ObservationSegmenter, hagen::observations)

 public:
    struct Output {
        /// RoI and ROU of the scan: its time stamp and sensor pose, its label with `_roi` and
        /// `_non_roi` behind it. Points in the sensor's frame, as measured; returns out of the
        /// sensor's range are in neither.
        mrpt::obs::CObservationPointCloud::Ptr roi, non_roi;

        /// The scan's returns, and what each stage made of them; valid until the next call of
        /// process(). With a window of several scans `result` is about `window`, whose first
        /// scan->size() returns are the scan's, moved to where they would have been seen at the
        /// scan's time.
        const Scan* scan = nullptr;
        const Scan* window = nullptr;
        const SegmentationResult* result = nullptr;
        const SensorModel* sensor = nullptr;
        bool is_sensor_assumed = false;  ///< a VLP-16, for neither recording nor settings tell
        /// Where the sensor was. If its attitude is known, angles are relative to that horizon.
        ScanPose pose;

        /// What a user should know about this scan; empty where there is nothing. Logged, too.
        std::string remark;

        /// From the call of process() to the labels; the clouds are made after that.
        std::chrono::steady_clock::duration time_to_labels{};
        /// Of it, the filter alone: this thread's CPU time.
        std::chrono::nanoseconds filter_cpu_time{};
    };

    ObservationSegmenter() : COutputLogger("hagen::ObservationSegmenter") {}

    /// Takes new settings and forgets all scans. Without it, defaults hold. Throws SettingsError
    /// where the options do not fit the sensor that the settings name.
    void initialize(const Settings& settings);

    /// Segments one observation. False, and `out` untouched, for one that is no LiDAR scan.
    ///
    /// A window of more than one scan needs to know where the vehicle was: `vehicle`. Each return
    /// is moved by the pose at its own time, where returns have times and poses reach to the scan's
    /// end, else the scan as a whole by the pose at its time; without that it is segmented alone.
    /// The remark says which of these fell short.
    ///
    /// The sensor's attitude is that of the last observation that told one (see()), else that of
    /// `vehicle` where it has a horizon.
    ///
    /// Throws std::runtime_error, saying why, for a scan that cannot be read, and SettingsError for
    /// one of a sensor that the options do not fit.
    bool process(const mrpt::obs::CObservation& observation, Output& out,
                 const Trajectory& vehicle = Trajectory());

    /// The same for a scan whose pose is known. If poses are noted in the log's order, scans can be
    /// segmented in any order, and by several segmenters at once.
    bool process(const mrpt::obs::CObservation& observation, Output& out, const ScanPose& pose,
                 const Trajectory& vehicle = Trajectory());

    /// Remembers how the vehicle is tilted, where an observation tells it (Horizon.h). process()
    /// does so with what is no scan; call it for what comes in the same sensory frame as a scan.
    void see(const mrpt::obs::CObservation& observation) { horizon_.see(observation); }

    /// What the clouds are made of.
    CloudClass cloud_class = CloudClass::Simple;

    /// Times of each part of process(). Off at first: it prints its report when it goes.
    mrpt::system::CTimeLogger profiler{false, "hagen::ObservationSegmenter"};

 private:
    /// What belongs to one sensor label.
    struct Lidar {
        HagenFilter filter;
        SlidingWindow window;
    };
    Lidar& lidarOf(const std::string& label, const SensorModel& sensor);
    /// What the filter shall see of the scan in observed_, and a word where that is not all it
    /// could be.
    const Scan& windowOf(const mrpt::obs::CObservation& observation, const Trajectory& vehicle,
                         const std::optional<mrpt::poses::CPose3D>& sensor_pose, Lidar& lidar,
                         std::string& remark);

    Settings settings_;
    std::map<std::string, Lidar> lidars_;
    Horizon horizon_;
    ObservedScan observed_;
    Scan deskewed_;
};

/// Makes this project's classes known to mrpt::rtti::classFactory(). Happens by itself where the
/// program uses any of them; call it before asking for one by name alone.
void registerHagenClasses();

}  // namespace hagen::observations
