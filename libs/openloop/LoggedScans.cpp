#include <hagen/logs/LogPoses.h>
#include <hagen/logs/MapOutput.h>
#include <hagen/logs/RawlogReader.h>
#include <hagen/logs/RawlogSurvey.h>
#include <hagen/logs/ScanFolder.h>
#include <hagen/observations/MrptMessage.h>
#include <hagen/observations/ObservationSegmenter.h>
#include <hagen/openloop/LoggedScans.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <new>
#include <stdexcept>

namespace hagen::openloop {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservation;
using mrpt::poses::CPose3D;
using TimePoint = mrpt::Clock::time_point;

constexpr double kDefaultScanPeriod_s = 0.1;  // for scan folders without times

Eigen::Vector3f positionOf(const CPose3D& pose) {
    return Eigen::Vector3d(pose.x(), pose.y(), pose.z()).cast<float>();
}

/// Removes the vehicle's own returns.
void removeOwn(const observations::ObservationSegmenter::Output& out, float own_reach_m,
               mapping::MappedScan& mapped) {
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
    scan.mapped = *logs::placeInMap(out, observation, vehicle);
    removeOwn(out, own_reach_m, scan.mapped);
    const auto end = vehicle.at(mrpt::Clock::fromDouble(scan.mapped.time_s));
    scan.is_placed_by_one_pose = out.scan->time_s.empty() || !end;
    scan.vehicle_m = positionOf(end ? *end : *vehicle.at(observation.timestamp));
}

}  // namespace

/// A log of either kind: its poses and scans.
struct LoggedScans::Log {
    explicit Log(const LogSource& of) : source(of) {}
    virtual ~Log() = default;

    struct Entry {
        std::size_t number;
        CObservation::ConstPtr observation;
    };
    /// The next LiDAR scan; no observation at the end.
    virtual Entry next() = 0;

    bool isWanted(const std::string& label) const {
        return source.sensor_label.empty() || label == source.sensor_label;
    }
    void setPoses(const logs::LogPoses& known, const std::vector<TimePoint>& times);

    LogSource source;
    logs::LogPoses poses;
    std::size_t scans = 0, without_pose = 0, unreadable = 0;
    std::string why_unreadable;
    Eigen::AlignedBox3f flight_m;
    observations::ObservationSegmenter segmenter;
};

void LoggedScans::Log::setPoses(const logs::LogPoses& known, const std::vector<TimePoint>& times) {
    const std::string name = source.log.string();
    if (times.empty()) throw std::runtime_error(name + ": has no LiDAR scan");
    if (known.source.empty()) {
        throw std::runtime_error(name +
                                 ": has no poses; provide them (--poses FILE.tum with lines "
                                 "'time x y z qx qy qz qw')");
    }
    poses = known;
    scans = times.size();
    for (const TimePoint time : times) {
        const auto pose = poses.vehicle.at(time);
        without_pose += !pose;
        if (pose) flight_m.extend(positionOf(*pose));
    }
    const std::size_t placed = scans - without_pose;
    if (2 * placed >= scans) return;
    const std::string which = placed == 0
                                  ? "has no pose near any of the " + std::to_string(scans)
                                  : "has poses near " + std::to_string(placed) + " of the " +
                                        std::to_string(scans) + " scans, fewer than half,";
    throw std::runtime_error(poses.source + ": " + which + (placed == 0 ? " scans" : "") + " of " +
                             name + ", whose first scan is at " +
                             std::to_string(mrpt::Clock::toDouble(times.front())) +
                             " s; do they belong to another flight or another clock?");
}

class LoggedScans::Rawlog : public LoggedScans::Log {
 public:
    explicit Rawlog(const LogSource& of) : Log(of), reader_(of.log) {
        const logs::RawlogSurvey survey = logs::surveyRawlog(of.log);
        std::vector<TimePoint> times;
        std::string labels;
        for (const auto& [label, places] : survey.scans) {
            labels += (labels.empty() ? "'" : ", '") + label + "'";
            if (!isWanted(label)) continue;
            for (const auto& place : places) times.push_back(place.time);
        }
        if (times.empty() && !labels.empty()) {
            throw std::runtime_error(of.log.string() + ": has no LiDAR scan of '" +
                                     of.sensor_label + "'; there are " + labels);
        }
        setPoses(logs::posesOfRawlog(survey, of.poses), times);
        segmenter.setMinLoggingLevel(mrpt::system::LVL_ERROR);
        segmenter.initialize(of.settings);
    }

    Entry next() override {
        while (waiting_.empty()) {
            const std::size_t number = reader_.entries();
            const auto object = reader_.next();
            if (!object) return {};
            if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
                for (const auto& observation : *frame) take(number, observation);
            } else {
                take(number, std::dynamic_pointer_cast<CObservation>(object));
            }
        }
        Entry entry = waiting_.front();
        waiting_.pop_front();
        return entry;
    }

 private:
    void take(std::size_t number, const CObservation::ConstPtr& observation) {
        if (!observation) return;
        // A pose file knows the attitude better.
        if (source.poses.empty()) segmenter.see(*observation);
        const bool is_scan = observations::isLidarScan(*observation);
        if (is_scan && isWanted(observation->sensorLabel))
            waiting_.push_back({number, observation});
    }

    logs::RawlogReader reader_;
    std::deque<Entry> waiting_;
};

class LoggedScans::Folder : public LoggedScans::Log {
 public:
    explicit Folder(const LogSource& of) : Log(of), folder_(of.log), times_s_(folder_.times()) {
        if (!isWanted(kLabel)) {
            throw std::runtime_error(of.log.string() + ": has no LiDAR scan of '" +
                                     of.sensor_label + "'; a scan folder has only '" + kLabel +
                                     "'");
        }
        for (std::size_t i = times_s_.size(); i < folder_.size(); ++i) {
            times_s_.push_back(kDefaultScanPeriod_s * static_cast<double>(i));
        }
        std::vector<TimePoint> times;
        for (const double time_s : times_s_) times.push_back(mrpt::Clock::fromDouble(time_s));
        setPoses(logs::posesOfScanFolder(folder_, times_s_, of.poses), times);
        observations::Settings settings = of.settings;
        if (fs::exists(folder_.sensorFile()))
            observations::mergeSettings(folder_.sensorFile(), settings);
        segmenter.setMinLoggingLevel(mrpt::system::LVL_ERROR);
        segmenter.initialize(settings);
    }

    Entry next() override {
        if (next_ == folder_.size()) return {};
        Scan scan;
        logs::readScan(folder_.scanFile(next_), scan);
        const auto time = mrpt::Clock::fromDouble(times_s_[next_]);
        return {next_++, observations::observationOf(scan, kLabel, time)};
    }

 private:
    static constexpr const char* kLabel = "velodyne";
    logs::ScanFolder folder_;
    std::vector<double> times_s_;
    std::size_t next_ = 0;
};

LoggedScans::LoggedScans(const LogSource& source) {
    if (!fs::exists(source.log)) {
        throw std::runtime_error(source.log.string() + ": no such file or folder");
    }
    if (fs::is_directory(source.log)) {
        log_ = std::make_unique<Folder>(source);
    } else {
        log_ = std::make_unique<Rawlog>(source);
    }
}
LoggedScans::~LoggedScans() = default;

bool LoggedScans::next(LoggedScan& scan) {
    for (;;) {
        const Log::Entry entry = log_->next();
        if (!entry.observation) return false;
        const observations::Trajectory& vehicle = log_->poses.vehicle;
        if (!vehicle.at(entry.observation->timestamp)) continue;
        observations::ObservationSegmenter::Output out;
        try {
            log_->segmenter.process(*entry.observation, out, vehicle);
        } catch (const observations::SettingsError&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& e) {
            ++log_->unreadable;
            log_->why_unreadable =
                "entry " + std::to_string(entry.number) + ": " + observations::messageOf(e);
            continue;
        }
        scan.entry = entry.number;
        scan.filter_ms = std::chrono::duration<double, std::milli>(out.filter_cpu_time).count();
        place(out, *entry.observation, vehicle, log_->source.own_reach_m, scan);
        return true;
    }
}

const std::string& LoggedScans::poseSource() const { return log_->poses.source; }
bool LoggedScans::posesHaveHorizon() const { return log_->poses.vehicle.has_horizon; }
std::size_t LoggedScans::scans() const { return log_->scans; }
std::size_t LoggedScans::scansWithoutPose() const { return log_->without_pose; }
std::size_t LoggedScans::unreadableScans() const { return log_->unreadable; }
const std::string& LoggedScans::whyUnreadable() const { return log_->why_unreadable; }
const Eigen::AlignedBox3f& LoggedScans::flight_m() const { return log_->flight_m; }

}  // namespace hagen::openloop
