#include <hagen/base/OutputPath.h>
#include <hagen/convert/Conversion.h>
#include <hagen/convert/MapOutput.h>
#include <hagen/filter/ResultCheck.h>
#include <hagen/mrpt/MrptMessage.h>
#include <hagen/mrpt/TimeStamp.h>
#include <mrpt/img/CImage.h>
#include <mrpt/io/lazy_load_path.h>
#include "base/MemoryLimit.h"
#include "base/NumberText.h"
#include "mrpt/Results.h"
#include "recordings/PoseFile.h"
#include "recordings/bags/BagFile.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <new>
#include <stdexcept>
#include <thread>

#include "convert/ConversionOutputs.h"
#include "convert/OrderedPipeline.h"
#include "convert/SegmentEntry.h"
#include "recordings/SensorCheck.h"

namespace hagen::convert {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservation;

/// Serialises a listener's calls from several threads.
ConversionListener oneAtATime(const ConversionListener& listener, std::mutex& mutex) {
    const auto locked = [&mutex](const auto& call) {
        return [&mutex, &call](const auto&... arguments) {
            const std::lock_guard lock(mutex);
            return call(arguments...);
        };
    };
    ConversionListener safe;
    safe.progress = locked(listener.progress);
    safe.remark = locked(listener.remark);
    safe.unreadable = locked(listener.unreadable);
    safe.keep_going = locked(listener.keep_going);
    return safe;
}

/// Whether to read poses. Those of a rawlog are read only if an output needs them, because that may
/// take another pass. TUM poses are cheap to read; poses of a bag are already known and provide the
/// attitude.
bool needsPoses(const Conversion& conversion) {
    const bool is_tum = !conversion.poses.empty() && recordings::kindOfPoseFile(conversion.poses) ==
                                                         recordings::PoseFileKind::Tum;
    return fs::is_directory(conversion.input) || !conversion.folder.empty() ||
           conversion.settings.options.window_scans > 1 || !conversion.octomaps.empty() ||
           !conversion.mcap.empty() || !conversion.view.empty() || is_tum ||
           recordings::isBag(conversion.input);
}

ScanReport reportOf(const ConvertedScan& scan) {
    const observations::ObservationSegmenter::Output& out = scan.segmented;
    ScanReport report{};
    report.entry = scan.recorded.entry;
    report.sensor_label = scan.recorded.observation->sensorLabel;
    report.time_s = observations::secondsOf(out.roi->timestamp);
    report.returns = out.scan->size();
    report.roi = out.roi->pointcloud->size();
    report.rou = out.non_roi->pointcloud->size();
    report.unclassified = report.returns - report.roi - report.rou;
    report.returns_masked = out.returns_masked;
    float nearest_m = std::numeric_limits<float>::infinity();
    std::int32_t obstacles = 0;
    for (const std::uint32_t i : out.result->returns.roi) {
        nearest_m = std::min(nearest_m, out.scan->range_m[i]);
        obstacles = std::max(obstacles, out.result->returns.component[i]);
    }
    report.nearest_roi_m = std::isinf(nearest_m) ? kNoValue : nearest_m;
    report.obstacles = static_cast<std::size_t>(obstacles);
    report.latency_ms = std::chrono::duration<double, std::milli>(out.time_to_labels).count();
    return report;
}

void count(const observations::ObservationSegmenter::Output& out, const ScanReport& scan,
           const std::string& title, ConversionReport& all) {
    ++all.scans;
    all.returns += scan.returns;
    all.roi += scan.roi;
    all.rou += scan.rou;
    all.unclassified += scan.unclassified;
    all.returns_masked += scan.returns_masked;
    all.scans_with_pose += out.pose.sensor_pose.has_value();
    all.scans_with_attitude += out.pose.attitude.has_value();
    if (!out.pose.attitude && all.first_without_attitude.empty())
        all.first_without_attitude = title;
    const bool is_known = !out.recovered && !out.is_sensor_assumed;
    all.sensors[scan.sensor_label] =
        is_known ? out.sensor->name + ", " + std::to_string(out.sensor->rows()) + " beams"
                 : textOf(out.recovered);
    if (out.recovered) all.recovered[scan.sensor_label] = {out.recovered, out.options->columns};
    all.scan_reports.push_back(scan);
}

/// Consecutive entries of which only the last has scans; others take less time than a wait.
struct EntryBatch {
    static constexpr std::size_t kMaxEntries = 64;

    std::vector<ConvertedEntry> entries;  ///< may have unused entries at the end
    std::size_t size = 0;
    std::exception_ptr failure;  ///< of the entry after these
    Segmenters segmenters;
    Bytes member, packed;  ///< buffers of the output rawlog

    /// Drops an entry that fails, and the later ones.
    template <class Step>
    void forEach(const Step& step) {
        for (std::size_t k = 0; k < size; ++k) {
            try {
                step(entries[k]);
            } catch (...) {
                size = k;
                failure = std::current_exception();
            }
        }
    }
};

/// A conversion in progress. Entries are segmented on several threads; all outputs and callbacks
/// follow the order of the recording.
class Converter {
 public:
    Converter(const Conversion& conversion, const ConversionListener& listener)
        : conversion_(conversion),
          listener_(oneAtATime(listener, listening_)),
          source_(openRecording(conversion.input, sourceOptions())),
          settings_(source_->useSettings(conversion.settings)),
          outputs_(conversion),
          sensor_check_(conversion.input.string()) {
        makeSegmenter(conversion, settings_);  // reports inconsistent settings before reading
        report_.settings = settings_;
        if (needsPoses(conversion)) usePoses();
    }

    ConversionReport run() {
        PipelineSteps<EntryBatch> steps;
        steps.read = [this](EntryBatch& batch) { return read(batch); };
        steps.work = [this](EntryBatch& batch) {
            batch.forEach([&](ConvertedEntry& entry) {
                segmentEntry(conversion_, settings_, batch.segmenters, entry);
            });
        };
        steps.account = [this](EntryBatch& batch) {
            batch.member.clear();
            if (has_failed_) return;
            batch.forEach([&](ConvertedEntry& entry) { writeResults(entry, batch.member); });
            has_failed_ = batch.failure != nullptr;
        };
        steps.pack = [this](EntryBatch& batch) {
            if (!batch.member.empty()) outputs_.pack(batch.member, batch.packed);
        };
        steps.write = [this](EntryBatch& batch) {
            if (!batch.member.empty()) outputs_.writeMember(batch.packed);
            if (batch.failure) std::rethrow_exception(batch.failure);
        };
        const std::size_t threads = wantedThreads();
        const PipelineEnd end = runPipeline(steps, threads);
        if (end.threads < threads) {
            listener_.remark("the system", "could start only " + std::to_string(end.threads) +
                                               " of " + std::to_string(threads) + " threads");
        }
        report_.left_out_before = source_->entriesSkipped();
        if (!outputs_.hasAny()) outputs_.commit(report_);  // throws, because all outputs failed
        if (end.why) savePartialOutputs(end.why);
        return finish();
    }

 private:
    recordings::SourceOptions sourceOptions() const {
        recordings::SourceOptions options = conversion_.source;
        if (!conversion_.rawlog.empty()) options.folder_objects = conversion_.cloud_class;
        options.keep_going = listener_.keep_going;
        return options;
    }

    void usePoses() {
        source_->usePoses(conversion_.poses);
        report_.poses = source_->poses().source;
        report_.is_attitude_of_poses = source_->poses().vehicle.has_horizon;
        if (outputs_.wantsMap() && report_.poses.empty()) {
            throw std::runtime_error(conversion_.input.string() +
                                     ": has no poses, but a map requires them; add --poses "
                                     "FILE.tum (lines 'time x y z qx qy qz qw')");
        }
    }

    /// The number of threads. A sliding window needs the scans in order. Pictures take about 1 s
    /// each and are drawn sequentially, so more threads would only read ahead and delay an
    /// interruption.
    std::size_t wantedThreads() const {
        if (!conversion_.pictures.empty() || settings_.options.window_scans > 1) return 1;
        if (conversion_.jobs > 0) return conversion_.jobs;
        return std::max(1u, std::thread::hardware_concurrency());
    }

    /// Returns false after the last batch.
    bool read(EntryBatch& batch) {
        batch.size = 0;
        batch.failure = nullptr;
        if (has_read_all_) return false;
        try {
            while (batch.size < EntryBatch::kMaxEntries && !has_read_all_) {
                if (batch.entries.size() == batch.size) batch.entries.emplace_back();
                ConvertedEntry& entry = batch.entries[batch.size];
                has_read_all_ = !read(entry);
                if (!has_read_all_) ++batch.size;
                if (!entry.scans.empty()) break;
            }
        } catch (...) {
            has_read_all_ = true;
            batch.failure = std::current_exception();
        }
        return batch.size > 0 || batch.failure;
    }

    bool read(ConvertedEntry& entry) {
        if (!outputs_.hasAny()) return false;
        auto recorded = source_->nextEntry();
        if (!recorded) return false;
        entry.fraction_read = recorded->fraction_read;
        entry.object = recorded->object;
        entry.results_replaced = 0;
        for (recordings::RecordedScan& scan : recorded->scans) {
            entry.scans.emplace_back().recorded = std::move(scan);
        }
        return true;
    }

    /// Appends complete members of the output rawlog to `member`.
    void writeResults(ConvertedEntry& entry, Bytes& member) {
        // Checked here too, because inserting into a map takes seconds, and entries read ahead
        // would delay an interruption.
        if (outputs_.wantsMap() && !listener_.keep_going()) {
            throw recordings::Interrupted("interrupted");
        }
        for (const ConvertedScan& scan : entry.scans) {
            const CObservation& observation = *scan.recorded.observation;
            if (scan.is_segmented) last_segmented_[observation.sensorLabel] = observation.timestamp;
            writeScan(scan);
        }
        if (isReplaced(entry.object)) {
            entry.bytes.clear();
            ++entry.results_replaced;
        }
        outputs_.gather(entry.bytes, member);
        entry.scans.clear();  // the MRPT objects are no longer needed
        entry.object.reset();
        ++report_.entries;
        report_.results_replaced += entry.results_replaced;
        report_.fraction = entry.fraction_read;
        listener_.progress(report_);
    }

    /// Whether an entry is a result of an earlier run that is replaced, because its scan has just
    /// been segmented again.
    bool isReplaced(const mrpt::serialization::CSerializable::Ptr& entry) const {
        const auto observation = std::dynamic_pointer_cast<CObservation>(entry);
        if (!observation || !observations::isResult(*observation)) return false;
        const auto scan = last_segmented_.find(observations::scanLabelOf(*observation));
        return scan != last_segmented_.end() && scan->second == observation->timestamp;
    }

    void writeScan(const ConvertedScan& scan) {
        const std::string title = titleOf(scan.recorded);
        if (!scan.is_segmented) {
            if (scan.unreadable_because.empty()) return;
            ++report_.unreadable_scans;
            listener_.unreadable(title, scan.unreadable_because);
            return;
        }
        remarkOn(scan, title);
        const std::string misfit = sensor_check_.see(scan.recorded, scan.segmented);
        if (!misfit.empty()) listener_.remark(title, misfit);
        if (outputs_.wantsMap()) insertIntoMap(scan, title);
        ScanReport report = reportOf(scan);
        report.name = outputs_.writeScan(scan.segmented, scan.recorded, settings_);
        outputs_.show(report, scan.segmented);
        count(scan.segmented, report, title, report_);
        const observations::ObservationSegmenter::Output& out = scan.segmented;
        result_check_.add(*out.scan, out.result->returns.label, *out.sensor, *out.options);
    }

    void remarkOn(const ConvertedScan& scan, const std::string& title) const {
        if (!scan.segmented.remark.empty()) listener_.remark(title, scan.segmented.remark);
        if (!observations::isTime(scan.recorded.observation->timestamp)) {
            listener_.remark(title, "no valid time");
        } else if (!conversion_.folder.empty() && !report_.poses.empty() &&
                   !scan.recorded.pose.sensor_pose) {
            listener_.remark(
                title,
                source_->poses().vehicle.has_horizon
                    ? "no pose near this time: missing from poses.tum, and poses.txt is "
                      "not written"
                    : "no pose near this time: no pose file is written, because poses "
                      "without a horizon require poses.txt, which needs a pose for each scan");
        }
    }

    void insertIntoMap(const ConvertedScan& scan, const std::string& title) {
        const auto placed =
            placeInMap(scan.segmented, *scan.recorded.observation, source_->poses().vehicle);
        if (!placed) {
            listener_.remark(title, "no pose near this time: not inserted into the map");
            return;
        }
        const bool has_times = !scan.segmented.scan->time_s.empty();
        if (placed->is_by_one_pose && has_times && scan.segmented.scan->size() > 0) {
            listener_.remark(title,
                             "the poses end before the scan or have a gap, or the timestamps "
                             "span more than one scan: all returns are placed in the map "
                             "with one pose");
        }
        try {
            outputs_.insertIntoMap(placed->mapped);
            ++report_.scans_in_map;
        } catch (const std::runtime_error& e) {
            listener_.remark(title, std::string(e.what()) + ": not inserted into the map");
        }
    }

    ConversionReport finish() {
        const std::size_t from = conversion_.source.first_scan, known = source_->scansKnown();
        if (report_.entries == 0 || (from > 0 && from >= known)) {
            throw std::runtime_error(conversion_.input.string() + ": has " +
                                     base::counted(known, "scan") + ", none at or after " +
                                     std::to_string(from));
        }
        checkLabels();
        finishSensorCheck();
        checkMap();
        remarkOnLabels();
        remarkOnRecording();
        outputs_.commit(report_);
        return std::move(report_);
    }

    /// A requested label without scans may be a typo. It is an error only if no scan was segmented.
    void checkLabels() const {
        for (const std::string& label : conversion_.source.sensor_labels) {
            if (report_.sensors.count(label) > 0 || report_.unreadable_scans > 0) continue;
            std::string others;
            for (const auto& [other, sensor] : report_.sensors) others += " '" + other + "'";
            for (const std::string& other : source_->otherLabels()) others += " '" + other + "'";
            const std::string what =
                "no converted entry has a LiDAR scan of '" + label + "'; " +
                (others.empty() ? "there are no LiDAR scans" : "there are" + others);
            if (report_.scans == 0) {
                throw std::runtime_error(conversion_.input.string() + ": " + what);
            }
            listener_.remark("the log", what);
        }
    }

    void finishSensorCheck() {
        const Settings::Sensor &wanted = conversion_.settings.sensor, &used = settings_.sensor;
        if (wanted.model &&
            (wanted.model != used.model || wanted.elevations_deg != used.elevations_deg)) {
            listener_.remark("the log",
                             "sensor.yaml overrides the settings' sensor.model " + *wanted.model);
        }
        for (const auto& [label, remark] : sensor_check_.finish()) {
            listener_.remark("sensor " + label, remark);
        }
        for (auto& [label, sensor] : report_.sensors) {
            const std::string fit = sensor_check_.textOf(label);
            if (!fit.empty()) sensor += ", " + fit;
        }
    }

    void checkMap() {
        if (!outputs_.wantsMap() || report_.scans == 0 || report_.scans_in_map > 0) return;
        const std::string scans =
            base::counted(report_.scans, "scan") + " of " + conversion_.input.string();
        outputs_.giveUpMap(report_.scans_with_pose == 0
                               ? report_.poses + ": has no pose near any of the " + scans +
                                     "; do the times come from another clock? No map is written"
                               : report_.poses + ": all poses place the " + scans +
                                     " outside an OctoMap; no map is written");
    }

    /// Reports results that suggest wrong settings or coordinates.
    void remarkOnLabels() {
        report_.scans_without_ground = result_check_.scansWithoutGround();
        for (const std::string& warning : result_check_.warnings()) {
            listener_.remark("WARNING", warning);
        }
        if (!settings_.airframe.parts.isEmpty() && report_.scans > 0 &&
            report_.returns_masked == 0) {
            listener_.remark("the log",
                             "the settings' airframe masks no returns; does it belong to "
                             "this vehicle, in the sensor frame?");
        }
        if (report_.returns > 0 && report_.roi + report_.rou == 0) {
            listener_.remark("the log", "no return has a range: all are unclassified");
        }
    }

    void remarkOnRecording() {
        const auto remark = [this](const char* on, const std::vector<std::string>& remarks) {
            for (const std::string& text : remarks) listener_.remark(on, text);
        };
        remark("the recording", source_->remarks());
        if (const CloudOutput* const clouds = outputs_.clouds()) {
            report_.clouds = clouds->files();
            report_.cloud_points = clouds->points();
            remark("the labelled clouds", clouds->remarks());
        }
        if (const ViewOutput* const view = outputs_.view()) {
            report_.view_frames = view->frames();
            report_.view_every = view->every();
        }
        if (const McapOutput* const mcap = outputs_.mcap()) {
            report_.mcap = {mcap->scans(), mcap->points(), mcap->boxes(), mcap->messages()};
            remark("the MCAP", mcap->remarks());
        }
    }

    /// Keeps partial outputs when the recording or the conversion ends early, and adds their
    /// location to the error. Keeps nothing after usage errors and errors before the first entry.
    [[noreturn]] void savePartialOutputs(const std::exception_ptr& end) {
        std::string why;
        bool is_interruption = false;
        try {
            std::rethrow_exception(end);
        } catch (const SettingsError&) {
            throw;
        } catch (const std::bad_alloc&) {
            if (report_.entries == 0) throw;
            why = conversion_.input.string() + ": " + base::outOfMemory();
        } catch (const std::exception& e) {
            if (report_.entries == 0) throw;
            is_interruption = dynamic_cast<const recordings::Interrupted*>(&e) != nullptr;
            why = observations::messageOf(e);
            if (why.empty()) why = e.what();
        }
        try {
            remarkOnRecording();
        } catch (const std::exception& e) {
            listener_.remark("the recording", e.what());
        }
        why += "; the " + std::to_string(report_.entries) + " preceding" +
               (fs::is_directory(conversion_.input) ? " scans" : " entries") + " are in" +
               outputs_.keepPartial(report_);
        if (is_interruption) throw recordings::Interrupted(why);
        throw recordings::BrokenRecording(why);
    }

    const Conversion& conversion_;
    std::mutex listening_;  ///< guards the listener, which another thread calls while reading
    const ConversionListener listener_;
    std::unique_ptr<recordings::ScanSource> source_;
    const Settings settings_;  ///< merged with the recording's sensor
    ConversionOutputs outputs_;
    /// Time of the last segmented scan, by sensor label.
    std::map<std::string, mrpt::Clock::time_point> last_segmented_;
    recordings::SensorCheck sensor_check_;
    ResultCheck result_check_;
    ConversionReport report_;
    bool has_read_all_ = false;
    bool has_failed_ = false;  ///< later entries are not accounted for
};

/// MRPT's folder for data in external files: "flight_Images" next to "flight.rawlog".
fs::path externalsOf(const fs::path& rawlog) {
    fs::path folder = fs::absolute(rawlog);
    folder.replace_extension();
    folder += "_Images";
    return folder;
}

/// Sets MRPT's folder for the input's external files, and reports where the output expects them.
void useExternals(const fs::path& folder, const Conversion& conversion,
                  const ConversionListener& listener) {
    mrpt::io::setLazyLoadPathBase(folder.string() + "/");
    mrpt::img::CImage::setImagesPathBase(folder.string() + "/");
    if (conversion.rawlog.empty() || externalsOf(conversion.rawlog) == folder) return;
    listener.remark("the log", "stores data in external files in " + folder.string() +
                                   "; link or copy that folder as " +
                                   externalsOf(conversion.rawlog).string());
}

/// Other outputs belong to the returns of one scan.
void checkWindow(const Conversion& c) {
    const Options& o = c.settings.options;
    const bool is_of_one_scan = c.cloud_class == observations::CloudClass::Generic ||
                                !c.folder.empty() || !c.clouds.empty() || !c.mcap.empty() ||
                                !c.pictures.empty() || !c.view.empty();
    if (o.window_scans > 1 && o.label_window && is_of_one_scan) {
        throw SettingsError(
            "label_window: only rawlogs (-o) of simple clouds and OctoMaps can contain "
            "the returns of several scans");
    }
}

}  // namespace

ConversionReport convert(const Conversion& conversion, const ConversionListener& listener) {
    if (!fs::exists(conversion.input)) {
        throw std::runtime_error(conversion.input.string() + ": no such file or folder");
    }
    checkWindow(conversion);
    std::vector<fs::path> inputs = conversion.settings.files;
    inputs.insert(inputs.end(), {conversion.input, conversion.poses, conversion.source.sensor_json,
                                 conversion.source.calibration});
    const fs::path externals = externalsOf(conversion.input);
    std::error_code no_such;  // ignored; a name with the extension may be too long
    const bool has_externals = fs::is_directory(externals, no_such);
    if (has_externals) inputs.push_back(externals);
    base::checkApart(outputsOf(conversion), inputs);
    if (has_externals && !fs::is_directory(conversion.input)) {
        useExternals(externals, conversion, listener);
    }
    return Converter(conversion, listener).run();
}

}  // namespace hagen::convert
