#include <hagen/logs/Conversion.h>
#include <hagen/logs/LogPoses.h>
#include <hagen/logs/PoseFile.h>
#include <hagen/logs/RawlogReader.h>
#include <hagen/logs/RawlogSurvey.h>
#include <hagen/logs/ScanFolder.h>
#include <mrpt/img/CImage.h>
#include <mrpt/io/lazy_load_path.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>

#include "Converter.h"

namespace hagen::logs {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservation;

constexpr double kDefaultScanPeriod_s = 0.1;  // of a scan folder without times

/// Each observation of an entry, which is one itself, or a frame of several.
template <class Visit>
void forEachObservation(const mrpt::serialization::CSerializable::Ptr& entry, const Visit& visit) {
    if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry)) {
        for (const CObservation::Ptr& observation : *frame) visit(observation);
    } else if (const auto observation = std::dynamic_pointer_cast<CObservation>(entry)) {
        visit(observation);
    }
}

/// Poses with times tell all by themselves: the log need not be read beforehand.
bool isTumGiven(const Conversion& conversion) {
    return !conversion.poses.empty() && kindOfPoseFile(conversion.poses) == PoseFileKind::Tum;
}

bool needsPoses(const Conversion& conversion) {
    const Options& options = conversion.settings.options;
    const bool can_level = options.level_by_attitude && isTumGiven(conversion);
    return options.window_scans > 1 || !conversion.folder.empty() || !conversion.octomaps.empty() ||
           can_level;
}

/// The survey, with the LiDARs that are segmented alone.
RawlogSurvey surveyFor(const Conversion& conversion, const ConversionListener& listener) {
    RawlogSurvey survey = surveyRawlog(conversion.input, listener.keep_going);
    const auto& wanted = conversion.sensor_labels;
    if (wanted.empty()) return survey;
    for (auto scan = survey.scans.begin(); scan != survey.scans.end();) {
        const bool is_wanted = std::find(wanted.begin(), wanted.end(), scan->first) != wanted.end();
        scan = is_wanted ? std::next(scan) : survey.scans.erase(scan);
    }
    return survey;
}

/// Where MRPT keeps what a log holds in files of their own: "flight_Images" beside "flight.rawlog".
fs::path externalsOf(const fs::path& rawlog) {
    fs::path folder = fs::absolute(rawlog);
    folder.replace_extension();
    folder += "_Images";
    return folder;
}

/// Lets MRPT find the input's external files, and says where the output will look for them.
void useExternals(const Conversion& conversion, const ConversionListener& listener) {
    const fs::path folder = externalsOf(conversion.input);
    if (!fs::is_directory(folder)) return;
    mrpt::io::setLazyLoadPathBase(folder.string() + "/");
    mrpt::img::CImage::setImagesPathBase(folder.string() + "/");
    if (conversion.rawlog.empty() || externalsOf(conversion.rawlog) == folder) return;
    listener.remark("the log", "keeps data in files of " + folder.string() +
                                   "; link or copy that folder as " +
                                   externalsOf(conversion.rawlog).string());
}

ConversionReport convertRawlog(const Conversion& conversion, const ConversionListener& listener) {
    RawlogReader reader(conversion.input);
    useExternals(conversion, listener);
    Converter converter(conversion, conversion.settings, listener);
    if (needsPoses(conversion)) {
        const RawlogSurvey survey =
            isTumGiven(conversion) ? RawlogSurvey() : surveyFor(conversion, listener);
        converter.setPoses(posesOfRawlog(survey, conversion.poses));
    }
    const auto read = [&](EntryOnItsWay& entry) {
        while (!converter.isBeyond(reader.entries())) {
            entry.number = reader.entries();
            const bool is_taken = converter.takes(entry.number);
            entry.object = reader.next();
            if (!entry.object) return false;
            // What is not taken may tell what the first scan that is needs to know.
            forEachObservation(entry.object,
                               [&](const auto& observation) { converter.see(*observation); });
            if (!is_taken) continue;
            forEachObservation(entry.object,
                               [&](const auto& observation) { converter.add(observation, entry); });
            entry.fraction = reader.fractionRead();
            return true;
        }
        return false;
    };
    converter.run(read, "entries");
    return converter.finish(reader.entries());
}

ConversionReport convertFolder(const Conversion& conversion, const ConversionListener& listener) {
    const ScanFolder folder(conversion.input);
    std::vector<double> times_s = folder.times();
    for (std::size_t i = times_s.size(); i < folder.size(); ++i) {
        times_s.push_back(kDefaultScanPeriod_s * static_cast<double>(i));
    }
    observations::Settings settings = conversion.settings;
    if (fs::exists(folder.sensorFile())) observations::mergeSettings(folder.sensorFile(), settings);

    Converter converter(conversion, settings, listener);
    converter.setPoses(posesOfScanFolder(folder, times_s, conversion.poses));
    Scan scan;
    std::size_t next = 0;
    const auto read = [&](EntryOnItsWay& entry) {
        while (next < folder.size() && !converter.isBeyond(next)) {
            const std::size_t i = next++;
            if (!converter.takes(i)) continue;
            readScan(folder.scanFile(i), scan);
            const auto time = mrpt::Clock::fromDouble(times_s[i]);
            entry.number = i;
            entry.fraction = static_cast<double>(i + 1) / static_cast<double>(folder.size());
            if (converter.wantsRawlog()) {
                entry.object =
                    observations::observationOf(scan, "velodyne", time, conversion.cloud_class);
            }
            converter.add(observations::observationOf(scan, "velodyne", time), entry,
                          folder.name(i));
            return true;
        }
        return false;
    };
    converter.run(read, "scans");
    return converter.finish(folder.size());
}

}  // namespace

ConversionReport convert(const Conversion& conversion, const ConversionListener& listener) {
    if (!fs::exists(conversion.input)) {
        throw std::runtime_error(conversion.input.string() + ": no such file or folder");
    }
    std::vector<fs::path> outputs = conversion.octomaps;
    outputs.insert(outputs.end(),
                   {conversion.rawlog, conversion.folder, conversion.pictures, conversion.stats});
    base::checkApart(outputs, {conversion.input, conversion.poses});
    return fs::is_directory(conversion.input) ? convertFolder(conversion, listener)
                                              : convertRawlog(conversion, listener);
}

}  // namespace hagen::logs
