#include <hagen/logs/Conversion.h>
#include <hagen/logs/LogPoses.h>
#include <hagen/logs/PoseFile.h>
#include <hagen/logs/RawlogReader.h>
#include <hagen/logs/RawlogSurvey.h>
#include <hagen/logs/ScanFolder.h>
#include <hagen/observations/MrptMessage.h>
#include <hagen/observations/ScenePreview.h>
#include <mrpt/img/CImage.h>
#include <mrpt/io/lazy_load_path.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <set>

#include "ConversionOutputs.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservation;

constexpr double kDefaultScanPeriod_s = 0.1;  // of a scan folder without times

/// The report of one scan, but for what only the converter knows of it.
ScanReport reportOf(const ObservationSegmenter::Output& out) {
    ScanReport report{};
    report.time_s = mrpt::Clock::toDouble(out.roi->timestamp);
    report.returns = out.scan->size();
    report.roi = out.roi->pointcloud->size();
    report.rou = out.non_roi->pointcloud->size();
    report.unclassified = report.returns - report.roi - report.rou;
    report.nearest_roi_m = kNoValue;
    std::int32_t obstacles = 0;
    for (const std::uint32_t i : out.result->returns.roi) {
        if (i >= out.scan->size()) break;  // ascending; the rest are older scans' of the window
        report.nearest_roi_m = std::fmin(report.nearest_roi_m, out.scan->range_m[i]);
        obstacles = std::max(obstacles, out.result->returns.component[i]);
    }
    report.obstacles = static_cast<std::size_t>(obstacles);
    return report;
}

/// One conversion on its way: segments observations, and counts.
class Converter {
 public:
    using Clouds = std::vector<CObservation::Ptr>;

    Converter(const Conversion& conversion, const Settings& settings,
              const ConversionListener& listener)
        : conversion_(conversion), listener_(listener), outputs_(conversion) {
        report_.settings = settings;
        segmenter_.setMinLoggingLevel(mrpt::system::LVL_ERROR);  // remarks go to the listener
        segmenter_.cloud_class = conversion.cloud_class;
        segmenter_.initialize(settings);
    }

    void setPoses(const LogPoses& poses) {
        vehicle_ = poses.vehicle;
        report_.poses = poses.source;
        levels_by_file_ = !conversion_.poses.empty() && poses.vehicle.has_horizon;
    }

    /// Whether the entry is one to convert; counts those that are not.
    bool takes(std::size_t entry) {
        if (!listener_.keep_going()) throw Interrupted("interrupted");
        entry_ = entry;
        if (entry < conversion_.from) ++report_.left_out_before;
        return entry >= conversion_.from;
    }
    bool isBeyond(std::size_t entry) const { return entry > conversion_.to; }

    ConversionOutputs& outputs() { return outputs_; }

    /// Notes what an observation tells of the vehicle.
    void see(const CObservation& observation) {
        if (!levels_by_file_) segmenter_.see(observation);
    }

    /// Segments an observation where it is a LiDAR scan: what comes after it in the log. `name`: of
    /// the scan in its folder.
    Clouds segment(const CObservation& observation, const std::string& name = "") {
        if (!isWanted(observation)) return {};
        const std::string entry = "entry " + std::to_string(entry_) + " (" +
                                  (name.empty() ? observation.sensorLabel : name) + ")";
        ObservationSegmenter::Output out;
        const auto start = std::chrono::steady_clock::now();
        try {
            if (!segmenter_.process(observation, out, vehicle_)) return {};
        } catch (const SettingsError&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& e) {
            ++report_.unreadable_scans;
            const std::string why = messageOf(e);
            listener_.unreadable(entry, why.empty() ? "MRPT does not say why" : why);
            return {};
        }
        const std::chrono::duration<double, std::milli> latency =
            std::chrono::steady_clock::now() - start;
        if (!out.remark.empty()) listener_.remark(entry, out.remark);
        if (!conversion_.folder.empty() && !report_.poses.empty() && !out.sensor_pose) {
            listener_.remark(entry,
                             "no pose is near its time: poses.tum leaves it out, and "
                             "poses.txt is not written");
        }

        const std::string& label = observation.sensorLabel;
        ScanReport scan = reportOf(out);
        scan.entry = entry_;
        scan.sensor_label = label;
        scan.latency_ms = latency.count();
        scan.name = outputs_.writeScan(out, label, name, report_.settings.options);
        count(out, scan);
        Clouds clouds{out.roi, out.non_roi};
        if (conversion_.preview && outputs_.wantsRawlog()) {
            clouds.push_back(previewOf(observation, out, report_.settings.options.zone_m));
        }
        return clouds;
    }

    void countEntry(double fraction) {
        ++report_.entries;
        report_.fraction = fraction;
        listener_.progress(report_);
    }

    /// Ends it well. `entries` of the input were seen.
    ConversionReport finish(std::size_t entries) {
        if (report_.entries == 0) {
            throw std::runtime_error(conversion_.input.string() + ": has " +
                                     std::to_string(entries) + " entries, none from " +
                                     std::to_string(conversion_.from) + " on");
        }
        checkLabels();
        outputs_.commit(report_);
        return report_;
    }

    /// Ends it early: says why, and where what was done before is kept.
    template <class Error>
    [[noreturn]] void endEarly(const Error& why, const std::string& what) {
        if (report_.entries == 0) throw why;
        throw Error(std::string(why.what()) + "; the " + std::to_string(report_.entries) + " " +
                    what + " before it are in" + outputs_.keepPartial(report_));
    }

 private:
    bool isWanted(const CObservation& observation) {
        if (!isLidarScan(observation)) return false;
        const std::string& label = observation.sensorLabel;
        const auto& wanted = conversion_.sensor_labels;
        if (wanted.empty()) return true;
        if (std::find(wanted.begin(), wanted.end(), label) != wanted.end()) return true;
        other_labels_.insert(label);
        return false;
    }

    /// A label of which there is no scan may be a slip of the pen. It fails the conversion where
    /// nothing else was segmented.
    void checkLabels() const {
        for (const std::string& label : conversion_.sensor_labels) {
            const bool is_there = report_.sensors.count(label) > 0;
            if (is_there || report_.unreadable_scans > 0) continue;
            std::string others;
            for (const auto& [other, sensor] : report_.sensors) others += " '" + other + "'";
            for (const std::string& other : other_labels_) others += " '" + other + "'";
            const std::string what = "has no LiDAR scan of '" + label +
                                     "' in what was converted; " +
                                     (others.empty() ? "there is none" : "there are" + others);
            if (report_.scans == 0) {
                throw std::runtime_error(conversion_.input.string() + ": " + what);
            }
            listener_.remark("the log", what);
        }
    }

    void count(const ObservationSegmenter::Output& out, const ScanReport& scan) {
        ++report_.scans;
        report_.returns += scan.returns;
        report_.roi += scan.roi;
        report_.rou += scan.rou;
        report_.unclassified += scan.unclassified;
        report_.scans_with_pose += out.sensor_pose.has_value();
        report_.scans_with_attitude += out.attitude.has_value();
        report_.sensors[scan.sensor_label] =
            out.sensor->name + ", " + std::to_string(out.sensor->rows()) + " beams" +
            (out.is_sensor_assumed ? " (assumed; sensor.model in the settings names another)" : "");
        report_.scan_reports.push_back(scan);
    }

    const Conversion& conversion_;
    const ConversionListener& listener_;
    bool levels_by_file_ = false;  ///< poses that the user gave win over what the log tells
    Trajectory vehicle_;
    ConversionOutputs outputs_;
    ObservationSegmenter segmenter_;
    ConversionReport report_;
    std::size_t entry_ = 0;
    std::set<std::string> other_labels_;  ///< of LiDAR scans that were not wanted
};

/// Notes what an entry tells of the vehicle.
void seeEntry(const mrpt::serialization::CSerializable::Ptr& entry, Converter& converter) {
    if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry)) {
        for (const CObservation::Ptr& observation : *frame) converter.see(*observation);
    } else if (const auto observation = std::dynamic_pointer_cast<CObservation>(entry)) {
        converter.see(*observation);
    }
}

/// One entry of a rawlog, with the clouds that come with it.
void convertEntry(const mrpt::serialization::CSerializable::Ptr& entry, Converter& converter) {
    seeEntry(entry, converter);
    if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry)) {
        Converter::Clouds clouds;
        for (const CObservation::Ptr& observation : *frame) {
            const Converter::Clouds own = converter.segment(*observation);
            clouds.insert(clouds.end(), own.begin(), own.end());
        }
        for (const CObservation::Ptr& cloud : clouds) frame->insert(cloud);
        converter.outputs().writeEntry(*frame);
        return;
    }
    converter.outputs().writeEntry(*entry);
    if (const auto observation = std::dynamic_pointer_cast<CObservation>(entry)) {
        for (const CObservation::Ptr& cloud : converter.segment(*observation)) {
            converter.outputs().writeEntry(*cloud);
        }
    }
}

bool needsPoses(const Conversion& conversion) {
    const Options& options = conversion.settings.options;
    const bool can_level = options.level_by_attitude && !conversion.poses.empty() &&
                           kindOfPoseFile(conversion.poses) == PoseFileKind::Tum;
    return options.window_scans > 1 || !conversion.folder.empty() || can_level;
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
        converter.setPoses(posesOfRawlog(surveyFor(conversion, listener), conversion.poses));
    }
    try {
        while (!converter.isBeyond(reader.entries())) {
            const bool is_taken = converter.takes(reader.entries());
            const auto entry = reader.next();
            if (!entry) break;
            if (!is_taken) {
                seeEntry(entry, converter);  // the first scan that is taken may need it
                continue;
            }
            convertEntry(entry, converter);
            converter.countEntry(reader.fractionRead());
        }
    } catch (const BrokenRawlog& e) {
        converter.endEarly(e, "entries");
    } catch (const Interrupted& e) {
        converter.endEarly(e, "entries");
    }
    return converter.finish(reader.entries());
}

ConversionReport convertFolder(const Conversion& conversion, const ConversionListener& listener) {
    const ScanFolder folder(conversion.input);
    std::vector<double> times_s = folder.times();
    for (std::size_t i = times_s.size(); i < folder.size(); ++i) {
        times_s.push_back(kDefaultScanPeriod_s * static_cast<double>(i));
    }
    Settings settings = conversion.settings;
    if (fs::exists(folder.sensorFile())) mergeSettings(folder.sensorFile(), settings);

    Converter converter(conversion, settings, listener);
    converter.setPoses(posesOfScanFolder(folder, times_s, conversion.poses));
    Scan scan;
    try {
        for (std::size_t i = 0; i < folder.size() && !converter.isBeyond(i); ++i) {
            if (!converter.takes(i)) continue;
            readScan(folder.scanFile(i), scan);
            const auto time = mrpt::Clock::fromDouble(times_s[i]);
            if (converter.outputs().wantsRawlog()) {
                converter.outputs().writeEntry(
                    *observationOf(scan, "velodyne", time, conversion.cloud_class));
            }
            const auto observation = observationOf(scan, "velodyne", time);
            for (const auto& cloud : converter.segment(*observation, folder.name(i))) {
                converter.outputs().writeEntry(*cloud);
            }
            converter.countEntry(static_cast<double>(i + 1) / static_cast<double>(folder.size()));
        }
    } catch (const BrokenScan& e) {
        converter.endEarly(e, "scans");
    } catch (const Interrupted& e) {
        converter.endEarly(e, "scans");
    }
    return converter.finish(folder.size());
}

}  // namespace

ConversionReport convert(const Conversion& conversion, const ConversionListener& listener) {
    if (!fs::exists(conversion.input)) {
        throw std::runtime_error(conversion.input.string() + ": no such file or folder");
    }
    checkApart({conversion.rawlog, conversion.folder, conversion.pictures, conversion.stats},
               {conversion.input, conversion.poses});
    return fs::is_directory(conversion.input) ? convertFolder(conversion, listener)
                                              : convertRawlog(conversion, listener);
}

}  // namespace hagen
