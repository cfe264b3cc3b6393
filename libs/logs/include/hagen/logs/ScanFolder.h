#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/range_image/Label.h>
#include <hagen/range_image/Scan.h>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace hagen::logs {

/// A scan folder as an output, or a folder of such.
extern const base::OutputKind kScanFolders;

/// A folder of scans in the KITTI layout:
///
///     velodyne/NNNNNN.bin    float32 x, y, z [m], intensity [0..1], a point after the other
///     labels/NNNNNN.label    uint32 a point, same order: low 16 bits the label (0 unclassified,
///                            1 ROU, 2 RoI), high 16 bits the RoI component (0: none)
///     semantic/NNNNNN.label  optional: uint32 a point, low 16 bits the kind of object it is of
///     kinds.yaml             optional: what those kinds are called; see evaluation/LabelMap.h
///     altitudes.txt          optional: the sensor's height above the ground [m], a line a scan
///     times.txt              optional: seconds, a line a scan
///     poses.tum              optional: the sensor in the map, by the clock of times.txt
///     poses.txt              optional: the sensor at each scan, seen from where the first was
///     taken
///                            (with a calib.txt, as KITTI's odometry benchmark has it: the camera)
///     sensor.yaml            optional: the beams of this recording
///
/// All numbers are little-endian. Functions throw std::runtime_error, naming the file.
class ScanFolder {
 public:
    /// Lists velodyne/*.bin in the order of their names. Throws where there are none.
    explicit ScanFolder(std::filesystem::path folder);

    const std::filesystem::path& path() const { return folder_; }
    std::size_t size() const { return names_.size(); }
    /// Name of a scan without its ending, "000042".
    const std::string& name(std::size_t scan) const { return names_[scan]; }
    std::filesystem::path scanFile(std::size_t scan) const;
    std::filesystem::path labelFile(std::size_t scan) const;
    /// Files of this folder that need not exist.
    std::filesystem::path kindFile(std::size_t scan) const;
    std::filesystem::path kindNamesFile() const { return folder_ / "kinds.yaml"; }
    std::filesystem::path sensorFile() const { return folder_ / "sensor.yaml"; }
    std::filesystem::path tumFile() const { return folder_ / "poses.tum"; }
    std::filesystem::path kittiPosesFile() const { return folder_ / "poses.txt"; }
    std::filesystem::path calibrationFile() const { return folder_ / "calib.txt"; }

    /// times.txt, an entry a scan; empty where there is no such file. Throws where lines and scans
    /// differ.
    std::vector<double> times() const;
    /// altitudes.txt, in the same way.
    std::vector<double> altitudes() const;

 private:
    std::filesystem::path folder_;
    std::vector<std::string> names_;
};

/// A scan that cannot be read; the message names its file.
struct BrokenScan : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Reads x, y, z and intensity; the beams remain to be located. Points that are not finite stay in.
/// Throws BrokenScan.
void readScan(const std::filesystem::path& file, Scan& scan);
void writeScan(const std::filesystem::path& file, const Scan& scan);

/// The highest component number that a label file can hold; higher ones are written as this.
constexpr std::int32_t kMaxFileComponent = 65535;

/// Reads a .label file: the low 16 bits of each entry.
std::vector<std::uint16_t> readLabels(const std::filesystem::path& file);
void writeLabels(const std::filesystem::path& file, const std::vector<Label>& labels,
                 const std::vector<std::int32_t>& components);

}  // namespace hagen::logs
