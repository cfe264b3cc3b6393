#include "recordings/CloudFileSource.h"

#include <hagen/base/Folder.h>
#include <hagen/mrpt/TableCloud.h>
#include <hagen/recordings/CloudFile.h>
#include <hagen/recordings/PoseFile.h>

#include <algorithm>
#include <new>
#include <set>
#include <stdexcept>

#include "recordings/CloudTimes.h"
#include "recordings/ScanObject.h"

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;
using observations::PointTable;

std::string counted(std::size_t number, const std::string& what) {
    return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

/// The fields that a class of clouds in a rawlog does not hold; empty if there are none.
std::string fieldsNotInRawlog(const PointTable& table, observations::CloudClass cloud_class) {
    if (cloud_class == observations::CloudClass::Generic) return "";
    std::vector<const observations::PointField*> kept;
    for (const char* const name : {"x", "y", "z"}) kept.push_back(findField(table, {name}));
    if (cloud_class == observations::CloudClass::WithIntensity) {
        kept.push_back(findField(table, {"intensity", "i", "reflectivity", "remission"}));
    }
    std::string names;
    for (const observations::PointField& field : table.fields) {
        if (std::find(kept.begin(), kept.end(), &field) != kept.end()) continue;
        names += (names.empty() ? "" : ", ") + field.name;
    }
    return names;
}

/// A name without its ending: "a" for a.ply, and for a.pcd.bin, as nuScenes names its clouds.
std::string stemOf(const fs::path& file) {
    const fs::path stem = file.stem();
    return (stem.extension() == ".pcd" ? stem.stem() : stem).string();
}

/// In the order in which they were taken.
std::vector<fs::path> inOrder(const std::vector<fs::path>& files) {
    std::vector<std::string> stems;
    for (const fs::path& file : files) stems.push_back(stemOf(file));
    std::vector<fs::path> ordered;
    for (const std::size_t i : orderOfNames(stems)) ordered.push_back(files[i]);
    return ordered;
}

}  // namespace

CloudFileSource::CloudFileSource(const fs::path& file_or_folder, const SourceOptions& options)
    : ScanSource(options) {
    if (fs::is_directory(file_or_folder)) {
        for (const fs::path& entry : base::entriesOf(file_or_folder)) {
            if (fs::is_directory(entry)) {
                ++folders_;
            } else if (recordings::hasCloudName(entry)) {
                files_.push_back(entry);
            } else {
                other_files_ += entry.filename() != kCloudsMarker;
            }
        }
        if (files_.empty()) {
            throw std::runtime_error(file_or_folder.string() + ": contains no point cloud files");
        }
        files_ = inOrder(files_);
    } else {
        files_ = {file_or_folder};
    }
    std::set<std::string> stems;
    for (const fs::path& file : files_) stems.insert(stemOf(file));
    for (const fs::path& file : files_) {
        const bool are_unique = stems.size() == files_.size();
        names_.push_back(are_unique ? stemOf(file) : file.filename().string());
    }
    std::vector<std::string> numbered;
    for (const fs::path& file : files_) numbered.push_back(stemOf(file));
    CloudTimes times = timesOfNames(numbered);
    times_s_ = std::move(times.times_s);
    time_remark_ = std::move(times.how);
}

bool CloudFileSource::hasClouds(const fs::path& folder) {
    const std::vector<fs::path> entries = base::entriesOf(folder);
    return std::any_of(entries.begin(), entries.end(), [](const fs::path& entry) {
        return !fs::is_directory(entry) && recordings::hasCloudName(entry);
    });
}

mrpt::obs::CObservationPointCloud::Ptr CloudFileSource::read(std::size_t i) {
    try {
        recordings::CloudFile file = recordings::readCloud(files_[i]);
        auto table = std::make_shared<const PointTable>(std::move(file.table));
        auto observation = observations::observationOf(std::move(table), kCloudLabel,
                                                       mrpt::Clock::fromDouble(times_s_[i]));
        const observations::TableCloud& cloud = *observations::tableCloudOf(*observation);
        std::vector<std::string> remarks = file.remarks;
        remarks.insert(remarks.end(), cloud.remarks().begin(), cloud.remarks().end());
        if (!file.viewpoint.empty()) {
            remarks.push_back(
                "the file has a VIEWPOINT, which is not used: points are taken to be in the "
                "sensor's frame");
        }
        if (options_.folder_objects) {
            const std::string lost = fieldsNotInRawlog(cloud.table(), *options_.folder_objects);
            if (!lost.empty()) {
                remarks.push_back(
                    "fields that the output rawlog does not hold (--cloud generic and --clouds "
                    "do): " +
                    lost);
            }
        }
        for (const std::string& remark : remarks) {
            if (with_remark_[remark]++ == 0) remarks_.push_back(remark);
        }
        ++clouds_;
        points_not_finite_ += cloud.pointsNotFinite();
        clouds_with_them_ += cloud.pointsNotFinite() > 0;
        return observation;
    } catch (const recordings::BrokenCloud& e) {
        throw BrokenScan(e.what());
    } catch (const std::runtime_error& e) {
        throw BrokenScan(files_[i].string() + ": " + e.what());
    } catch (const std::bad_alloc&) {
        throw BrokenScan(files_[i].string() + ": does not fit into memory");
    }
}

std::optional<RecordedEntry> CloudFileSource::nextEntry() {
    while (next_ < files_.size() && next_ <= options_.last_entry) {
        const std::size_t i = next_++;
        checkInterruption();
        if (skips(i)) continue;
        const auto observation = read(i);
        RecordedEntry entry;
        entry.number = i;
        entry.fraction_read = static_cast<double>(i + 1) / static_cast<double>(files_.size());
        entry.object = objectOf(observation, options_.folder_objects);
        addIfScan(observation, names_[i], entry);
        return entry;
    }
    const std::string missed = missedAhead(next_);
    if (!missed.empty()) throw BrokenScan(missed);
    return std::nullopt;
}

std::map<std::string, std::vector<mrpt::Clock::time_point>> CloudFileSource::scanTimes() {
    std::vector<mrpt::Clock::time_point> times;
    for (const double time_s : times_s_) times.push_back(mrpt::Clock::fromDouble(time_s));
    return {{kCloudLabel, times}};
}

LogPoses CloudFileSource::readPoses(const fs::path& file) {
    RawlogSurvey survey;
    for (const double time_s : times_s_) {
        survey.scans[kCloudLabel].push_back({mrpt::Clock::fromDouble(time_s), {}});
    }
    LogPoses poses = posesOfRawlog(survey, file);
    poses.are_of_sensor = true;
    return poses;
}

bool CloudFileSource::showClouds(observations::CloudSensors& sensors) {
    if (next_shown_ >= files_.size()) return false;
    const std::size_t i = next_shown_++;
    try {
        recordings::CloudFile file = recordings::readCloud(files_[i]);
        sensors.see(
            *observations::observationOf(std::make_shared<const PointTable>(std::move(file.table)),
                                         kCloudLabel, mrpt::Clock::fromDouble(times_s_[i])));
    } catch (const std::runtime_error& e) {
        if (i >= options_.first_entry) brokeOffAhead(i, e.what());
    } catch (const std::bad_alloc&) {
        const std::string why = files_[i].string() + ": does not fit into memory";
        if (i >= options_.first_entry) brokeOffAhead(i, why);
    }
    return true;
}

std::vector<std::string> CloudFileSource::remarks() const {
    std::vector<std::string> remarks{time_remark_};
    for (const std::string& remark : remarks_) {
        const std::size_t with_it = with_remark_.at(remark);
        remarks.push_back(with_it == clouds_ ? remark
                                             : remark + " (" + std::to_string(with_it) + " of " +
                                                   counted(clouds_, "cloud") + ")");
    }
    if (points_not_finite_ > 0) {
        remarks.push_back(counted(points_not_finite_, "point") +
                          " with a coordinate that is not finite, in " +
                          counted(clouds_with_them_, "cloud") +
                          ": left out of the scans (--clouds writes them, with the label 0)");
    }
    if (other_files_ > 0) {
        remarks.push_back(counted(other_files_, "file") +
                          " of the folder with another ending than .pcd, .ply, .las, .npy and "
                          ".bin: not read");
    }
    if (folders_ > 0) remarks.push_back(counted(folders_, "folder") + " in the folder: not read");
    return remarks;
}

}  // namespace hagen::recordings
