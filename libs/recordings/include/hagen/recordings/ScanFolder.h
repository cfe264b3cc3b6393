#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/recordings/BrokenRecording.h>
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::recordings {

/// Scan folders, and folders of scan folders, as outputs.
extern const base::OutputKind kScanFolders;

/// A folder of scans in the KITTI layout; docs/evaluation.md lists its files. All numbers are
/// little-endian. Poses are sensor poses, which include the mount; poses.tum has the clock of
/// times.txt. Functions throw std::runtime_error naming the file.
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
