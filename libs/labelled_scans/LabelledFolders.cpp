#include <hagen/labelled_scans/LabelledFolders.h>

#include <hagen/logs/LogPoses.h>
#include <hagen/logs/ScanFolder.h>
#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>

namespace hagen::labelled_scans {
namespace {

namespace fs = std::filesystem;

/// What is known of a scan folder before its scans are read.
struct Recording {
    logs::ScanFolder folder;
    SensorModel sensor;
    evaluation::LabelMap kinds;  ///< of the --label-map or the folder; empty: not known
    bool has_label_map;          ///< true labels come through `kinds`
    bool has_kind_files;         ///< there is a folder semantic/
    std::vector<double> times_s, altitudes_m;
    observations::Trajectory sensor_poses;  ///< in the map, whose z points up
};

std::vector<std::uint16_t> readLabelsOf(const Scan& scan, const fs::path& file) {
    std::vector<std::uint16_t> labels = logs::readLabels(file);
    if (labels.size() != scan.size()) {
        throw std::runtime_error(file.string() + ": has " + std::to_string(labels.size()) +
                                 " labels for " + std::to_string(scan.size()) + " returns");
    }
    return labels;
}

void readTruth(const Recording& recording, std::size_t i, evaluation::GroundTruthScan& scan) {
    const logs::ScanFolder& folder = recording.folder;
    const bool is_by_kind = recording.has_label_map && recording.has_kind_files;
    const fs::path file = is_by_kind ? folder.kindFile(i) : folder.labelFile(i);
    const std::vector<std::uint16_t> numbers = readLabelsOf(scan.input.scan, file);
    try {
        scan.truth = recording.has_label_map ? evaluation::labelsOfClasses(numbers, recording.kinds)
                                             : evaluation::labelsOfNumbers(numbers);
    } catch (const std::invalid_argument& e) {
        throw std::runtime_error(file.string() + ": " + e.what());
    }
    if (recording.has_label_map) {
        scan.kinds = numbers;
    } else if (!recording.kinds.empty()) {
        scan.kinds = readLabelsOf(scan.input.scan, folder.kindFile(i));
    }
}

evaluation::GroundTruthScan readTrueScan(const Recording& recording, std::size_t i) {
    evaluation::GroundTruthScan scan;
    logs::readScan(recording.folder.scanFile(i), scan.input.scan);
    locateBeams(recording.sensor, scan.input.scan);
    readTruth(recording, i, scan);
    if (!recording.altitudes_m.empty()) scan.altitude_m = recording.altitudes_m[i];
    if (!recording.times_s.empty()) {
        const auto pose = recording.sensor_poses.at(mrpt::Clock::fromDouble(recording.times_s[i]));
        if (pose) {
            scan.input.map_from_sensor = pose->getRotationMatrix().asEigen().template cast<float>();
        }
    }
    return scan;
}

std::shared_ptr<const Recording> openRecording(
    const std::string& path, const MethodSet& rows,
    const std::optional<evaluation::LabelMap>& label_map) {
    Recording recording{logs::ScanFolder(path), {}, {}, label_map.has_value(), false, {}, {}, {}};
    const logs::ScanFolder& folder = recording.folder;
    recording.sensor = settingsFor(rows.filter.front().settings, folder.sensorFile()).sensorModel();
    recording.has_kind_files = fs::is_directory(folder.path() / "semantic");
    if (label_map) {
        recording.kinds = *label_map;
    } else if (recording.has_kind_files && fs::exists(folder.kindNamesFile())) {
        recording.kinds = evaluation::readLabelMap(folder.kindNamesFile());
    }
    recording.times_s = folder.times();
    recording.altitudes_m = folder.altitudes();
    // A poses.txt is relative to the first scan, which may have been tilted: no attitude.
    if (fs::exists(folder.tumFile())) {
        recording.sensor_poses = logs::posesOfScanFolder(folder, recording.times_s, {}).vehicle;
    }
    return std::make_shared<const Recording>(recording);
}

/// The last `parts` parts of a path.
std::string ending(const fs::path& path, std::size_t parts) {
    fs::path name = path.filename();
    fs::path rest = path.parent_path();
    for (std::size_t i = 1; i < parts && rest.has_filename(); ++i, rest = rest.parent_path()) {
        name = rest.filename() / name;
    }
    return name.string();
}

/// Names as short as still tells the folders apart: "00", or "beams16/00" and "beams64/00".
std::vector<std::string> namesOf(const std::vector<std::string>& folders) {
    std::vector<fs::path> paths;
    for (const std::string& folder : folders) {
        fs::path path = fs::weakly_canonical(folder);
        if (!path.has_filename()) path = path.parent_path();
        if (std::find(paths.begin(), paths.end(), path) != paths.end()) {
            throw observations::SettingsError("--input: " + folder + " is given twice");
        }
        paths.push_back(path);
    }
    std::vector<std::string> names;
    for (std::size_t parts = 1; names.size() < paths.size(); ++parts) {
        std::set<std::string> different;
        for (const fs::path& path : paths) different.insert(ending(path, parts));
        if (different.size() < paths.size()) continue;
        for (const fs::path& path : paths) names.push_back(ending(path, parts));
    }
    return names;
}

}  // namespace

std::vector<evaluation::LabelledScanSource> sourcesOf(
    const std::vector<std::string>& folders, const MethodSet& rows,
    const std::optional<evaluation::LabelMap>& label_map) {
    const std::vector<std::string> names = namesOf(folders);
    std::vector<evaluation::LabelledScanSource> sources;
    for (std::size_t f = 0; f < folders.size(); ++f) {
        const auto recording = openRecording(folders[f], rows, label_map);
        evaluation::LabelledScanSource source;
        source.name = names[f];
        source.scans = recording->folder.size();
        source.read = [recording](std::size_t i) { return readTrueScan(*recording, i); };
        source.scanName = [recording](std::size_t i) {
            return recording->folder.scanFile(i).string();
        };
        source.kinds = recording->kinds;
        source.makeMethods = [recording, rows] {
            return methodsFor(rows, recording->folder.sensorFile());
        };
        sources.push_back(source);
    }
    return sources;
}

}  // namespace hagen::labelled_scans
