#include "convert/Converter.h"

#include <hagen/base/MemoryLimit.h>
#include <hagen/base/OutputPath.h>
#include <hagen/mrpt/MrptMessage.h>
#include <hagen/mrpt/Results.h>
#include <hagen/mrpt/ScenePreview.h>
#include <hagen/mrpt/TimeStamp.h>
#include <hagen/recordings/BagFile.h>
#include <hagen/recordings/PoseFile.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/sensors/CaptureFile.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

#include "convert/LabelledTable.h"
#include "convert/OrderedPipeline.h"
#include "recordings/ScanObject.h"

namespace hagen::convert {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservation;

/// The report of one scan, without the fields that only the converter knows.
ScanReport reportOf(const observations::ObservationSegmenter::Output& out) {
    ScanReport report{};
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

/// TUM poses are cheap to read: they do not depend on the log.
bool hasTumFile(const Conversion& conversion) {
    return !conversion.poses.empty() &&
           recordings::kindOfPoseFile(conversion.poses) == recordings::PoseFileKind::Tum;
}

/// Poses of a rawlog are read only if an output needs them, as they may cost another pass. Those of
/// a bag are known already, and provide the attitude.
bool needsPoses(const Conversion& conversion) {
    return fs::is_directory(conversion.input) || !conversion.folder.empty() ||
           !conversion.octomaps.empty() || !conversion.mcap.empty() || hasTumFile(conversion) ||
           recordings::isBag(conversion.input);
}

/// Clouds with all fields need the observation's, and are made afterwards.
observations::CloudClass classOfSegmenters(const Conversion& conversion) {
    return conversion.cloud_class == observations::CloudClass::Generic
               ? observations::CloudClass::Simple
               : conversion.cloud_class;
}

/// Takes out of a sensory frame what an earlier run made of its scans: the new results replace it.
/// Results of other LiDARs stay, and so do those of a scan that could not be segmented this time.
void takeOutResults(EntryInConversion& entry) {
    const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry.object);
    if (!frame) return;
    const auto isReplaced = [&](const CObservation& part) {
        return observations::isResult(part) &&
               std::any_of(entry.scans.begin(), entry.scans.end(), [&](const auto& scan) {
                   const CObservation& of = *scan.recorded.observation;
                   return scan.is_segmented && of.timestamp == part.timestamp &&
                          of.sensorLabel == observations::scanLabelOf(part);
               });
    };
    for (auto part = frame->begin(); part != frame->end();) {
        const bool is_replaced = isReplaced(**part);
        entry.results_replaced += is_replaced;
        part = is_replaced ? frame->erase(part) : std::next(part);
    }
}

/// Settings that do not fit a later sensor: the user has to change them and start again.
bool isWrongUsage(const std::exception_ptr& end) {
    try {
        std::rethrow_exception(end);
    } catch (const SettingsError&) {
        return true;
    } catch (...) {
        return false;
    }
}

}  // namespace

Converter::Converter(const Conversion& conversion, const ConversionListener& listener)
    : conversion_(conversion),
      listener_(listener),
      source_(openRecording(conversion.input, sourceOptions())),
      settings_(source_->useSettings(conversion.settings)),
      outputs_(conversion),
      segmenters_(settings_, classOfSegmenters(conversion)),
      sensor_check_(conversion.input.string()) {
    report_.settings = settings_;
    if (needsPoses(conversion_)) usePoses();
}

recordings::SourceOptions Converter::sourceOptions() {
    recordings::SourceOptions options;
    options.sensor_labels = conversion_.sensor_labels;
    options.sensor_json = conversion_.sensor_json;
    options.calibration = conversion_.calibration;
    options.topics = conversion_.topics;
    options.first_entry = conversion_.from;
    options.last_entry = conversion_.to;
    if (!conversion_.rawlog.empty()) options.folder_objects = conversion_.cloud_class;
    options.keep_going = [this] {
        const std::lock_guard lock(listener_mutex_);
        return listener_.keep_going();
    };
    return options;
}

void Converter::usePoses() {
    source_->usePoses(conversion_.poses);
    report_.poses = source_->poses().source;
    report_.is_attitude_of_poses = source_->poses().vehicle.has_horizon;
    if (outputs_.wantsMap() && report_.poses.empty()) {
        throw std::runtime_error(conversion_.input.string() +
                                 ": has no poses, but a map needs them; add --poses "
                                 "FILE.tum (lines 'time x y z qx qy qz qw')");
    }
}

// Reading, in the recording's order.

bool Converter::read(EntryInConversion& entry) {
    if (has_ended_) return false;
    try {
        auto recorded = source_->nextEntry();
        if (!recorded) return false;
        entry.fraction_read = recorded->fraction_read;
        entry.object = recorded->object;
        entry.results_replaced = 0;
        for (recordings::RecordedScan& scan : recorded->scans) {
            entry.scans.emplace_back().recorded = std::move(scan);
        }
        return true;
    } catch (...) {
        reading_ended_ = std::current_exception();  // after the entries before are converted
        return false;
    }
}

// Segmentation, on any thread.

void Converter::segment(ScanInConversion& scan) {
    const CObservation& observation = *scan.recorded.observation;
    scan.segmenter = segmenters_.lease();
    try {
        scan.is_segmented = scan.segmenter->process(observation, scan.segmented, scan.recorded.pose,
                                                    scan.recorded.beams);
    } catch (const SettingsError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        scan.unreadable_because = observations::messageOf(e);
        if (scan.unreadable_because.empty()) scan.unreadable_because = "MRPT gives no reason";
    }
    if (!scan.is_segmented || !outputs_.wantsRawlog()) return;
    if (conversion_.cloud_class == observations::CloudClass::Generic) {
        useCloudsWithFields(observation, scan.segmented);
    }
    if (conversion_.preview) {
        scan.preview =
            observations::previewOf(observation, scan.segmented, settings_.options.zone_m);
    }
}

void Converter::serialiseAll(EntryInConversion& entry) const {
    entry.bytes.clear();
    if (!outputs_.wantsRawlog()) return;
    if (entry.object && conversion_.cloud_class == observations::CloudClass::Generic) {
        recordings::keepFields(entry.object);
    }
    std::vector<CObservation::Ptr> added;
    for (const ScanInConversion& scan : entry.scans) {
        if (!scan.is_segmented) continue;
        added.push_back(scan.segmented.roi);
        added.push_back(scan.segmented.non_roi);
        if (scan.preview) added.push_back(scan.preview);
    }
    if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry.object)) {
        for (const CObservation::Ptr& observation : added) frame->insert(observation);
        added.clear();
    }
    if (entry.object) serialise(*entry.object, entry.bytes);
    for (const CObservation::Ptr& observation : added) serialise(*observation, entry.bytes);
}

void Converter::segment(EntryInConversion& entry) {
    try {
        for (ScanInConversion& scan : entry.scans) segment(scan);
        takeOutResults(entry);
        serialiseAll(entry);
    } catch (...) {
        entry.failure = std::current_exception();
    }
}

// Results, in the recording's order.

void Converter::reportRemarks(const ScanInConversion& scan) {
    const std::string title = titleOf(scan.recorded);
    const std::lock_guard lock(listener_mutex_);
    if (!scan.is_segmented) {
        if (!scan.unreadable_because.empty()) listener_.unreadable(title, scan.unreadable_because);
        return;
    }
    if (!scan.segmented.remark.empty()) listener_.remark(title, scan.segmented.remark);
    if (!observations::isTime(scan.recorded.observation->timestamp)) {
        listener_.remark(title, "it has no valid time");
    } else if (!conversion_.folder.empty() && !report_.poses.empty() &&
               !scan.recorded.pose.sensor_pose) {
        listener_.remark(
            title, source_->poses().vehicle.has_horizon
                       ? "no pose near its time: it is missing from poses.tum, and poses.txt is "
                         "not written"
                       : "no pose near its time: no file of poses is written, because poses "
                         "without a horizon go into poses.txt, which needs one for each scan");
    }
}

void Converter::insertIntoMap(const ScanInConversion& scan) {
    const auto placed =
        placeInMap(scan.segmented, *scan.recorded.observation, source_->poses().vehicle);
    std::string why = "no pose near its time";
    if (placed) {
        const bool has_times = !scan.segmented.scan->time_s.empty();
        if (placed->is_by_one_pose && has_times && scan.segmented.scan->size() > 0) {
            const std::lock_guard lock(listener_mutex_);
            listener_.remark(
                titleOf(scan.recorded),
                "the poses end before it does or leave a gap in it, or the times of its returns "
                "are none of one scan: in the map, all are placed with one pose");
        }
        try {
            outputs_.insertIntoMap(placed->mapped);
            ++report_.scans_in_map;
            return;
        } catch (const std::runtime_error& e) {
            why = e.what();
        }
    }
    const std::lock_guard lock(listener_mutex_);
    listener_.remark(titleOf(scan.recorded), why + ": it is not in the map");
}

void Converter::checkSensor(const ScanInConversion& scan) {
    const std::string remark = sensor_check_.see(scan.recorded, scan.segmented);
    if (remark.empty()) return;
    const std::lock_guard lock(listener_mutex_);
    listener_.remark(titleOf(scan.recorded), remark);
}

void Converter::account(ScanInConversion& scan) {
    if (!scan.is_segmented && !scan.unreadable_because.empty()) ++report_.unreadable_scans;
    reportRemarks(scan);
    if (scan.is_segmented) {
        checkSensor(scan);
        if (outputs_.wantsMap()) insertIntoMap(scan);
        ScanReport report = reportOf(scan.segmented);
        report.entry = scan.recorded.entry;
        report.sensor_label = scan.recorded.observation->sensorLabel;
        report.name = outputs_.writeScan(scan.segmented, scan.recorded, settings_);
        count(scan.segmented, report, titleOf(scan.recorded));
    }
    scan.segmenter.reset();
}

/// Whether an entry is a result of an earlier run whose scan, before it, was segmented again.
bool Converter::isReplaced(const EntryInConversion& entry) const {
    const auto observation = std::dynamic_pointer_cast<CObservation>(entry.object);
    if (!observation || !observations::isResult(*observation)) return false;
    const auto scan = last_segmented_.find(observations::scanLabelOf(*observation));
    return scan != last_segmented_.end() && scan->second == observation->timestamp;
}

/// Accounts for an entry, unless one before it ended the conversion.
void Converter::accountInOrder(EntryInConversion& entry) {
    entry.member.clear();
    if (accounting_ended_) return;
    try {
        account(entry);
        // Without outputs there is nothing to go on for; run() tells why there are none.
        has_ended_ = has_ended_ || !outputs_.hasAny();
    } catch (...) {
        accounting_ended_ = std::current_exception();
        has_ended_ = true;
    }
}

void Converter::account(EntryInConversion& entry) {
    if (entry.failure) std::rethrow_exception(entry.failure);
    if (outputs_.wantsMap()) {  // what was read ahead may take seconds each to insert
        const std::lock_guard lock(listener_mutex_);
        if (!listener_.keep_going()) throw recordings::Interrupted("interrupted");
    }
    for (ScanInConversion& scan : entry.scans) {
        const CObservation& observation = *scan.recorded.observation;
        if (scan.is_segmented) last_segmented_[observation.sensorLabel] = observation.timestamp;
        account(scan);
    }
    if (isReplaced(entry)) {
        entry.bytes.clear();
        ++entry.results_replaced;
    }
    outputs_.gather(entry.bytes, entry.member);
    // The MRPT objects are no longer needed.
    entry.scans.clear();
    entry.object.reset();

    ++report_.entries;
    report_.results_replaced += entry.results_replaced;
    report_.fraction = entry.fraction_read;
    const std::lock_guard lock(listener_mutex_);
    listener_.progress(report_);
}

void Converter::count(const observations::ObservationSegmenter::Output& out, const ScanReport& scan,
                      const std::string& title) {
    ++report_.scans;
    report_.returns += scan.returns;
    report_.roi += scan.roi;
    report_.rou += scan.rou;
    report_.unclassified += scan.unclassified;
    report_.returns_masked += scan.returns_masked;
    report_.scans_with_pose += out.pose.sensor_pose.has_value();
    report_.scans_with_attitude += out.pose.attitude.has_value();
    if (!out.pose.attitude && report_.first_without_attitude.empty()) {
        report_.first_without_attitude = title;
    }
    const bool is_known = !out.recovered && !out.is_sensor_assumed;
    report_.sensors[scan.sensor_label] =
        is_known ? out.sensor->name + ", " + std::to_string(out.sensor->rows()) + " beams"
                 : observations::textOf(out.recovered);
    if (out.recovered) {
        report_.recovered[scan.sensor_label] = {out.recovered, out.options->columns};
    }
    report_.scan_reports.push_back(scan);
}

// The whole conversion.

ConversionReport Converter::run() {
    PipelineSteps<EntryInConversion> steps;
    steps.read = [this](EntryInConversion& entry) { return read(entry); };
    steps.work = [this](EntryInConversion& entry) { segment(entry); };
    steps.account = [this](EntryInConversion& entry) { accountInOrder(entry); };
    steps.pack = [this](EntryInConversion& entry) {
        if (!entry.member.empty()) outputs_.pack(entry.member, entry.packed);
    };
    steps.write = [this](EntryInConversion& entry) {
        if (!entry.member.empty()) outputs_.writeMember(entry.packed);
    };
    // Pictures take a second each and are drawn sequentially. More threads would only read ahead,
    // and delay an interruption.
    const std::size_t max_threads = conversion_.jobs == 0 ? coreCount() : conversion_.jobs;
    const std::size_t wanted = conversion_.pictures.empty() ? max_threads : 1;
    const std::size_t threads = runPipeline(steps, wanted);
    if (threads < wanted) {
        listener_.remark("the machine", "does not start " + std::to_string(wanted) + " threads; " +
                                            std::to_string(threads) + " are used");
    }
    report_.left_out_before = source_->entriesSkipped();
    // Reading is ahead: what ended it is about later entries.
    end_ = accounting_ended_ ? accounting_ended_ : reading_ended_;
    if (!outputs_.hasAny()) outputs_.commit(report_);  // throws: each failed
    if (!end_) return finish();
    if (report_.entries == 0 || isWrongUsage(end_)) std::rethrow_exception(end_);
    keepWhatThereIs();
}

ConversionReport Converter::finish() {
    if (report_.entries == 0) {
        throw std::runtime_error(conversion_.input.string() + ": has " +
                                 std::to_string(source_->entriesKnown()) +
                                 " entries, none at or after " + std::to_string(conversion_.from));
    }
    checkLabels();
    finishSensorCheck();
    if (outputs_.wantsMap() && report_.scans > 0 && report_.scans_in_map == 0) {
        const std::string scans =
            std::to_string(report_.scans) + " scans of " + conversion_.input.string();
        outputs_.giveUpMap(report_.scans_with_pose == 0
                               ? report_.poses + ": has no pose near any of the " + scans +
                                     "; are its times from another clock? No map is written"
                               : report_.poses + ": its poses place none of the " + scans +
                                     " within an OctoMap; no map is written");
    }
    const Settings::AirframeMask& airframe = settings_.airframe;
    if (!airframe.parts.isEmpty() && report_.scans > 0 && report_.returns_masked == 0) {
        listener_.remark("the log",
                         "the airframe of the settings masks none of its returns; is it that of "
                         "this vehicle, in the frame of the sensor?");
    }
    remarkOnNothingFound();
    remarkOnRecording();
    outputs_.commit(report_);
    remarkOnPartialOutputs();
    return std::move(report_);
}

/// Outputs of runs that broke off have names of their own, so that this one does not replace them.
void Converter::remarkOnPartialOutputs() {
    const std::string left = base::leftBehind(outputsOf(conversion_));
    if (!left.empty()) listener_.remark("the outputs", left);
}

void Converter::finishSensorCheck() {
    const Settings::Sensor &wanted = conversion_.settings.sensor, &used = settings_.sensor;
    if (wanted.model &&
        (wanted.model != used.model || wanted.elevations_deg != used.elevations_deg)) {
        listener_.remark(
            "the log",
            "its sensor.yaml is used instead of the settings' sensor.model " + *wanted.model);
    }
    for (const auto& [label, remark] : sensor_check_.finish()) {
        listener_.remark("sensor " + label, remark);
    }
    for (auto& [label, sensor] : report_.sensors) {
        const std::string fit = sensor_check_.textOf(label);
        if (!fit.empty()) sensor += ", " + fit;
    }
}

/// Labels that are all the same look as if nothing happened.
void Converter::remarkOnNothingFound() {
    if (report_.returns == 0 || report_.roi > 0) return;
    if (report_.rou == 0) {
        listener_.remark("the log", "no return has a range: all are unclassified");
        return;
    }
    listener_.remark("the log",
                     "no return is RoI. If there should be obstacles: are the coordinates metres, "
                     "relative to the sensor (x forward, z up), not to a map?");
}

void Converter::remarkOnRecording() {
    for (const std::string& remark : source_->remarks()) listener_.remark("the recording", remark);
    if (const CloudOutput* const clouds = outputs_.clouds()) {
        report_.clouds = clouds->files();
        report_.cloud_points = clouds->points();
        for (const std::string& remark : clouds->remarks()) {
            listener_.remark("the labelled clouds", remark);
        }
    }
    if (const McapOutput* const mcap = outputs_.mcap()) {
        report_.mcap = {mcap->scans(), mcap->points(), mcap->boxes(), mcap->messages()};
        for (const std::string& remark : mcap->remarks()) listener_.remark("the MCAP", remark);
    }
}

/// Keeps what was converted before the recording or the conversion ended early, whatever the
/// reason, and adds its location to the error.
void Converter::keepWhatThereIs() {
    try {
        remarkOnRecording();
    } catch (const std::exception& e) {
        listener_.remark("the recording", e.what());
    }
    const std::string unit = fs::is_directory(conversion_.input) ? "scans" : "entries";
    const std::string kept = "; the " + std::to_string(report_.entries) + " " + unit +
                             " before it are in" + outputs_.keepPartial(report_);
    try {
        std::rethrow_exception(end_);
    } catch (const recordings::BrokenRawlog& e) {
        throw recordings::BrokenRawlog(e.what() + kept);
    } catch (const recordings::BrokenScan& e) {
        throw recordings::BrokenScan(e.what() + kept);
    } catch (const sensors::BrokenCapture& e) {
        throw sensors::BrokenCapture(e.what() + kept);
    } catch (const recordings::BrokenBag& e) {
        throw recordings::BrokenBag(e.what() + kept);
    } catch (const recordings::Interrupted& e) {
        throw recordings::Interrupted(e.what() + kept);
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(conversion_.input.string() + ": " + base::outOfMemory() + kept);
    } catch (const recordings::TooManySensors& e) {
        throw std::runtime_error(conversion_.input.string() + ": " + e.what() + kept);
    } catch (const std::exception& e) {
        const std::string why = observations::messageOf(e);
        throw std::runtime_error((why.empty() ? "MRPT gives no reason" : why) + kept);
    }
}

/// A requested label without scans may be a typo. It is an error only if nothing was segmented.
void Converter::checkLabels() const {
    for (const std::string& label : conversion_.sensor_labels) {
        const bool is_found = report_.sensors.count(label) > 0;
        if (is_found || report_.unreadable_scans > 0) continue;
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

}  // namespace hagen::convert
