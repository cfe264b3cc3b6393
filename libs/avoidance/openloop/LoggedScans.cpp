#include <hagen/avoidance/LoggedScans.h>
#include <hagen/convert/MapOutput.h>
#include <hagen/mrpt/MrptMessage.h>
#include <hagen/mrpt/TimeStamp.h>

#include <chrono>
#include <new>
#include <stdexcept>

namespace hagen::avoidance {
namespace {

using mrpt::obs::CObservation;
using mrpt::poses::CPose3D;
using TimePoint = mrpt::Clock::time_point;

Eigen::Vector3f positionOf(const CPose3D& pose) {
    return Eigen::Vector3d(pose.x(), pose.y(), pose.z()).cast<float>();
}

/// Removes the vehicle's own returns.
void removeOwn(const observations::ObservationSegmenter::Output& out, float own_reach_m,
               observations::MappedScan& mapped) {
    std::size_t kept = 0, placed = 0;
    for (std::size_t i = 0; i < out.scan->size(); ++i) {
        if (out.result->returns.label[i] == Label::Unclassified) continue;
        if (out.scan->range_m[i] >= own_reach_m) {
            mapped.points_m[kept] = mapped.points_m[placed];
            mapped.labels[kept] = mapped.labels[placed];
            ++kept;
        }
        ++placed;
    }
    mapped.points_m.resize(kept);
    mapped.labels.resize(kept);
}

/// Requires a pose at the scan's time.
void place(const observations::ObservationSegmenter::Output& out, const CObservation& observation,
           const observations::Trajectory& vehicle, float own_reach_m, LoggedScan& scan) {
    convert::PlacedScan placed = *convert::placeInMap(out, observation, vehicle);
    scan.mapped = std::move(placed.mapped);
    removeOwn(out, own_reach_m, scan.mapped);
    const auto end = vehicle.at(mrpt::Clock::fromDouble(scan.mapped.time_s));
    scan.is_placed_by_one_pose = placed.is_by_one_pose;
    scan.vehicle_m = positionOf(end ? *end : *vehicle.at(observation.timestamp));
}

}  // namespace

LoggedScans::LoggedScans(const LogSource& source, const std::function<bool()>& keep_going)
    : own_reach_m_(source.own_reach_m) {
    recordings::SourceOptions options;
    options.keep_going = keep_going;
    if (!source.sensor_label.empty()) options.sensor_labels = {source.sensor_label};
    options.sensor_json = source.sensor_json;
    options.topics = source.topics;
    source_ = recordings::openRecording(source.log, options);

    std::vector<TimePoint> times;
    std::string labels;
    for (const auto& [label, of_label] : source_->scanTimes()) {
        labels += (labels.empty() ? "'" : ", '") + label + "'";
        if (source.sensor_label.empty() || label == source.sensor_label) {
            times.insert(times.end(), of_label.begin(), of_label.end());
        }
    }
    const std::string name = source.log.string();
    if (times.empty() && !labels.empty()) {
        throw std::runtime_error(name + ": has no LiDAR scans labelled '" + source.sensor_label +
                                 "'; found: " + labels);
    }
    if (times.empty()) throw std::runtime_error(name + ": has no LiDAR scans");
    source_->usePoses(source.poses);
    if (poseSource().empty()) {
        throw std::runtime_error(name +
                                 ": has no poses; provide them (--poses FILE.tum with lines "
                                 "'time x y z qx qy qz qw')");
    }
    placeAll(times, name);
    segmenter_.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    segmenter_.initialize(source_->useSettings(source.settings));
}

/// Looks up the pose of each scan. Throws std::runtime_error if most scans have no pose.
void LoggedScans::placeAll(const std::vector<TimePoint>& times, const std::string& log) {
    scans_ = times.size();
    for (const TimePoint time : times) {
        const auto pose = source_->poses().vehicle.at(time);
        without_pose_ += !pose;
        if (pose) flight_m_.extend(positionOf(*pose));
    }
    const std::size_t placed = scans_ - without_pose_;
    if (2 * placed >= scans_) return;
    const std::string number =
        placed == 0 ? "none" : "only " + std::to_string(placed) + " of " + std::to_string(scans_);
    throw std::runtime_error(poseSource() + ": covers " + number + (placed == 0 ? " of the" : "") +
                             " scans in " + log + ", whose first scan is at " +
                             std::to_string(observations::secondsOf(times.front())) +
                             " s; check that both belong to the same flight and clock");
}

std::vector<std::string> LoggedScans::remarks() const {
    std::vector<std::string> remarks = source_->remarks();
    for (const std::string& warning : check_.warnings()) remarks.push_back("WARNING: " + warning);
    return remarks;
}

bool LoggedScans::next(LoggedScan& scan) {
    const observations::Trajectory& vehicle = source_->poses().vehicle;
    while (const auto recorded = source_->nextScan()) {
        if (!recorded->pose.sensor_pose) continue;
        observations::ObservationSegmenter::Output out;
        try {
            segmenter_.process(*recorded->observation, out, recorded->pose, recorded->beams);
        } catch (const SettingsError&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& e) {
            if (unreadable_++ == 0) {
                why_unreadable_ =
                    recordings::titleOf(*recorded) + ": " + observations::messageOf(e);
            }
            continue;
        }
        check_.add(*out.scan, out.result->returns.label, *out.sensor, *out.options);
        scan.entry = recorded->entry;
        scan.filter_ms = std::chrono::duration<double, std::milli>(out.filter_cpu_time).count();
        place(out, *recorded->observation, vehicle, own_reach_m_, scan);
        return true;
    }
    return false;
}

}  // namespace hagen::avoidance
