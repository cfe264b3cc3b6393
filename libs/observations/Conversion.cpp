#include <hagen/observations/Conversion.h>
#include <hagen/observations/MrptMessage.h>
#include <hagen/observations/ObservationSegmenter.h>
#include <hagen/observations/RawlogReader.h>
#include <hagen/observations/RawlogWriter.h>
#include <hagen/observations/ScanFolder.h>
#include <hagen/observations/ScanFolderWriter.h>
#include <hagen/observations/Trajectory.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <optional>

namespace hagen {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservation;

constexpr double kDefaultScanPeriod_s = 0.1;  // of a scan folder without times

/// The outputs that were asked for.
class Outputs {
 public:
    explicit Outputs(const Conversion& conversion) {
        if (!conversion.rawlog.empty()) rawlog_.emplace(conversion.rawlog, conversion.overwrite);
        if (!conversion.folder.empty()) folder_.emplace(conversion.folder, conversion.overwrite);
    }

    void copyPoses(const fs::path& poses_file) {
        if (folder_) folder_->copyPoses(poses_file);
    }

    bool wantsRawlog() const { return rawlog_.has_value(); }

    void writeEntry(const mrpt::serialization::CSerializable& entry) {
        if (rawlog_) rawlog_->write(entry);
    }

    void writeScan(const ObservationSegmenter::Output& out, const std::string& label,
                   const std::string& name) {
        if (!folder_) return;
        if (!label_) label_ = label;
        if (label != *label_) {
            throw std::runtime_error("the log has scans of '" + *label_ + "' and of '" + label +
                                     "', but a scan folder holds those of one sensor; leave out "
                                     "--kitti");
        }
        const double time_s = mrpt::Clock::toDouble(out.roi->timestamp);
        folder_->write(*out.scan, out.result->returns, *out.sensor, time_s, name);
    }

    void commit() {
        if (rawlog_) rawlog_->commit();
        if (folder_) folder_->commit();
    }

    /// Keeps what is there under names that say it is a part, and says which.
    std::string keepPartial() {
        std::string names;
        if (rawlog_) names += " " + rawlog_->keepPartial().string();
        if (folder_) names += " " + folder_->keepPartial().string();
        return names;
    }

 private:
    std::optional<RawlogWriter> rawlog_;
    std::optional<ScanFolderWriter> folder_;
    std::optional<std::string> label_;  ///< of the scans in folder_
};

/// One conversion on its way: segments observations, and counts.
class Converter {
 public:
    Converter(const Conversion& conversion, const Settings& settings,
              const ConversionListener& listener)
        : listener_(listener), outputs_(conversion) {
        segmenter_.setMinLoggingLevel(mrpt::system::LVL_ERROR);  // remarks go to the listener
        segmenter_.initialize(settings);
    }

    Outputs& outputs() { return outputs_; }
    const ConversionReport& report() const { return report_; }

    /// Segments an observation where it is a LiDAR scan. False where there are no clouds of it.
    bool segment(const CObservation& observation, ObservationSegmenter::Output& out,
                 const std::optional<mrpt::poses::CPose3D>& pose = std::nullopt,
                 const std::string& name = "") {
        const std::string entry = "entry " + std::to_string(report_.entries) + " (" +
                                  (name.empty() ? observation.sensorLabel : name) + ")";
        try {
            if (!segmenter_.process(observation, out, pose)) return false;
        } catch (const SettingsError&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& e) {
            ++report_.unreadable_scans;
            const std::string why = messageOf(e);
            listener_.unreadable(entry, why.empty() ? "MRPT does not say why" : why);
            return false;
        }
        if (!out.remark.empty()) listener_.remark(entry, out.remark);
        count(out, observation.sensorLabel);
        outputs_.writeScan(out, observation.sensorLabel, name);
        return true;
    }

    void countEntry() {
        ++report_.entries;
        listener_.progress(report_);
    }

 private:
    void count(const ObservationSegmenter::Output& out, const std::string& label) {
        const std::size_t roi = out.roi->pointcloud->size(), rou = out.non_roi->pointcloud->size();
        ++report_.scans;
        report_.returns += out.scan->size();
        report_.roi += roi;
        report_.rou += rou;
        report_.unclassified += out.scan->size() - roi - rou;
        report_.sensors[label] =
            out.sensor->name + ", " + std::to_string(out.sensor->rows()) + " beams" +
            (out.is_sensor_assumed ? " (assumed; sensor.model in the settings names another)" : "");
    }

    const ConversionListener& listener_;
    Outputs outputs_;
    ObservationSegmenter segmenter_;
    ConversionReport report_;
};

/// One entry of a rawlog, with the clouds that come with it.
void convertEntry(const mrpt::serialization::CSerializable::Ptr& entry,
                  const Trajectory& trajectory, Converter& converter) {
    ObservationSegmenter::Output out;
    if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry)) {
        std::vector<CObservation::Ptr> clouds;
        for (const CObservation::Ptr& observation : *frame) {
            if (!converter.segment(*observation, out, trajectory.at(observation->timestamp))) {
                continue;
            }
            clouds.push_back(out.roi);
            clouds.push_back(out.non_roi);
        }
        for (const CObservation::Ptr& cloud : clouds) frame->insert(cloud);
        converter.outputs().writeEntry(*frame);
        return;
    }
    converter.outputs().writeEntry(*entry);
    const auto observation = std::dynamic_pointer_cast<CObservation>(entry);
    if (observation &&
        converter.segment(*observation, out, trajectory.at(observation->timestamp))) {
        converter.outputs().writeEntry(*out.roi);
        converter.outputs().writeEntry(*out.non_roi);
    }
}

ConversionReport convertRawlog(const Conversion& conversion, const ConversionListener& listener) {
    RawlogReader reader(conversion.input);
    Converter converter(conversion, conversion.settings, listener);
    // A pose may come after the scan it is needed for, so the log is read for them beforehand.
    const bool needs_poses = conversion.settings.options.window_scans > 1;
    const Trajectory trajectory = needs_poses ? readTrajectory(conversion.input) : Trajectory();
    try {
        while (const auto entry = reader.next()) {
            convertEntry(entry, trajectory, converter);
            converter.countEntry();
        }
    } catch (const BrokenRawlog& e) {
        if (reader.entries() == 0) throw;
        throw BrokenRawlog(std::string(e.what()) + "; the " + std::to_string(reader.entries()) +
                           " entries before it are in" + converter.outputs().keepPartial());
    }
    converter.outputs().commit();
    return converter.report();
}

mrpt::poses::CPose3D poseOf(const std::array<double, 12>& rows) {
    mrpt::math::CMatrixDouble44 matrix = mrpt::math::CMatrixDouble44::Identity();
    for (int i = 0; i < 12; ++i) matrix(i / 4, i % 4) = rows[i];
    return mrpt::poses::CPose3D(matrix);
}

ConversionReport convertFolder(const Conversion& conversion, const ConversionListener& listener) {
    const ScanFolder folder(conversion.input);
    const auto times_s = folder.times();
    const auto poses = folder.poses();
    Settings settings = conversion.settings;
    if (fs::exists(folder.sensorFile())) mergeSettings(folder.sensorFile(), settings);

    Converter converter(conversion, settings, listener);
    Scan scan;
    for (std::size_t i = 0; i < folder.size(); ++i) {
        try {
            readScan(folder.scanFile(i), scan);
        } catch (const std::runtime_error& e) {
            if (i == 0) throw;
            throw std::runtime_error(std::string(e.what()) + "; the " + std::to_string(i) +
                                     " scans before it are in" + converter.outputs().keepPartial());
        }
        const double time_s =
            times_s.empty() ? kDefaultScanPeriod_s * static_cast<double>(i) : times_s[i];
        const auto observation = observationOf(scan, "velodyne", mrpt::Clock::fromDouble(time_s));
        const auto pose = poses.empty() ? std::nullopt : std::optional(poseOf(poses[i]));
        if (converter.outputs().wantsRawlog()) {
            converter.outputs().writeEntry(*portable(*observation));
        }
        ObservationSegmenter::Output out;
        if (converter.segment(*observation, out, pose, folder.name(i))) {
            converter.outputs().writeEntry(*out.roi);
            converter.outputs().writeEntry(*out.non_roi);
        }
        converter.countEntry();
    }
    if (!poses.empty()) converter.outputs().copyPoses(folder.posesFile());
    converter.outputs().commit();
    return converter.report();
}

/// Whether `inner` is `outer`, or lies in it.
bool isWithin(const fs::path& inner, const fs::path& outer) {
    const auto resolved = [](const fs::path& path) {
        const fs::path whole = fs::weakly_canonical(fs::absolute(path));
        return whole.has_filename() ? whole : whole.parent_path();  // "folder/"
    };
    const fs::path below = resolved(inner), above = resolved(outer);
    return std::mismatch(above.begin(), above.end(), below.begin(), below.end()).first ==
           above.end();
}

void checkOutputs(const Conversion& conversion) {
    for (const fs::path& output : {conversion.rawlog, conversion.folder}) {
        if (!output.empty() && isWithin(conversion.input, output)) {
            throw std::runtime_error(output.string() +
                                     ": is the input, or holds it; give the output another name");
        }
    }
    if (!conversion.rawlog.empty() && !conversion.folder.empty() &&
        (isWithin(conversion.rawlog, conversion.folder) ||
         isWithin(conversion.folder, conversion.rawlog))) {
        throw std::runtime_error(conversion.rawlog.string() + " and " + conversion.folder.string() +
                                 ": one output lies in the other; give them apart");
    }
}

}  // namespace

ConversionReport convert(const Conversion& conversion, const ConversionListener& listener) {
    if (!fs::exists(conversion.input)) {
        throw std::runtime_error(conversion.input.string() + ": no such file or folder");
    }
    checkOutputs(conversion);
    return fs::is_directory(conversion.input) ? convertFolder(conversion, listener)
                                              : convertRawlog(conversion, listener);
}

}  // namespace hagen
