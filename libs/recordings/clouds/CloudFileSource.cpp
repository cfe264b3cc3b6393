#include <hagen/recordings/BrokenRecording.h>
#include "base/Folder.h"
#include "mrpt/PointFields.h"
#include "mrpt/TableCloud.h"
#include "recordings/Remarks.h"
#include "recordings/clouds/CloudFile.h"

#include <algorithm>
#include <new>
#include <set>

#include "recordings/CloudTimes.h"
#include "recordings/FileListSource.h"
#include "recordings/ScanObject.h"
#include "recordings/Sources.h"

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;
using observations::PointTable;

constexpr const char* kCloudLabel = "lidar";  // label of all clouds in files

/// The names of fields that a rawlog's cloud class cannot store; empty if all fit.
std::string fieldsNotInRawlog(const PointTable& table, observations::CloudClass cloud_class) {
    if (cloud_class == observations::CloudClass::Generic) return "";
    std::vector<const observations::PointField*> kept;
    for (const char* const name : {"x", "y", "z"}) kept.push_back(findField(table, {name}));
    if (cloud_class == observations::CloudClass::WithIntensity) {
        kept.push_back(observations::intensityFieldOf(table));
    }
    std::string names;
    for (const observations::PointField& field : table.fields) {
        if (std::find(kept.begin(), kept.end(), &field) != kept.end()) continue;
        names += (names.empty() ? "" : ", ") + field.name;
    }
    return names;
}

/// A name without extensions: "a" for a.ply, or a.pcd.bin (nuScenes).
std::string stemOf(const fs::path& file) {
    const fs::path stem = file.stem();
    return (stem.extension() == ".pcd" ? stem.stem() : stem).string();
}

class CloudFileSource : public FileListSource {
 public:
    CloudFileSource(const fs::path& file_or_folder, const SourceOptions& options)
        : FileListSource(options, kCloudLabel), files_{file_or_folder} {
        if (fs::is_directory(file_or_folder)) listFiles(file_or_folder);
        std::vector<std::string> stems;
        for (const fs::path& file : files_) stems.push_back(stemOf(file));
        CloudTimes times = timesOfNames(stems);
        times_s_ = std::move(times.times_s);
        time_remark_ = std::move(times.how);
        are_times_known_ = times.are_of_names;
        names_ = stems;
        if (std::set<std::string>(stems.begin(), stems.end()).size() == stems.size()) return;
        for (std::size_t i = 0; i < files_.size(); ++i) names_[i] = files_[i].filename().string();
    }

    std::vector<std::string> remarks() const override {
        const std::string field =
            are_times_known_ || time_field_.empty()
                ? ""
                : " (the field '" + time_field_ + "' times the points of a cloud only)";
        std::vector<std::string> remarks{time_remark_ + field};
        for (const std::string& remark : remarks_) {
            const std::size_t with_it = with_remark_.at(remark);
            remarks.push_back(remark + (with_it == clouds_
                                            ? ""
                                            : " (" + std::to_string(with_it) + " of " +
                                                  counted(clouds_, "cloud") + ")"));
        }
        if (points_not_finite_ > 0) {
            remarks.push_back(counted(points_not_finite_, "point") +
                              " with non-finite coordinates in " +
                              counted(clouds_not_finite_, "cloud") +
                              ": dropped from the scans (--clouds writes them with label 0)");
        }
        if (other_files_ > 0) {
            remarks.push_back("ignored " + counted(other_files_, "file") +
                              " without the extension .pcd, .ply, .las, .npy or .bin");
        }
        if (folders_ > 0) remarks.push_back("ignored " + counted(folders_, "subfolder"));
        return remarks;
    }

 private:
    void listFiles(const fs::path& folder) {
        std::vector<fs::path> found;
        std::vector<std::string> stems;
        for (const fs::path& entry : base::entriesOf(folder)) {
            if (fs::is_directory(entry)) {
                ++folders_;
            } else if (hasCloudName(entry)) {
                found.push_back(entry);
                stems.push_back(stemOf(entry));
            } else {
                other_files_ += entry.filename() != kCloudsMarker;
            }
        }
        files_.clear();
        for (const std::size_t i : orderOfNames(stems)) files_.push_back(found[i]);
    }

    /// The time between a cloud and its neighbour; 0 if unknown.
    double periodAt(std::size_t file) const {
        if (!are_times_known_ || times_s_.size() < 2) return 0;
        const std::size_t next = std::max<std::size_t>(file, 1);
        return times_s_[next] - times_s_[next - 1];
    }

    Cloud read(std::size_t file) override {
        const auto fail = [&](const std::string& why) {
            throw BrokenRecording(files_[file].string() + ": " + why);
        };
        try {
            file_ = readCloud(files_[file], options_.bin_fields);
            return observations::observationOf(
                std::make_shared<const PointTable>(std::move(file_.table)), kCloudLabel,
                timeOf(file), periodAt(file));
        } catch (const BrokenRecording&) {
            throw;
        } catch (const std::runtime_error& e) {
            fail(e.what());
        } catch (const std::bad_alloc&) {
            fail("does not fit into memory");
        }
        return nullptr;
    }

    mrpt::serialization::CSerializable::Ptr take(const Cloud& observation) override {
        const observations::TableCloud& cloud = *observations::tableCloudOf(*observation);
        std::vector<std::string> remarks = file_.remarks;
        remarks.insert(remarks.end(), cloud.remarks().begin(), cloud.remarks().end());
        const std::string lost = options_.folder_objects
                                     ? fieldsNotInRawlog(cloud.table(), *options_.folder_objects)
                                     : "";
        if (!lost.empty()) {
            remarks.push_back(
                "fields that the output rawlog cannot store (--cloud generic and --clouds can): " +
                lost);
        }
        for (const std::string& remark : remarks) {
            if (with_remark_[remark]++ == 0) remarks_.push_back(remark);
        }
        if (!cloud.times_s().empty()) {
            time_field_ = observations::timeFieldOf(cloud.table())->name;
        }
        ++clouds_;
        points_not_finite_ += cloud.pointsNotFinite();
        clouds_not_finite_ += cloud.pointsNotFinite() > 0;
        return objectOf(observation, options_.folder_objects);
    }

    LogPoses readPoses(const fs::path& file) override {
        RawlogSurvey survey;
        for (std::size_t i = 0; i < files_.size(); ++i) {
            survey.scans[kCloudLabel].push_back({timeOf(i), {}});
        }
        LogPoses poses = posesOfRawlog(survey, file);
        poses.are_of_sensor = true;
        return poses;
    }

    std::vector<fs::path> files_;
    std::string time_remark_, time_field_;
    bool are_times_known_ = false;
    std::size_t other_files_ = 0, folders_ = 0;  ///< files and folders beside the clouds
    CloudFile file_;
    std::size_t clouds_ = 0, points_not_finite_ = 0, clouds_not_finite_ = 0;
    std::vector<std::string> remarks_;
    std::map<std::string, std::size_t> with_remark_;  ///< clouds with each remark
};

}  // namespace

std::unique_ptr<ScanSource> openClouds(const fs::path& file_or_folder,
                                       const SourceOptions& options) {
    return std::make_unique<CloudFileSource>(file_or_folder, options);
}

}  // namespace hagen::recordings
