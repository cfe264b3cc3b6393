#pragma once
#include <hagen/mrpt/CloudSensors.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/ScanPose.h>
#include <hagen/recordings/LogPoses.h>
#include <hagen/settings/Settings.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CSerializable.h>

#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace hagen::recordings {

/// A LiDAR scan of a recording.
struct RecordedScan {
    mrpt::obs::CObservation::ConstPtr observation;  ///< with sensor label, time and mounting pose
    observations::ScanPose pose;
    std::size_t entry = 0;  ///< index of the scan's entry in the recording
    std::string name;       ///< file name without extension; empty for rawlogs and captures
    /// The recovered beams of a cloud from an unnamed sensor; null otherwise (useSettings()).
    observations::SharedBeams beams;
};

/// An entry of a recording: an object of a rawlog, a turn of a sensor in a capture, or a scan of
/// any other recording.
struct RecordedEntry {
    std::size_t number = 0;  ///< index in the recording
    /// The rawlog's object, the packets of a capture or bag, or a cloud of the requested class.
    mrpt::serialization::CSerializable::Ptr object;
    std::vector<RecordedScan> scans;  ///< scans of the selected LiDARs
    double fraction_read = 0;         ///< of the recording, including this entry: 0 ... 1
};

/// The options of a source.
struct SourceOptions {
    std::vector<std::string> sensor_labels;  ///< LiDARs to read; empty: all
    std::size_t first_entry = 0;             ///< first and last entry to read, both inclusive
    std::size_t last_entry = std::numeric_limits<std::size_t>::max();
    /// Class of the clouds in RecordedEntry::object; none: no objects for clouds. Rawlogs and
    /// Velodyne packets are kept unchanged.
    std::optional<observations::CloudClass> folder_objects;
    std::filesystem::path sensor_json;  ///< Ouster metadata for a capture or bag; empty: none
    std::filesystem::path calibration;  ///< HDL-64E calibration for a capture; empty: none
    std::vector<std::string> topics;    ///< LiDAR topics to read from a bag; empty: all
    /// Called before each entry is read, also in advance; false stops reading with Interrupted.
    std::function<bool()> keep_going = [] { return true; };
};

/// SourceOptions::keep_going stopped reading.
struct Interrupted : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Maximum number of LiDAR labels in a recording; each requires memory.
constexpr std::size_t kMaxLabels = 100;

/// The sensor label of all scans in a scan folder.
constexpr const char* kFolderLabel = "velodyne";

/// A recording that provides scans one by one, for conversion, open loop and evaluation:
///
///     const auto source = openRecording("flight.rawlog");
///     source->usePoses("flight.tum");
///     segmenter.initialize(source->useSettings(settings));
///     while (const auto scan = source->nextScan())
///         segmenter.process(*scan->observation, out, scan->pose, scan->beams);
class ScanSource {
 public:
    virtual ~ScanSource() = default;

    /// The next selected entry, with or without scans; none at the end. Throws BrokenRecording or
    /// sensors::BrokenCapture naming file and entry, and Interrupted.
    virtual std::optional<RecordedEntry> nextEntry() = 0;

    /// The next scan of any entry; none at the end. Throws like nextEntry(). Use only one of the
    /// two: only nextScan() returns the remaining scans of an entry that it has begun.
    std::optional<RecordedScan> nextScan();

    /// Uses poses from this file (TUM, KITTI), or from the recording itself if the name is empty;
    /// without this call, scans have no poses. Call it before the first entry is read. Throws
    /// std::runtime_error naming the file if it cannot be read, and Interrupted.
    void usePoses(const std::filesystem::path& file);
    const LogPoses& poses() const { return poses_; }

    /// The times of all scans of all LiDARs, by sensor label. Reads a rawlog in advance; call this
    /// before usePoses() to avoid a second pass. Throws Interrupted.
    virtual std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimes() = 0;

    /// Returns settingsFor(settings). If these name no sensor, each cloud has the beams that
    /// beamsOf() recovers. Call it before the first entry is read.
    Settings useSettings(const Settings& settings);

    /// The beams of a LiDAR's clouds, recovered from the first clouds in the recording, selected or
    /// not (CloudSensors). Null if none of its clouds has enough returns. Reads ahead as far as
    /// necessary. Throws Interrupted; nextEntry() reports read errors.
    const observations::SharedBeams& beamsOf(const std::string& sensor_label);

    /// The settings, merged with those of the recording's own sensor.
    virtual Settings settingsFor(const Settings& settings) const;

    /// Entries read so far, including skipped ones. For a scan folder: all entries.
    virtual std::size_t entriesKnown() const = 0;
    /// Remarks for the user on the recording as a whole, such as lost packets; complete after the
    /// last entry.
    virtual std::vector<std::string> remarks() const { return {}; }

    /// Entries before the first selected entry.
    std::size_t entriesSkipped() const { return entries_skipped_; }
    /// Sensor labels of LiDAR scans read so far that are not selected.
    const std::set<std::string>& otherLabels() const { return other_labels_; }

 protected:
    explicit ScanSource(const SourceOptions& options) : options_(options) {}

    virtual LogPoses readPoses(const std::filesystem::path& file) = 0;

    /// Passes the next clouds to `sensors`, from the start of the recording on. Returns false at
    /// the end or at a read error.
    virtual bool showClouds(observations::CloudSensors& sensors) = 0;

    /// Notes the error that stopped reading ahead for poses, times or beams after `entries` entries
    /// (or other parts of the recording).
    void brokeOffAhead(std::size_t entries, const std::string& why);
    /// The error that stopped reading ahead before `entries` entries, which this pass reached, so
    /// that poses or beams are missing. Empty: none.
    std::string missedAhead(std::size_t entries) const;
    /// Handles the end of the recording after `entries` entries. Throws BrokenRecording if
    /// missedAhead().
    std::optional<RecordedEntry> endAfter(std::size_t entries) const;

    /// Call it before reading an entry. Throws Interrupted.
    void checkInterruption() const;
    /// True if an entry is before the first selected entry; counts such entries.
    bool skips(std::size_t entry);
    bool isSelected(const std::string& sensor_label) const;
    /// Takes the attitude from an observation, unless a pose file provides it.
    void see(const mrpt::obs::CObservation& observation);
    /// Adds the observation to its entry if it is a scan of a selected LiDAR.
    void addIfScan(const mrpt::obs::CObservation::ConstPtr& observation, const std::string& name,
                   RecordedEntry& entry);

    const SourceOptions options_;

 private:
    friend std::unique_ptr<ScanSource> openRecording(const std::filesystem::path& recording,
                                                     const SourceOptions& options);

    std::filesystem::path recording_;
    LogPoses poses_;
    bool is_levelled_by_file_ = false;  ///< a pose file overrides the recording's attitude
    observations::Horizon horizon_;
    std::string break_ahead_;  ///< the first error of reading ahead; empty: none
    std::size_t break_ahead_at_ = 0;
    std::size_t entries_skipped_ = 0;
    std::set<std::string> labels_, other_labels_;
    bool recovers_beams_ = false;
    observations::CloudSensors sensors_;  ///< from clouds read in advance
    std::map<std::string, observations::SharedBeams> beams_;
    std::deque<RecordedScan> waiting_;  ///< remaining scans of nextScan()'s last entry
};

/// Opens a rawlog, a capture (.pcap, .pcapng), a ROS recording (.bag, .mcap, .db3 or its folder), a
/// scan folder, or point clouds: a file (.pcd, .ply, .las, .npy, .bin) or a folder of them. File
/// formats are detected by content. Throws std::runtime_error naming the recording if it does not
/// exist or cannot be opened, or if an option does not apply to its kind: sensor_json (captures,
/// bags), calibration (captures), topics (bags).
std::unique_ptr<ScanSource> openRecording(const std::filesystem::path& recording,
                                          const SourceOptions& options = {});

/// "entry 12 (lidar)", for messages about a scan.
std::string titleOf(const RecordedScan& scan);

}  // namespace hagen::recordings
