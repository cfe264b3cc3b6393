#pragma once
#include <hagen/filter/HagenFilter.h>
#include <hagen/mrpt/CloudSensors.h>
#include <hagen/mrpt/Horizon.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/ScanPose.h>
#include <hagen/mrpt/Trajectory.h>
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
/// Accepts every LiDAR scan of a log, also from several sensors: each sensor label has its own
/// filter. No result depends on the scans before, except for clouds whose sensor neither the
/// recording nor the settings name: its beams are those of the first clouds of their label
/// (CloudSensors.h).
class ObservationSegmenter : public mrpt::rtti::CObject, public mrpt::system::COutputLogger {
    DEFINE_MRPT_OBJECT(ObservationSegmenter, hagen::observations)

 public:
    struct Output {
        /// RoI and ROU of the scan, with its time stamp, its sensor pose, and its label plus `_roi`
        /// and `_non_roi`. Points in the sensor frame, as measured. Every return with a range
        /// is in one of the clouds, except those of the airframe of the settings.
        mrpt::obs::CObservationPointCloud::Ptr roi, non_roi;

        /// The scan's returns, and the result of each stage; valid until the next call of
        /// process().
        const Scan* scan = nullptr;
        const SegmentationResult* result = nullptr;
        const SensorModel* sensor = nullptr;
        std::size_t returns_masked = 0;    ///< of the airframe: without a range in `scan`
        const Options* options = nullptr;  ///< of the filter: those of the settings, fitted to it
        /// The beams of `sensor`, if neither the recording nor the settings name it; or not even
        /// these are known, so that it is taken to be a VLP-16.
        SharedBeams recovered;
        bool is_sensor_assumed = false;
        /// Pose of the sensor. If its attitude is known, angles are relative to the horizon.
        ScanPose pose;

        /// Remark about this scan for the user; may be empty. Also logged.
        std::string remark;

        /// Time from the call of process() to the labels, before the clouds are made.
        std::chrono::steady_clock::duration time_to_labels{};
        /// CPU time of this thread in the filter only.
        std::chrono::nanoseconds filter_cpu_time{};
    };

    ObservationSegmenter() : COutputLogger("hagen::ObservationSegmenter") {}

    /// Applies new settings and forgets the last attitude and recovered sensors. Default: default
    /// settings. Throws SettingsError if the options do not fit the sensor of the settings.
    void initialize(const Settings& settings);

    /// Segments one observation. Returns false and leaves `out` unchanged if it is not a LiDAR
    /// scan.
    ///
    /// The pose of the scan is that of `vehicle`, if that covers its time (scanPoseOf()).
    /// The vehicle's attitude is that of the last observation with an attitude (see()), otherwise
    /// that of `vehicle` if it has a horizon. The sensor is mounted on it as the observation's
    /// sensor pose says or, if that is level, as the settings say (Mount.h).
    ///
    /// Throws std::runtime_error with the reason if a scan cannot be read, and SettingsError if the
    /// options do not fit its sensor.
    bool process(const mrpt::obs::CObservation& observation, Output& out,
                 const Trajectory& vehicle = Trajectory());

    /// The same for a scan with known pose. If poses are determined in the log's order, scans can
    /// be segmented in any order and by several segmenters concurrently; so can clouds whose sensor
    /// nobody names if their beams are given. Null: none
    /// were found. Not given: recovers them from the clouds it has seen.
    bool process(const mrpt::obs::CObservation& observation, Output& out, const ScanPose& pose,
                 const std::optional<SharedBeams>& beams = std::nullopt);

    /// Stores the vehicle's attitude if an observation provides it (Horizon.h). process() does this
    /// for observations that are not scans; call it for those in the same sensory frame as a scan.
    void see(const mrpt::obs::CObservation& observation) { horizon_.see(observation); }

    /// Class of the output clouds.
    CloudClass cloud_class = CloudClass::Simple;

    /// Times of each part of process(). Disabled by default; prints its report when destroyed.
    mrpt::system::CTimeLogger profiler = idleProfiler();

 private:
    static mrpt::system::CTimeLogger idleProfiler();
    SharedBeams beamsOf(const mrpt::obs::CObservation& observation);
    HagenFilter& filterOf(const std::string& label);

    Settings settings_;
    std::map<std::string, HagenFilter> filters_;  ///< by sensor label
    CloudSensors sensors_;
    Horizon horizon_;
    ObservedScan observed_;
};

/// Registers this project's classes with mrpt::rtti::classFactory(). Automatic in programs that use
/// any of them; otherwise call it before creating one by name.
void registerHagenClasses();

}  // namespace hagen::observations
