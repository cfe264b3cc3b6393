#include <hagen/mrpt/TimeStamp.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/scan/MostReturns.h>
#include <algorithm>
#include <array>
#include <new>
#include <set>
#include "recordings/NumberTable.h"

#include "base/Folder.h"
#include "base/WriteFile.h"
#include "recordings/CloudTimes.h"
#include "recordings/Remarks.h"
#include "recordings/clouds/Readers.h"

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;

// The formats are little-endian, like all platforms of MRPT packages except s390x.
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "label and scan files need byte swapping");

/// Number of points in a file of this size. Throws BrokenRecording if it is not an integer.
std::size_t checkedCount(const fs::path& file, std::size_t bytes, std::size_t bytes_per_point) {
    if (bytes % bytes_per_point != 0) {
        throw BrokenRecording(file.string() + ": " + std::to_string(bytes) +
                              " bytes are not a multiple of " + std::to_string(bytes_per_point) +
                              "-byte points; is it truncated?");
    }
    if (bytes / bytes_per_point > kMaxReturns) {
        throw BrokenRecording(file.string() + ": has more than " + std::to_string(kMaxReturns) +
                              " points, the maximum for a scan");
    }
    return bytes / bytes_per_point;
}

template <class Record>
void writeRecords(const fs::path& file, const std::vector<Record>& records) {
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(records.data()),
              static_cast<std::streamsize>(records.size() * sizeof(Record)));
    base::closeWritten(out, file);
}

/// Reads a file with one number per scan; empty if the file does not exist.
std::vector<double> readNumberPerScan(const fs::path& file, const std::string& unit,
                                      std::size_t scans) {
    std::vector<double> numbers;
    if (!fs::exists(file)) return numbers;
    for (const NumberLine& line : readNumberTable(file)) {
        checkColumns(file, line, 1, unit);
        numbers.push_back(line.numbers[0]);
    }
    if (numbers.size() != scans) {
        throw std::runtime_error(file.string() + ": has " + counted(numbers.size(), "line") +
                                 " for " + counted(scans, "scan"));
    }
    return numbers;
}

}  // namespace

const base::OutputKind kScanFolders{
    "a scan folder",
    [](const fs::path& within) {
        static const std::set<std::string> kFiles{"times.txt",
                                                  "poses.txt",
                                                  "poses.tum",
                                                  "kinds.yaml",
                                                  "altitudes.txt",
                                                  "sensor.yaml",
                                                  ScanFolder::kSimulatedBy};
        const fs::path folder = within.parent_path().filename();
        return (folder / within.filename() == ScanFolder::kMadeBy) ||
               (folder == "velodyne" && within.extension() == ".bin") ||
               ((folder == "labels" || folder == "semantic") && within.extension() == ".label") ||
               kFiles.count(within.filename().string()) > 0;
    },
    nullptr,
    // True if the folder or all of its subfolders (one per sensor) have a marker file.
    [](const fs::path& folder) {
        const auto isMade = [](const fs::path& of_sensor) {
            return fs::exists(of_sensor / ScanFolder::kMadeBy) ||
                   fs::exists(of_sensor / ScanFolder::kSimulatedBy);
        };
        if (isMade(folder)) return true;
        const std::vector<fs::path> entries = base::entriesOf(folder);
        return std::all_of(entries.begin(), entries.end(), isMade);
    }};

ScanFolder::ScanFolder(fs::path folder) : folder_(std::move(folder)) {
    const fs::path scans = folder_ / "velodyne";
    if (!fs::is_directory(scans)) {
        throw std::runtime_error(folder_.string() +
                                 ": not a scan folder (no subfolder 'velodyne' with .bin files)");
    }
    for (const fs::path& file : base::entriesOf(scans)) {
        if (file.extension() == ".bin") {
            names_.push_back(file.stem().string());
        } else {
            others_.push_back(file.filename().string());
        }
    }
    if (names_.empty()) throw std::runtime_error(scans.string() + ": contains no .bin files");
    std::vector<std::string> ordered;
    for (const std::size_t i : orderOfNames(names_)) ordered.push_back(std::move(names_[i]));
    names_ = std::move(ordered);
    std::sort(others_.begin(), others_.end());
}

fs::path ScanFolder::scanFile(std::size_t scan) const {
    return folder_ / "velodyne" / (names_[scan] + ".bin");
}

fs::path ScanFolder::labelFile(std::size_t scan) const {
    return folder_ / "labels" / (names_[scan] + ".label");
}

fs::path ScanFolder::kindFile(std::size_t scan) const {
    return folder_ / "semantic" / (names_[scan] + ".label");
}

std::vector<double> ScanFolder::times() const {
    const fs::path file = folder_ / "times.txt";
    std::vector<double> times_s = readNumberPerScan(file, "seconds", size());
    for (const double time_s : times_s) {
        if (observations::isTime(time_s) || time_s == observations::kNoTime_s) continue;
        throw std::runtime_error(file.string() + ": " + std::to_string(time_s) +
                                 " s is not a plausible time");
    }
    return times_s;
}

std::vector<double> ScanFolder::altitudes() const {
    return readNumberPerScan(folder_ / "altitudes.txt", "metres", size());
}

void markAsPredictions(const fs::path& folder) {
    const fs::path file = folder / ScanFolder::kMadeBy;
    std::ofstream out(file);
    out << "rawlog-segment: these labels are predictions, not ground truth\n";
    base::closeWritten(out, file);
}

std::size_t readScan(const fs::path& file, Scan& scan, const std::vector<std::string>& bin_fields) {
    try {
        const Bytes bytes = readBytes(file);
        // Points may exceed the range of a LiDAR.
        const bool is_far = bin_fields.empty() && binNumbersPerPoint(bytes) == 0 &&
                            !mayBeBin(bytes) && otherKindOf(bytes).empty();
        const CloudFile cloud =
            readBin(file, bytes, is_far ? BinFields{"x", "y", "z", "intensity"} : bin_fields);
        const auto columnOf = [&](const char* name) {
            const auto* const field = findExactly(cloud.table, name);
            if (field == nullptr) return std::vector<float>(cloud.table.points);
            const std::vector<double> column = observations::columnOf(cloud.table, *field);
            return std::vector<float>(column.begin(), column.end());
        };
        scan.clear();
        scan.x_m = columnOf("x");
        scan.y_m = columnOf("y");
        scan.z_m = columnOf("z");
        scan.intensity = columnOf("intensity");
        const auto max = std::max_element(scan.intensity.begin(), scan.intensity.end());
        const std::size_t numbers = cloud.table.bytes_per_point / sizeof(float);
        const bool is_scaled = numbers > kKittiNumbers && max != scan.intensity.end() && *max > 1;
        for (float& intensity : scan.intensity) intensity /= is_scaled ? 255.0f : 1.0f;
        return numbers;
    } catch (const std::bad_alloc&) {
        throw BrokenRecording(file.string() + ": does not fit into memory");
    }
}

void writeScan(const fs::path& file, const Scan& scan) {
    std::vector<std::array<float, 4>> points(scan.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
        points[i] = {scan.x_m[i], scan.y_m[i], scan.z_m[i], scan.intensity[i]};
    }
    writeRecords(file, points);
}

std::vector<std::uint32_t> readLabelEntries(const fs::path& file) {
    const Bytes bytes = readBytes(file);
    std::vector<std::uint32_t> entries(checkedCount(file, bytes.size(), sizeof(std::uint32_t)));
    if (!bytes.empty()) std::memcpy(entries.data(), bytes.data(), bytes.size());
    return entries;
}

std::vector<std::uint16_t> readLabels(const fs::path& file) {
    const std::vector<std::uint32_t> entries = readLabelEntries(file);
    std::vector<std::uint16_t> labels(entries.size());
    std::transform(entries.begin(), entries.end(), labels.begin(),
                   [](std::uint32_t entry) { return static_cast<std::uint16_t>(entry & 0xffff); });
    return labels;
}

void writeLabels(const fs::path& file, const std::vector<Label>& labels,
                 const std::vector<std::int32_t>& components) {
    std::vector<std::uint32_t> entries(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const auto component =
            static_cast<std::uint32_t>(std::min(components[i], kMaxFileComponent));
        entries[i] = component << 16 | static_cast<std::uint32_t>(labels[i]);
    }
    writeRecords(file, entries);
}

}  // namespace hagen::recordings
