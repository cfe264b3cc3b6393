#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/ScanFolder.h>

#include "recordings/FileListSource.h"
#include "recordings/Remarks.h"
#include "recordings/Sources.h"

namespace hagen::recordings {
namespace {

constexpr double kDefaultScanPeriod_s = 0.1;  // if there is no times.txt

class ScanFolderSource : public FileListSource {
 public:
    ScanFolderSource(const std::filesystem::path& folder, const SourceOptions& options)
        : FileListSource(options, kFolderLabel), folder_(folder) {
        times_s_ = folder_.times();
        for (std::size_t i = 0; i < folder_.size(); ++i) names_.push_back(folder_.name(i));
        for (std::size_t i = times_s_.size(); i < folder_.size(); ++i) {
            times_s_.push_back(kDefaultScanPeriod_s * static_cast<double>(i));
        }
    }

    std::vector<std::string> remarks() const override {
        std::vector<std::string> remarks;
        const std::string scans = (folder_.path() / "velodyne").string();
        if (has_rings_) {
            remarks.push_back("ring numbers (nuScenes) are ignored; to use them, pass " + scans +
                              " as a folder of point clouds");
        }
        const std::vector<std::string>& others = folder_.otherFiles();
        if (!others.empty()) {
            remarks.push_back("ignored " + counted(others.size(), "file") + " in " + scans +
                              " without the extension .bin, such as " + others.front());
        }
        return remarks;
    }

    Settings settingsFor(const Settings& settings) const override {
        Settings merged = settings;
        if (std::filesystem::exists(folder_.sensorFile())) {
            mergeSettings(folder_.sensorFile(), merged, SettingsOrigin::Recording);
        }
        return merged;
    }

 private:
    Cloud read(std::size_t file) override {
        floats_per_point_ = readScan(folder_.scanFile(file), scan_, options_.bin_fields);
        return observations::observationOf(scan_, kFolderLabel, timeOf(file));
    }
    mrpt::serialization::CSerializable::Ptr take(const Cloud& cloud) override {
        has_rings_ |= floats_per_point_ == 5 && options_.bin_fields.empty();
        if (!options_.folder_objects) return nullptr;
        return observations::observationOf(scan_, kFolderLabel, cloud->timestamp,
                                           *options_.folder_objects);
    }
    LogPoses readPoses(const std::filesystem::path& file) override {
        return posesOfScanFolder(folder_, times_s_, file);
    }

    ScanFolder folder_;
    Scan scan_;
    std::size_t floats_per_point_ = 4;
    bool has_rings_ = false;
};

}  // namespace

std::unique_ptr<ScanSource> openScanFolder(const std::filesystem::path& folder,
                                           const SourceOptions& options) {
    return std::make_unique<ScanFolderSource>(folder, options);
}

}  // namespace hagen::recordings
