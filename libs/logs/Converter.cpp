#include "Converter.h"

#include <hagen/logs/RawlogReader.h>
#include <hagen/logs/ScanFolder.h>
#include <hagen/observations/MrptMessage.h>
#include <hagen/observations/ScenePreview.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

#include "OrderedPipeline.h"

namespace hagen::logs {
namespace {

using mrpt::obs::CObservation;

/// The report of one scan, but for what only the converter knows of it.
ScanReport reportOf(const observations::ObservationSegmenter::Output& out) {
    ScanReport report{};
    report.time_s = mrpt::Clock::toDouble(out.roi->timestamp);
    report.returns = out.scan->size();
    report.roi = out.roi->pointcloud->size();
    report.rou = out.non_roi->pointcloud->size();
    report.unclassified = report.returns - report.roi - report.rou;
    float nearest_m = std::numeric_limits<float>::infinity();
    std::int32_t obstacles = 0;
    for (const std::uint32_t i : out.result->returns.roi) {
        if (i >= out.scan->size()) break;  // ascending; the rest are older scans' of the window
        nearest_m = std::min(nearest_m, out.scan->range_m[i]);
        obstacles = std::max(obstacles, out.result->returns.component[i]);
    }
    report.nearest_roi_m = std::isinf(nearest_m) ? kNoValue : nearest_m;
    report.obstacles = static_cast<std::size_t>(obstacles);
    report.latency_ms = std::chrono::duration<double, std::milli>(out.time_to_labels).count();
    return report;
}

std::unique_ptr<observations::ObservationSegmenter> makeSegmenter(
    const Conversion& conversion, const observations::Settings& settings) {
    auto segmenter = std::make_unique<observations::ObservationSegmenter>();
    segmenter->setMinLoggingLevel(mrpt::system::LVL_ERROR);  // remarks go to the listener
    segmenter->cloud_class = conversion.cloud_class;
    segmenter->initialize(settings);
    return segmenter;
}

}  // namespace

SegmenterPool::Lease SegmenterPool::lease() {
    const auto giveBack = [this](observations::ObservationSegmenter* segmenter) {
        const std::lock_guard lock(is_used_);
        idle_.emplace_back(segmenter);
    };
    {
        const std::lock_guard lock(is_used_);
        if (!idle_.empty()) {
            Lease lease(idle_.back().release(), giveBack);
            idle_.pop_back();
            return lease;
        }
    }
    return Lease(make_().release(), giveBack);
}

Converter::Converter(const Conversion& conversion, const observations::Settings& settings,
                     const ConversionListener& listener)
    : conversion_(conversion),
      listener_(listener),
      has_window_(settings.options.window_scans > 1),
      outputs_(conversion),
      segmenters_([this] { return makeSegmenter(conversion_, report_.settings); }) {
    report_.settings = settings;
    segmenters_.lease();  // settings that do not fit are told before anything is read
}

void Converter::setPoses(const LogPoses& poses) {
    vehicle_ = poses.vehicle;
    report_.poses = poses.source;
    levels_by_file_ = !conversion_.poses.empty() && poses.vehicle.has_horizon;
    if (outputs_.wantsMap() && poses.source.empty()) {
        throw std::runtime_error(conversion_.input.string() +
                                 ": tells no poses, and a map needs them; give them (--poses "
                                 "FILE.tum, lines of 'time x y z qx qy qz qw')");
    }
}

// Reading, in the log's order.

bool Converter::takes(std::size_t entry) {
    {
        const std::lock_guard lock(listens_);
        if (!listener_.keep_going()) throw Interrupted("interrupted");
    }
    if (entry < conversion_.from) ++report_.left_out_before;
    return entry >= conversion_.from;
}

void Converter::see(const CObservation& observation) {
    if (!levels_by_file_) horizon_.see(observation);
}

bool Converter::isWanted(const CObservation& observation) {
    if (!observations::isLidarScan(observation)) return false;
    const std::string& label = observation.sensorLabel;
    const auto& wanted = conversion_.sensor_labels;
    if (wanted.empty()) return true;
    if (std::find(wanted.begin(), wanted.end(), label) != wanted.end()) return true;
    other_labels_.insert(label);
    return false;
}

void Converter::add(const CObservation::ConstPtr& observation, EntryOnItsWay& entry,
                    const std::string& name) {
    if (!isWanted(*observation)) return;
    ScanOnItsWay& scan = entry.scans.emplace_back();
    scan.observation = observation;
    scan.name = name;
    scan.whereabouts = horizon_.whereaboutsOf(*observation, vehicle_);
}

// Segmenting, on any thread.

void Converter::segment(ScanOnItsWay& scan) {
    scan.segmenter = segmenters_.lease();
    try {
        scan.is_segmented =
            scan.segmenter->process(*scan.observation, scan.segmented, scan.whereabouts, vehicle_);
    } catch (const observations::SettingsError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        scan.why_not = observations::messageOf(e);
        if (scan.why_not.empty()) scan.why_not = "MRPT does not say why";
    }
    if (scan.is_segmented && conversion_.preview && outputs_.wantsRawlog()) {
        scan.preview = observations::previewOf(*scan.observation, scan.segmented,
                                               report_.settings.options.zone_m);
    }
}

void Converter::serialiseAll(EntryOnItsWay& entry) const {
    entry.bytes.clear();
    if (!outputs_.wantsRawlog()) return;
    std::vector<CObservation::Ptr> added;
    for (const ScanOnItsWay& scan : entry.scans) {
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

void Converter::work(EntryOnItsWay& entry) {
    if (has_window_) return;  // in account(), in the log's order
    try {
        for (ScanOnItsWay& scan : entry.scans) segment(scan);
        serialiseAll(entry);
    } catch (...) {
        entry.failure = std::current_exception();
    }
}

// What others see of it, in the log's order.

void Converter::tellRemarks(const ScanOnItsWay& scan, const std::string& entry) {
    const std::lock_guard lock(listens_);
    if (!scan.is_segmented) {
        if (!scan.why_not.empty()) listener_.unreadable(entry, scan.why_not);
        return;
    }
    if (!scan.segmented.remark.empty()) listener_.remark(entry, scan.segmented.remark);
    if (!conversion_.folder.empty() && !report_.poses.empty() && !scan.segmented.sensor_pose) {
        listener_.remark(entry,
                         "no pose is near its time: poses.tum leaves it out, and "
                         "poses.txt is not written");
    }
}

void Converter::insertIntoMap(const ScanOnItsWay& scan, const std::string& entry) {
    const auto mapped = placeInMap(scan.segmented, *scan.observation, vehicle_);
    if (mapped) {
        outputs_.insertIntoMap(*mapped);
        ++report_.scans_in_map;
        return;
    }
    const std::lock_guard lock(listens_);
    listener_.remark(entry, "no pose is near its time: the map leaves it out");
}

void Converter::account(ScanOnItsWay& scan, const EntryOnItsWay& entry) {
    const std::string& label = scan.observation->sensorLabel;
    if (!scan.is_segmented && !scan.why_not.empty()) ++report_.unreadable_scans;
    const std::string name = "entry " + std::to_string(entry.number) + " (" +
                             (scan.name.empty() ? label : scan.name) + ")";
    tellRemarks(scan, name);
    if (scan.is_segmented) {
        if (outputs_.wantsMap()) insertIntoMap(scan, name);
        ScanReport report = reportOf(scan.segmented);
        report.entry = entry.number;
        report.sensor_label = label;
        report.name =
            outputs_.writeScan(scan.segmented, label, scan.name, report_.settings.options);
        count(scan.segmented, report);
    }
    scan.segmenter.reset();
}

void Converter::account(EntryOnItsWay& entry) {
    if (entry.failure) std::rethrow_exception(entry.failure);
    for (ScanOnItsWay& scan : entry.scans) {
        if (has_window_) segment(scan);
        account(scan, entry);
    }
    if (has_window_) serialiseAll(entry);
    outputs_.gather(entry.bytes, entry.member);
    // MRPT's objects are not needed any longer.
    entry.scans.clear();
    entry.object.reset();

    ++report_.entries;
    report_.fraction = entry.fraction;
    const std::lock_guard lock(listens_);
    listener_.progress(report_);
}

void Converter::count(const observations::ObservationSegmenter::Output& out,
                      const ScanReport& scan) {
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

// The whole, and its end.

void Converter::run(const std::function<bool(EntryOnItsWay&)>& read, const std::string& what) {
    std::exception_ptr end;  // what was read before it is converted first
    PipelineSteps<EntryOnItsWay> steps;
    steps.read = [&](EntryOnItsWay& entry) {
        try {
            return read(entry);
        } catch (...) {
            end = std::current_exception();
            return false;
        }
    };
    steps.work = [this](EntryOnItsWay& entry) { work(entry); };
    steps.account = [this](EntryOnItsWay& entry) { account(entry); };
    steps.pack = [](EntryOnItsWay& entry) {
        if (!entry.member.empty()) packGzipMember(entry.member, entry.packed);
    };
    steps.write = [this](EntryOnItsWay& entry) {
        if (!entry.member.empty()) outputs_.writeMember(entry.packed);
    };
    // Pictures take a second each, one after the other. Threads would gain nothing, but read on,
    // and have that much to finish when they are interrupted.
    const std::size_t most = conversion_.jobs == 0 ? coresOfThisMachine() : conversion_.jobs;
    runPipeline(steps, conversion_.pictures.empty() ? most : 1);
    if (!end) return;
    try {
        std::rethrow_exception(end);
    } catch (const BrokenRawlog& e) {
        endEarly(e, what);
    } catch (const BrokenScan& e) {
        endEarly(e, what);
    } catch (const Interrupted& e) {
        endEarly(e, what);
    }
}

ConversionReport Converter::finish(std::size_t entries) {
    if (report_.entries == 0) {
        throw std::runtime_error(conversion_.input.string() + ": has " + std::to_string(entries) +
                                 " entries, none from " + std::to_string(conversion_.from) + " on");
    }
    checkLabels();
    if (outputs_.wantsMap() && report_.scans > 0 && report_.scans_in_map == 0) {
        throw std::runtime_error(report_.poses + ": has no pose near any of the " +
                                 std::to_string(report_.scans) + " scans of " +
                                 conversion_.input.string() +
                                 "; are its times of another clock? There is no map");
    }
    outputs_.commit(report_);
    return std::move(report_);
}

/// Says why it ends early, and where what was done before is kept.
template <class Error>
void Converter::endEarly(const Error& why, const std::string& what) {
    if (report_.entries == 0) throw why;
    throw Error(std::string(why.what()) + "; the " + std::to_string(report_.entries) + " " + what +
                " before it are in" + outputs_.keepPartial(report_));
}

/// A label of which there is no scan may be a slip of the pen. It fails the conversion where
/// nothing else was segmented.
void Converter::checkLabels() const {
    for (const std::string& label : conversion_.sensor_labels) {
        const bool is_there = report_.sensors.count(label) > 0;
        if (is_there || report_.unreadable_scans > 0) continue;
        std::string others;
        for (const auto& [other, sensor] : report_.sensors) others += " '" + other + "'";
        for (const std::string& other : other_labels_) others += " '" + other + "'";
        const std::string what = "has no LiDAR scan of '" + label + "' in what was converted; " +
                                 (others.empty() ? "there is none" : "there are" + others);
        if (report_.scans == 0) {
            throw std::runtime_error(conversion_.input.string() + ": " + what);
        }
        listener_.remark("the log", what);
    }
}

}  // namespace hagen::logs
