#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/recordings/BrokenRecording.h>
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace hagen::recordings {

/// Scan folders, and folders of scan folders, as outputs.
extern const base::OutputKind kScanFolders;

/// A folder of scans in the KITTI layout:
///
///     velodyne/NNNNNN.bin    float32 x, y, z [m], intensity [0..1] per point
///     labels/NNNNNN.label    uint32 per point, same order: low 16 bits the label (0 unclassified,
///                            1 ROU, 2 RoI), high 16 bits the RoI component (0: none)
///     labels/made_by.txt     optional: the program whose predictions the labels are; otherwise
///                            they are ground truth
///     semantic/NNNNNN.label  optional: uint32 per point, low 16 bits the object class
///     kinds.yaml             optional: names of these classes; see evaluation/LabelMap.h
///     altitudes.txt          optional: sensor height above ground [m], one line per scan
///     times.txt              optional: time [s], one line per scan
///     poses.tum              optional: sensor poses in the map, with the clock of times.txt
///     poses.txt              optional: sensor pose per scan, relative to the first scan; if there
///                            is a calib.txt, camera poses as in the KITTI odometry benchmark
///     sensor.yaml            optional: beams of this recording, and the sensor's mount on the
///                            vehicle
///
/// All numbers are little-endian. Poses are sensor poses, which include the mount. Functions throw
/// std::runtime_error naming the file.
class ScanFolder {
 public:
    static constexpr const char* kMadeBy = "labels/made_by.txt";
    static constexpr const char* kSimulatedBy = "simulated_by.txt";  ///< marks true labels

    /// Lists velodyne/*.bin by name, or by number if names differ only in their numbers (9 before
    /// 10). Throws if there are no files.
    explicit ScanFolder(std::filesystem::path folder);

    const std::filesystem::path& path() const { return folder_; }
    std::size_t size() const { return names_.size(); }
    /// File name of a scan without extension, such as "000042".
    const std::string& name(std::size_t scan) const { return names_[scan]; }
    /// Names of other files in velodyne/, which are ignored.
    const std::vector<std::string>& otherFiles() const { return others_; }
    std::filesystem::path scanFile(std::size_t scan) const;
    std::filesystem::path labelFile(std::size_t scan) const;
    /// Paths of optional files.
    std::filesystem::path kindFile(std::size_t scan) const;
    std::filesystem::path kindNamesFile() const { return folder_ / "kinds.yaml"; }
    std::filesystem::path sensorFile() const { return folder_ / "sensor.yaml"; }
    std::filesystem::path tumFile() const { return folder_ / "poses.tum"; }
    std::filesystem::path kittiPosesFile() const { return folder_ / "poses.txt"; }
    std::filesystem::path calibrationFile() const { return folder_ / "calib.txt"; }

    /// True if the labels are marked as predictions (markAsPredictions()).
    bool hasPredictions() const { return std::filesystem::exists(folder_ / kMadeBy); }

    /// The times in times.txt, one per scan; kNoTime_s (TimeStamp.h) if a scan has no time; empty
    /// if the file does not exist. Throws if the number of lines differs from the number of scans.
    std::vector<double> times() const;
    /// Like times(), for altitudes.txt.
    std::vector<double> altitudes() const;

 private:
    std::filesystem::path folder_;
    std::vector<std::string> names_, others_;
};

/// Marks the labels of a scan folder as predictions by rawlog-segment.
void markAsPredictions(const std::filesystem::path& folder);

/// Reads x, y, z and intensity, including points that are not finite. Does not assign beams. If
/// points have more than 4 values (nuScenes), ignores the others and scales intensities to 0..1.
/// `bin_fields`: as in SourceOptions. Returns the number of values per point. Throws
/// BrokenRecording if the file is invalid, has another known format or seems to have other fields.
std::size_t readScan(const std::filesystem::path& file, Scan& scan,
                     const std::vector<std::string>& bin_fields = {});
void writeScan(const std::filesystem::path& file, const Scan& scan);

/// The highest component number in a label file; higher numbers are stored as this value.
constexpr std::int32_t kMaxFileComponent = 65535;

/// Reads a .label file: entire entries, or the low 16 bits of each entry.
std::vector<std::uint32_t> readLabelEntries(const std::filesystem::path& file);
std::vector<std::uint16_t> readLabels(const std::filesystem::path& file);
void writeLabels(const std::filesystem::path& file, const std::vector<Label>& labels,
                 const std::vector<std::int32_t>& components);

}  // namespace hagen::recordings
