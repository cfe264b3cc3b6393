#pragma once
#include <hagen/filter/SlidingWindow.h>
#include <hagen/mrpt/Horizon.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/ScanPose.h>
#include <hagen/mrpt/Trajectory.h>
#include <hagen/settings/CloudSensors.h>
#include <hagen/settings/Settings.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/system/COutputLogger.h>
#include <mrpt/system/CTimeLogger.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>

namespace hagen::observations {

/// The filter as an MRPT observation processor.
///
///     hagen::observations::ObservationSegmenter segmenter;  // or mrpt::rtti::classFactory()
///     segmenter.initialize(settings);
///     hagen::observations::ObservationSegmenter::Output out;
///     if (segmenter.process(*observation, out)) rawlog.insert(out.roi);
///
/// Accepts the LiDAR scans of a log with one or several sensors. Each sensor label has its own
/// filter. Results do not depend on previous scans, except that the settings may ask for a sliding
/// window, and that the beams of a sensor named by neither the recording nor the settings are
/// recovered from its first clouds (CloudSensors.h).
class ObservationSegmenter : public mrpt::rtti::CObject, public mrpt::system::COutputLogger {
    DEFINE_MRPT_OBJECT(ObservationSegmenter, hagen::observations)

 public:
    struct Output {
        /// RoI and ROU of the scan, with its time stamp, sensor pose, and label plus `_roi` or
        /// `_non_roi`. Points are as measured, in the sensor frame. Every return with a range is in
        /// one of the clouds, except returns from the airframe in the settings.
        mrpt::obs::CObservationPointCloud::Ptr roi, non_roi;

        /// The scan's returns (with `label_window`, those of the window, in the frame of the scan),
        /// and the result of each stage; valid until the next process().
        const Scan* scan = nullptr;
        const SegmentationResult* result = nullptr;
        const SensorModel* sensor = nullptr;
        std::size_t returns_masked = 0;    ///< airframe returns, which have no range in `scan`
        const Options* options = nullptr;  ///< options of the filter, adapted to the sensor
        /// The beams of `sensor` if neither the recording nor the settings name it. If null, a
        /// VLP-16 is assumed.
        SharedBeams recovered;
        bool is_sensor_assumed = false;
        /// Pose of the sensor. If its attitude is known, angles are relative to the horizon.
        ScanPose pose;

        /// Warning about this scan, also logged; may be empty.
        std::string remark;

        /// Time from the call of process() to the labels, before creating the clouds.
        std::chrono::steady_clock::duration time_to_labels{};
        /// CPU time of this thread in the filter only.
        std::chrono::nanoseconds filter_cpu_time{};
    };

    ObservationSegmenter() : COutputLogger("hagen::ObservationSegmenter") {}

    /// Applies new settings and forgets the last attitude and recovered sensors. Without a call,
    /// default settings apply. Throws SettingsError if the options do not fit the sensor of the
    /// settings.
    void initialize(const Settings& settings);

    /// Segments one observation. Returns false and leaves `out` unchanged if it is not a LiDAR
    /// scan. Pose and attitude come from scanPoseOf(), with the mount of mountedPose(). Throws
    /// std::runtime_error if a scan cannot be read, and SettingsError if the options do not fit its
    /// sensor.
    bool process(const mrpt::obs::CObservation& observation, Output& out,
                 const Trajectory& vehicle = Trajectory());

    /// Like above, for a scan with a known pose and, for a cloud of an unnamed sensor, known
    /// `beams` (null if not found; if omitted, recovers them). Unless the settings ask for a
    /// sliding window, such scans can be segmented in an arbitrary order and by several segmenters
    /// concurrently.
    bool process(const mrpt::obs::CObservation& observation, Output& out, const ScanPose& pose,
                 const std::optional<SharedBeams>& beams = std::nullopt);

    /// Stores the vehicle's attitude if an observation provides it (Horizon.h). process() does this
    /// for observations other than scans; call it for the rest of the scan's sensory frame.
    void see(const mrpt::obs::CObservation& observation) { horizon_.see(observation); }

    /// Class of the output clouds.
    CloudClass cloud_class = CloudClass::Simple;

    /// Measures the time of each part of process(). Disabled by default; prints a report on
    /// destruction.
    mrpt::system::CTimeLogger profiler{false, "hagen::ObservationSegmenter"};

 private:
    SharedBeams beamsOf(const mrpt::obs::CObservation& observation);
    SlidingWindow& windowOf(const std::string& label);

    Settings settings_;
    std::map<std::string, SlidingWindow> windows_;  ///< by sensor label
    std::map<std::string, mrpt::Clock::time_point> last_time_;
    CloudSensors sensors_;
    Horizon horizon_;
    ObservedScan observed_;
};

/// Registers this project's classes with mrpt::rtti::classFactory(). Automatic in programs that use
/// one of these classes.
void registerHagenClasses();

}  // namespace hagen::observations
