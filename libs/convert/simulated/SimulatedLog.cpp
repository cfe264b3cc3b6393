#include "convert/simulated/SimulatedLog.h"

#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/scan/Angle.h>
#include <hagen/simulation/LogClock.h>
#include <hagen/simulation/Scenarios.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include "base/OutputSet.h"
#include "base/WriteFile.h"
#include "convert/PacketCapture.h"
#include "convert/RawlogWriter.h"
#include "convert/ScanFolderWriter.h"

#include <cmath>
#include <iomanip>

#include <hagen/convert/SimulatedObservation.h>

namespace hagen::convert {
namespace {

namespace fs = std::filesystem;

const fs::path& made(const fs::path& folder) {
    fs::create_directory(folder);
    return folder;
}

void writeKinds(const fs::path& file) {
    std::ofstream out(file);
    out << "# Kinds of semantic/*.label, and their labels: 0 unclassified, 1 ROU, 2 RoI\n";
    for (const simulation::ObjectClass kind : simulation::allKinds()) {
        out << static_cast<int>(kind) << ": {name: " << simulation::nameOf(kind)
            << ", label: " << static_cast<int>(simulation::labelOf(kind)) << "}\n";
    }
    base::closeWritten(out, file);
}

/// Converts class numbers to labels, because both are written as the low 16 bits.
std::vector<Label> asLabels(const std::vector<simulation::ObjectClass>& kinds) {
    std::vector<Label> numbers;
    for (const simulation::ObjectClass kind : kinds) numbers.push_back(static_cast<Label>(kind));
    return numbers;
}

/// Ground truth of a simulated scan, one entry per return.
struct GroundTruthLabels {
    std::vector<simulation::ObjectClass> kind;
    std::vector<std::uint16_t> object;
};

/// Writes simulated scans with ground truth as a scan folder: labels/ and semantic/ also contain
/// the object's number, and simulated_by.txt marks the folder as replaceable.
class GroundTruthFolder {
 public:
    /// `mount` is the sensor's tilt on the level vehicle. Throws std::runtime_error if the folder
    /// cannot be written.
    GroundTruthFolder(const std::filesystem::path& folder, bool overwrite,
                      const Attitude& mount = {})
        : path_(folder, recordings::kScanFolders, overwrite),
          writer_(made(path_.temporary()), mount) {
        fs::create_directory(path_.temporary() / "semantic");
        writeKinds(path_.temporary() / "kinds.yaml");
        base::writeText("Made by rawlog-simulate, which may replace this folder.\n",
                        path_.temporary() / recordings::ScanFolder::kSimulatedBy,
                        path_.path() / recordings::ScanFolder::kSimulatedBy);
    }

    const base::OutputPath& place() const { return path_; }
    void write(const Scan& scan, const GroundTruthLabels& truth, const SensorModel& sensor,
               double time_s, const mrpt::poses::CPose3D& sensor_pose, double altitude_m) {
        LabelledReturns returns;
        for (std::size_t i = 0; i < scan.size(); ++i) {
            returns.label.push_back(sensor.sees(scan.range_m[i])
                                        ? simulation::labelOf(truth.kind[i])
                                        : Label::Unclassified);
        }
        returns.component.assign(truth.object.begin(), truth.object.end());
        const std::string name = scanName(altitudes_m_.size());
        writer_.write(name, scan, returns, sensor, time_s, sensor_pose, true);
        recordings::writeLabels(path_.temporary() / "semantic" / (name + ".label"),
                                asLabels(truth.kind), returns.component);
        altitudes_m_.push_back(altitude_m);
    }
    /// Completes the folder and renames it into place.
    void commit() {
        finish();
        path_.commit();
    }
    /// Keeps the folder as a partial folder and returns its name.
    std::filesystem::path keepPartial() {
        finish();
        return path_.keepPartial();
    }

 private:
    void finish() {
        const fs::path file = path_.temporary() / "altitudes.txt";
        std::ofstream out(file);
        out << std::fixed << std::setprecision(3);
        for (const double altitude_m : altitudes_m_) out << altitude_m << "\n";
        base::closeWritten(out, file);
        writer_.finish();
    }

    base::OutputPath path_;
    ScanFolderWriter writer_;
    std::vector<double> altitudes_m_;
};

constexpr double kStart_s = simulation::kSimulatedLogStart_s;
constexpr const char* kLidarLabel = "lidar";
constexpr double kPoseStep_s = 0.05;  // much less than the maximum interpolation gap

/// A pose file that is renamed into place when complete.
class PoseOutput {
 public:
    PoseOutput(const fs::path& file, bool overwrite) : path_(file, base::kFile, overwrite) {}

    const base::OutputPath& place() const { return path_; }
    void add(double time_s, const mrpt::poses::CPose3D& pose) { poses_.push_back({time_s, pose}); }
    void commit() {
        recordings::writeTumPoses(path_.temporary(), poses_);
        path_.commit();
    }
    fs::path keepPartial() {
        recordings::writeTumPoses(path_.temporary(), poses_);
        return path_.keepPartial();
    }

 private:
    base::OutputPath path_;
    std::vector<recordings::TimedPose> poses_;
};

/// The requested outputs. A failed output does not affect the others.
class SimulatedOutputs {
 public:
    SimulatedOutputs(const SimulatedLog& log, const Attitude& mount) {
        if (!log.rawlog.empty()) rawlog_.emplace(log.rawlog, log.overwrite);
        if (!log.folder.empty()) folder_.emplace(log.folder, log.overwrite, mount);
        if (!log.poses.empty()) poses_.emplace(log.poses, log.overwrite);
        if (!log.capture.empty()) capture_.emplace(log.capture, log.overwrite);
        if (folder_) all_.add(folder_->place(), *folder_);
        if (poses_) all_.add(poses_->place(), *poses_);
        if (capture_) all_.add(capture_->place(), *capture_);
        if (rawlog_) all_.add(rawlog_->place(), *rawlog_);
    }

    bool hasRawlog() const { return rawlog_.has_value(); }
    void write(const mrpt::serialization::CSerializable& entry) {
        if (rawlog_) all_.write(rawlog_->place(), [&] { rawlog_->write(entry); });
    }
    void writePackets(const mrpt::obs::CObservationVelodyneScan& scan) {
        if (!capture_) return;
        all_.write(capture_->place(), [&] {
            observations::forEachPacket(scan, [&](const sensors::Datagram& datagram) {
                capture_->add(scan.sensorLabel, datagram);
            });
        });
    }
    void writePose(double time_s, const mrpt::poses::CPose3D& pose) {
        if (poses_) all_.write(poses_->place(), [&] { poses_->add(time_s, pose); });
    }
    /// Calls step(folder) if a folder was requested; records a failure.
    template <class Step>
    void writeScan(const Step& step) {
        if (folder_) all_.write(folder_->place(), [&] { step(*folder_); });
    }

    bool areAllGivenUp() const { return all_.areAllGivenUp(); }
    void commit() { all_.commit(); }
    /// Keeps partial outputs; returns their names and the failures.
    std::string keepPartial() {
        std::string names;
        const auto keep = [&](auto& output) {
            if (!output) return;
            all_.write(output->place(), [&] { names += " " + output->keepPartial().string(); });
        };
        keep(folder_);
        keep(poses_);
        keep(capture_);
        keep(rawlog_);
        const std::string& failures = all_.failures();
        return (names.empty() ? " no output" : names) + (failures.empty() ? "" : "; " + failures);
    }

 private:
    std::optional<RawlogWriter> rawlog_;
    std::optional<GroundTruthFolder> folder_;
    std::optional<PoseOutput> poses_;
    std::optional<PacketCapture> capture_;
    base::OutputSet all_;
};

mrpt::Clock::time_point timePoint(double time_s) { return mrpt::Clock::fromDouble(time_s); }

void writePose(double time_s, const simulation::SensorPose& pose, SimulatedOutputs& outputs) {
    outputs.writePose(kStart_s + time_s, mrptPose(pose));
    if (!outputs.hasRawlog()) return;
    mrpt::obs::CObservationRobotPose entry;
    entry.sensorLabel = "pose";
    entry.timestamp = timePoint(kStart_s + time_s);
    entry.pose.mean = mrptPose(pose);
    outputs.write(entry);
}

bool hasPackets(const SensorModel& sensor) {
    return sensor.name == "VLP-16" || sensor.name == "HDL-32E";
}

/// Whether scans are written as clouds. (MRPT does not support the packets of an HDL-64E.)
bool hasClouds(const SensorModel& sensor) { return !sensor.has_rings; }

/// The scan to store in a folder, as measured or as decoded from its packets.
struct MeasuredScan {
    Scan scan;
    SensorModel sensor;
};

MeasuredScan writeScanEntry(const simulation::SimulatedScan& made, const SensorModel& sensor,
                            const mrpt::poses::CPose3D& mount, double time_s,
                            SimulatedOutputs& outputs) {
    if (hasClouds(sensor) && outputs.hasRawlog()) {
        const auto observation =
            observations::observationOf(made.scan, kLidarLabel, timePoint(kStart_s + time_s));
        observation->sensorPose = mount;
        outputs.write(*observation);
    }
    if (!hasPackets(sensor)) return {made.scan, sensor};
    const auto observation = encodeSimulatedScan(made, sensor, std::fmod(time_s, 3600.0));
    observation->sensorLabel = kLidarLabel;
    observation->timestamp = timePoint(kStart_s + time_s);
    observation->sensorPose = mount;
    MeasuredScan measured;
    observations::decodePackets(*observation, measured.scan);
    measured.sensor = observations::sensorOf(*observation);
    outputs.write(*observation);
    outputs.writePackets(*observation);
    return measured;
}

void count(const std::vector<simulation::ObjectClass>& kinds, SimulationReport& report) {
    ++report.scans;
    report.returns += kinds.size();
    for (const simulation::ObjectClass kind : kinds) {
        const Label label = simulation::labelOf(kind);
        ++(label == Label::Roi   ? report.roi
           : label == Label::Rou ? report.rou
                                 : report.unclassified);
    }
}

}  // namespace

SimulationReport simulateLog(const SimulatedLog& log, const std::function<bool()>& keep_going) {
    const SensorModel sensor = sensorModel(log.sensor);
    const bool needs_packets = (!log.rawlog.empty() && !hasClouds(sensor)) || !log.capture.empty();
    if (needs_packets && !hasPackets(sensor)) {
        throw std::invalid_argument(
            "there is no packet format for '" + sensor.name +
            "', so it cannot be written to a rawlog or capture; request only a scan folder");
    }
    base::checkApart({log.rawlog, log.folder, log.poses, log.capture}, {});
    const double roll_rad = radians(log.mount_roll_deg), pitch_rad = radians(log.mount_pitch_deg);
    const Eigen::Quaterniond mount = Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
                                     Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
    mrpt::poses::CPose3D sensor_on_vehicle;
    if (roll_rad != 0 || pitch_rad != 0) {  // avoids a negative zero
        sensor_on_vehicle = mrpt::poses::CPose3D(0, 0, 0, 0, pitch_rad, roll_rad);
    }
    SimulatedOutputs outputs(log, {static_cast<float>(roll_rad), static_cast<float>(pitch_rad)});
    const simulation::Scene scene = simulation::makeScene(log.scenario, log.seed);
    simulation::FlightSettings settings;
    settings.altitude_m = log.altitude_m;
    settings.speed_m_s = log.speed_m_s;
    settings.tilt_sd_rad = radians(log.tilt_sd_deg);
    const simulation::Flight flight(scene.terrain(), scene.path(), settings, log.seed);
    const double measuring_s = simulation::firingPattern(sensor).revolutionPeriod_s();

    simulation::SensorErrorModel faults = simulation::sensorErrors(sensor);
    if (log.clear_air) {
        faults.dust_per_m = 0;
        faults.airframe = false;
    }
    simulation::Random random(log.seed, 3);
    SimulationReport report;
    for (int scan = 0; scan < log.scans; ++scan) {
        if (!keep_going()) {
            if (scan == 0) throw std::runtime_error("interrupted before the first scan");
            throw std::runtime_error(
                "interrupted; the first " +
                (scan == 1 ? "scan is in" : std::to_string(scan) + " scans are in") +
                outputs.keepPartial());
        }
        const double time_s = log.every_s * scan, next_s = log.every_s * (scan + 1);
        const simulation::SimulatedScan made =
            simulation::simulateScan(scene, sensor, flight, time_s, random, faults, mount);
        writePose(time_s, flight.at(time_s), outputs);
        const MeasuredScan measured =
            writeScanEntry(made, sensor, sensor_on_vehicle, time_s, outputs);
        // Writes poses up to the next scan's first pose or, after the last scan, until after the
        // last firing.
        const bool is_last = scan + 1 == log.scans;
        for (int step = 1; (step - 1) * kPoseStep_s < measuring_s; ++step) {
            const double pose_s = time_s + step * kPoseStep_s;
            if (!is_last && pose_s > next_s - 0.5 * kPoseStep_s) break;
            writePose(pose_s, flight.at(pose_s), outputs);
        }
        outputs.writeScan([&](GroundTruthFolder& folder) {
            folder.write(measured.scan, {made.kind, made.object}, measured.sensor,
                         kStart_s + time_s, mrptPose(made.pose), made.altitude_m);
        });
        if (outputs.areAllGivenUp()) break;
        count(made.kind, report);
    }
    outputs.commit();
    return report;
}

}  // namespace hagen::convert
