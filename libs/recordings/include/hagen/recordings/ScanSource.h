#pragma once
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/ScanPose.h>
#include <hagen/recordings/LogPoses.h>
#include <hagen/sensors/Datagram.h>
#include <hagen/settings/CloudSensors.h>
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
    mrpt::obs::CObservation::ConstPtr observation;  ///< has sensor label, time and mounting pose
    observations::ScanPose pose;
    std::size_t entry = 0;  ///< index of the scan's entry among the entries with scans
    std::string name;       ///< file name without extension; empty for rawlogs and captures
    /// The recovered beams, if the cloud's sensor is not named (useSettings()); otherwise null.
    SharedBeams beams;
};

/// An entry of a recording: an object of a rawlog, a sensor turn in a capture, or a scan of another
/// recording.
struct RecordedEntry {
    /// Index of its scan among all entries with scans; without a scan, that of the next one.
    std::size_t number = 0;
    /// The rawlog's object, the packets of a capture or bag, or a cloud of the requested class.
    mrpt::serialization::CSerializable::Ptr object;
    std::vector<RecordedScan> scans;  ///< scans of the selected LiDARs
    double fraction_read = 0;         ///< fraction of the recording up to this entry, 0 ... 1
};

/// The options of a source.
struct SourceOptions {
    std::vector<std::string> sensor_labels;  ///< LiDARs to read; all if empty
    /// First and last scan to read, both inclusive, as in RecordedEntry::number.
    std::size_t first_scan = 0;
    std::size_t last_scan = std::numeric_limits<std::size_t>::max();
    /// Class of clouds in RecordedEntry::object; if unset, clouds have no objects. Rawlogs and
    /// Velodyne packets stay unchanged.
    std::optional<observations::CloudClass> folder_objects;
    std::filesystem::path sensor_json;  ///< Ouster metadata for a capture or bag
    std::filesystem::path calibration;  ///< HDL-64E calibration for a capture
    std::vector<std::string> topics;    ///< LiDAR topics to read from a bag; all if empty
    /// Meaning of the float32 numbers of a point in .bin files (binFieldsOf()); detected if empty.
    std::vector<std::string> bin_fields;
    /// If set, called with the packets of the selected LiDARs of a rawlog or bag. The datagrams
    /// have no addresses.
    std::function<void(const std::string& sensor_label, const sensors::Datagram&)> packet;
    /// Called before each entry is read, even in advance. Returning false throws Interrupted.
    std::function<bool()> keep_going = [] { return true; };
};

/// Thrown when SourceOptions::keep_going returned false.
struct Interrupted : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Maximum number of LiDAR labels in a recording, because each label requires memory.
constexpr std::size_t kMaxLabels = 100;

/// The sensor label of all scans in a scan folder.
constexpr const char* kFolderLabel = "velodyne";

/// A recording that returns scans one by one, for conversion, open loop and evaluation:
///
///     const auto source = openRecording("flight.rawlog");
///     source->usePoses("flight.tum");
///     segmenter.initialize(source->useSettings(settings));
///     while (const auto scan = source->nextScan())
///         segmenter.process(*scan->observation, out, scan->pose, scan->beams);
class ScanSource {
 public:
    virtual ~ScanSource() = default;

    /// Returns the next selected entry, with or without scans; nullopt at the end. Throws
    /// BrokenRecording or sensors::BrokenCapture naming file and entry, or Interrupted.
    virtual std::optional<RecordedEntry> nextEntry() = 0;

    /// Returns the next scan of all selected entries; nullopt at the end. Throws like nextEntry().
    /// Do not mix both functions: only nextScan() returns the remaining scans of an entry that it
    /// has begun.
    std::optional<RecordedScan> nextScan();

    /// Uses poses from this file (TUM, KITTI), or from the recording itself if the name is empty;
    /// without this call, scans have no poses. Call it before reading the first entry. Throws
    /// std::runtime_error naming the file if it cannot be read, or Interrupted.
    void usePoses(const std::filesystem::path& file);
    const LogPoses& poses() const { return poses_; }

    /// The times of all scans of all LiDARs, by sensor label. Reads a rawlog in advance; call it
    /// before usePoses() to avoid a second pass. Throws Interrupted.
    virtual std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimes() = 0;

    /// Returns settingsFor(settings). If these name no sensor, each cloud gets the beams recovered
    /// by beamsOf(). Call it before reading the first entry.
    Settings useSettings(const Settings& settings);

    /// The beams of a LiDAR, recovered from the first clouds of the recording, even if these are
    /// not selected (CloudSensors). Null if none of its clouds has enough returns. Reads ahead as
    /// far as necessary. Throws Interrupted; nextEntry() reports read errors.
    const SharedBeams& beamsOf(const std::string& sensor_label);

    /// Returns the settings merged with those of the recording's own sensor.
    virtual Settings settingsFor(const Settings& settings) const;

    /// Number of entries with scans read so far, even skipped ones. For a folder, the total.
    virtual std::size_t scansKnown() const = 0;
    /// Remarks for the user, such as lost packets. Complete after the last entry.
    virtual std::vector<std::string> remarks() const { return {}; }

    /// Number of entries before the first selected entry.
    std::size_t entriesSkipped() const { return entries_skipped_; }
    /// Labels of unselected LiDARs with scans read so far.
    const std::set<std::string>& otherLabels() const { return other_labels_; }

 protected:
    explicit ScanSource(const SourceOptions& options) : options_(options) {}

    virtual LogPoses readPoses(const std::filesystem::path& file) = 0;

    /// Passes the next clouds to `sensors`, beginning at the start of the recording. Returns false
    /// at the end or on a read error.
    virtual bool showClouds(CloudSensors& sensors) = 0;

    /// Records the error that stopped reading ahead for poses, times or beams after `entries`
    /// entries (or other parts of the recording).
    void brokeOffAhead(std::size_t entries, const std::string& why);
    /// The error that stopped reading ahead before `entries` entries, which this pass has reached,
    /// so that poses or beams are missing; empty if there is none.
    std::string missedAhead(std::size_t entries) const;
    /// Handles the end of the recording after `entries` entries. Throws BrokenRecording unless
    /// missedAhead() is empty.
    std::optional<RecordedEntry> endAfter(std::size_t entries) const;

    /// Throws Interrupted if keep_going returns false. Call it before reading an entry.
    void checkInterruption() const;
    /// True if an entry is before the first selected entry. Counts skipped entries.
    bool skips(std::size_t entry);
    bool isSelected(const std::string& sensor_label) const;
    /// Uses the attitude in an observation, unless a pose file provides it.
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
    bool is_levelled_by_file_ = false;  ///< whether a pose file overrides the recording's attitude
    observations::Horizon horizon_;
    std::string break_ahead_;  ///< first error of reading ahead; may be empty
    std::size_t break_ahead_at_ = 0;
    std::size_t entries_skipped_ = 0;
    std::set<std::string> labels_, other_labels_;
    bool recovers_beams_ = false;
    CloudSensors sensors_;  ///< built from clouds read in advance
    std::map<std::string, SharedBeams> beams_;
    std::deque<RecordedScan> waiting_;  ///< remaining scans of nextScan()'s current entry
};

/// Opens a rawlog, a capture (.pcap, .pcapng), a ROS recording (.bag, .mcap, .db3 or its folder), a
/// scan folder, or point clouds: a file (.pcd, .ply, .las, .npy, .bin) or a folder of them. File
/// formats are detected by content. Throws std::runtime_error naming the recording if it does not
/// exist or cannot be opened, or if an option does not apply to its kind: sensor_json (captures,
/// bags), calibration (captures), topics (bags),
/// bin_fields (scan folders, clouds).
std::unique_ptr<ScanSource> openRecording(const std::filesystem::path& recording,
                                          const SourceOptions& options = {});

/// A scan's name in messages, such as "scan 12 (lidar)".
std::string titleOf(const RecordedScan& scan);

}  // namespace hagen::recordings
