#include "evaluation/labelled_folders/LabelledFolders.h"
#include "base/NumberText.h"

#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/recordings/ScanSource.h>
#include <algorithm>
#include "base/Folder.h"

namespace hagen::evaluation {
namespace {

namespace fs = std::filesystem;

void checkSize(const Scan& scan, std::size_t labels, const fs::path& file) {
    if (labels == scan.size()) return;
    throw std::runtime_error(file.string() + ": has " + base::counted(labels, "label") + " for " +
                             base::counted(scan.size(), "return"));
}

std::vector<std::uint16_t> readLabelsOf(const Scan& scan, const fs::path& file) {
    std::vector<std::uint16_t> labels = recordings::readLabels(file);
    checkSize(scan, labels.size(), file);
    return labels;
}

/// Returns the entries of the first of these files that has object numbers in the high 16 bits; 0
/// for returns without a number; empty if no file has numbers. Entire entries identify objects,
/// because SemanticKITTI numbers each class separately.
std::vector<std::uint32_t> readObjectsOf(const Scan& scan, const std::vector<fs::path>& files) {
    for (const fs::path& file : files) {
        if (!fs::exists(file)) continue;
        std::vector<std::uint32_t> entries = recordings::readLabelEntries(file);
        checkSize(scan, entries.size(), file);
        bool has_numbers = false;
        for (std::uint32_t& entry : entries) {
            if (entry >> 16 == 0) entry = 0;
            has_numbers = has_numbers || entry != 0;
        }
        if (has_numbers) return entries;
    }
    return {};
}

/// A scan folder: the recording and its ground-truth labels.
class LabelledFolder : public LabelledScanSource {
 public:
    LabelledFolder(const std::string& path, const std::string& name, const MethodSet& methods,
                   const std::optional<LabelMap>& label_map, bool is_only);

    std::optional<GroundTruthScan> next() override;
    const std::string& name() const override { return name_; }
    std::size_t size() const override { return folder_.size(); }
    const LabelMap& kinds() const override { return kinds_; }
    SensorModel sensor() const override { return settings_.sensorModel(beams_.get()); }
    std::string sensorText() const override;
    std::vector<std::string> remarks() const override;
    Settings settingsFor(const Settings& asked) const;
    std::vector<Method> makeMethods() const override;

 private:
    void readTruth(std::size_t i, GroundTruthScan& scan) const;
    std::vector<std::string> labelsWithoutScans() const;

    std::string name_;
    std::unique_ptr<recordings::ScanSource> scans_;  ///< opened first: suggests other folders
    recordings::ScanFolder folder_;
    MethodSet methods_;
    std::vector<fs::path> label_folders_;  ///< label files for methods_.labels
    Settings settings_;
    SharedBeams beams_;    ///< recovered beams; null if the settings name the sensor
    LabelMap kinds_;       ///< from --label-map or the folder; empty if unknown
    bool has_label_map_;   ///< whether ground-truth labels are derived with `kinds_`
    bool has_kind_files_;  ///< whether the folder semantic/ exists
    std::vector<double> altitudes_m_;
    std::size_t read_ = 0, with_pose_ = 0;  ///< number of scans
    observations::ObservedScan observed_;
};

LabelledFolder::LabelledFolder(const std::string& path, const std::string& name,
                               const MethodSet& methods, const std::optional<LabelMap>& label_map,
                               bool is_only)
    : name_(name),
      scans_(recordings::openRecording(path)),
      folder_(path),
      methods_(methods),
      settings_(scans_->useSettings(methods.filter.front().settings)),
      has_label_map_(label_map.has_value()),
      has_kind_files_(fs::is_directory(folder_.path() / "semantic")),
      altitudes_m_(folder_.altitudes()) {
    const bool is_by_kind = has_label_map_ && has_kind_files_;
    if (!is_by_kind && folder_.hasPredictions()) {
        throw std::runtime_error(path + ": its labels are predictions (" +
                                 recordings::ScanFolder::kMadeBy +
                                 "), not ground truth; score them with --labels NAME=" + path +
                                 " against the folder that has the ground truth");
    }
    if (label_map) {
        kinds_ = *label_map;
    } else if (has_kind_files_ && fs::exists(folder_.kindNamesFile())) {
        kinds_ = readLabelMap(folder_.kindNamesFile());
    }
    for (const LabelRow& row : methods_.labels) {
        label_folders_.push_back(labelFilesOf(row, folder_, name_, is_only));
    }
    if (!settings_.sensor.model) beams_ = scans_->beamsOf(recordings::kFolderLabel);
    // Poses cannot be assigned to scans without times.
    const bool has_poses = fs::exists(folder_.tumFile()) && !folder_.times().empty();
    // A poses.txt is relative to the first scan, which may be tilted, so it provides no attitude.
    if (has_poses) scans_->usePoses({});
}

std::vector<Method> LabelledFolder::makeMethods() const {
    std::vector<Method> methods = methodsFor(methods_, folder_.sensorFile(), beams_);
    for (std::size_t row = 0; row < label_folders_.size(); ++row) {
        methods.push_back(labelFileMethod(methods_.labels[row].name, label_folders_[row]));
    }
    return methods;
}

std::string LabelledFolder::sensorText() const {
    return settings_.sensor.model ? "" : textOf(beams_);
}

Settings LabelledFolder::settingsFor(const Settings& asked) const {
    Settings settings = scans_->settingsFor(asked);
    settings.options = settings.optionsFor(beams_.get());
    return settings;
}

std::vector<std::string> LabelledFolder::labelsWithoutScans() const {
    std::set<std::string> scans;
    for (std::size_t i = 0; i < folder_.size(); ++i) scans.insert(folder_.name(i));
    std::vector<std::string> remarks;
    for (const char* labels : {"labels", "semantic"}) {
        std::size_t others = 0;
        std::string first;
        std::error_code none;  // ignored: the folder may be missing
        for (const fs::path& file : base::entriesOf(folder_.path() / labels, none)) {
            if (file.extension() != ".label" || scans.count(file.stem().string()) > 0) continue;
            const std::string name = file.filename().string();
            if (others++ == 0 || name < first) first = name;
        }
        if (others == 0) continue;
        remarks.push_back("files without a scan in " + (folder_.path() / labels).string() + ": " +
                          std::to_string(others) + ", such as " + first);
    }
    return remarks;
}

std::vector<std::string> LabelledFolder::remarks() const {
    std::vector<std::string> remarks = scans_->remarks();
    for (const std::string& remark : labelsWithoutScans()) remarks.push_back(remark);
    if (!fs::exists(folder_.tumFile())) return remarks;
    const std::string poses = folder_.tumFile().string();
    if (folder_.times().empty()) {
        remarks.push_back(poses + " is ignored, because there is no times.txt");
    } else if (with_pose_ < read_) {
        remarks.push_back(
            poses + " covers " + std::to_string(with_pose_) + " of " +
            base::counted(read_, "scan") + "; the others are " +
            (settings_.tiltOnLevelVehicle() ? "levelled by the mount only" : "not levelled"));
    }
    return remarks;
}

void LabelledFolder::readTruth(std::size_t i, GroundTruthScan& scan) const {
    const bool is_by_kind = has_label_map_ && has_kind_files_;
    const fs::path file = is_by_kind ? folder_.kindFile(i) : folder_.labelFile(i);
    const std::vector<std::uint16_t> numbers = readLabelsOf(scan.input.scan, file);
    try {
        scan.truth = has_label_map_ ? labelsOfClasses(numbers, kinds_) : labelsOfNumbers(numbers);
    } catch (const std::invalid_argument& e) {
        throw std::runtime_error(file.string() + ": " + e.what());
    }
    if (has_label_map_) {
        scan.kinds = numbers;
    } else if (!kinds_.empty()) {
        scan.kinds = readLabelsOf(scan.input.scan, folder_.kindFile(i));
    }
    // The numbers in predictions come from the filter itself.
    std::vector<fs::path> numbered{folder_.kindFile(i)};
    if (!folder_.hasPredictions()) numbered.insert(numbered.begin(), folder_.labelFile(i));
    scan.objects = readObjectsOf(scan.input.scan, numbered);
}

std::optional<GroundTruthScan> LabelledFolder::next() {
    const auto recorded = scans_->nextScan();
    if (!recorded) return std::nullopt;
    observations::readObservation(*recorded->observation, settings_, observed_, beams_);
    GroundTruthScan scan;
    scan.name = folder_.scanFile(recorded->entry).string();
    scan.input.name = folder_.name(recorded->entry);
    scan.input.scan = observed_.scan;
    readTruth(recorded->entry, scan);
    if (!altitudes_m_.empty()) scan.altitude_m = altitudes_m_[recorded->entry];
    ++read_;
    if (recorded->pose.sensor_pose) {
        ++with_pose_;
        scan.input.map_from_sensor =
            recorded->pose.sensor_pose->getRotationMatrix().asEigen().template cast<float>();
    } else if (const auto tilt = settings_.tiltOnLevelVehicle()) {
        scan.true_level_from_sensor = levelFromSensor(*tilt);
    }
    return scan;
}

/// The last `parts` components of a path.
std::string ending(const fs::path& path, std::size_t parts) {
    fs::path name = path.filename();
    fs::path rest = path.parent_path();
    for (std::size_t i = 1; i < parts && rest.has_filename(); ++i, rest = rest.parent_path()) {
        name = rest.filename() / name;
    }
    return name.string();
}

/// The shortest distinct names of the folders: "00", or "beams16/00" and "beams64/00".
std::vector<std::string> namesOf(const std::vector<std::string>& folders) {
    std::vector<fs::path> paths;
    for (const std::string& folder : folders) {
        fs::path path = fs::weakly_canonical(folder);
        if (!path.has_filename()) path = path.parent_path();
        if (std::find(paths.begin(), paths.end(), path) != paths.end()) {
            throw SettingsError("--input: " + folder + " is given twice");
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

LabelledScanSources sourcesOf(const std::vector<std::string>& folders, const MethodSet& rows,
                              const std::optional<LabelMap>& label_map) {
    const std::vector<std::string> names = namesOf(folders);
    LabelledScanSources sources;
    for (std::size_t f = 0; f < folders.size(); ++f) {
        sources.push_back(std::make_unique<LabelledFolder>(folders[f], names[f], rows, label_map,
                                                           folders.size() == 1));
    }
    return sources;
}

Settings settingsOf(const LabelledScanSource& source, const Settings& asked) {
    return dynamic_cast<const LabelledFolder&>(source).settingsFor(asked);
}

}  // namespace hagen::evaluation
