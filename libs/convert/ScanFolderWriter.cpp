#include "convert/ScanFolderWriter.h"
#include <hagen/mrpt/TimeStamp.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/scan/Angle.h>
#include <hagen/settings/Settings.h>
#include <algorithm>
#include <cstdio>
#include <iomanip>
#include "settings/MaxRange.h"

#include "base/WriteFile.h"
#include "recordings/CloudTimes.h"

namespace hagen::convert {
namespace {

namespace fs = std::filesystem;

void writeBeams(const SensorModel& sensor, std::ostream& out) {
    if (sensor.has_rings) {
        out << "# Beams of this recording (" << sensor.name << "), lowest first\n"
            << "sensor:\n  model: custom\n  elevations_deg: [" << std::setprecision(9);
        for (int row = 0; row < sensor.rows(); ++row) {
            // Limits the value, because float pi / 2 exceeds 90 degrees.
            const double elevation_deg =
                std::clamp(degrees(sensor.elevations_rad[row]), -90.0, 90.0);
            out << (row > 0 ? ", " : "") << elevation_deg;
        }
        out << "]\n";
    } else {  // not described as a custom sensor, which would have rings
        out << "# Sensor of this recording\nsensor:\n  model: " << sensor.name << "\n";
    }
    // A recording's range limits may exceed those allowed in settings.
    const auto limit_m = [](float range_m) { return std::clamp<double>(range_m, 0, kMaxRange_m); };
    const double min_m = limit_m(sensor.min_range_m), max_m = limit_m(sensor.max_range_m);
    if (min_m < max_m) {
        out << "  min_range_m: " << min_m << "\n  max_range_m: " << max_m << "\n";
    } else {
        out << "  # The range limits exceed the allowed settings.\n";
    }
}

void writeSensor(const fs::path& file, const SensorModel& sensor,
                 const std::optional<GivenLimits>& unnamed, const Attitude& mount) {
    const bool is_tilted = mount.roll_rad != 0 || mount.pitch_rad != 0;
    std::ofstream out(file);
    if (!unnamed) {
        writeBeams(sensor, out);
    } else {
        const bool has_keys = is_tilted || unnamed->min_range_m || unnamed->max_range_m;
        out << "# Unnamed sensor; the beams are recovered from the scans.\n"
            << (has_keys ? "sensor:\n" : "") << std::setprecision(9);
        if (unnamed->min_range_m) out << "  min_range_m: " << *unnamed->min_range_m << "\n";
        if (unnamed->max_range_m) out << "  max_range_m: " << *unnamed->max_range_m << "\n";
    }
    if (is_tilted) {
        out << "  mount_roll_deg: " << degreesText(mount.roll_rad) << "\n"
            << "  mount_pitch_deg: " << degreesText(mount.pitch_rad) << "\n";
    }
    base::closeWritten(out, file);
}

}  // namespace

std::string scanName(std::size_t scan) {
    char name[32];
    std::snprintf(name, sizeof name, "%06zu", scan);
    return name;
}

ScanFolderWriter::ScanFolderWriter(fs::path folder, const Attitude& mount,
                                   const std::optional<GivenLimits>& unnamed)
    : folder_(std::move(folder)), mount_(mount), unnamed_(unnamed) {
    fs::create_directory(folder_ / "velodyne");
    fs::create_directory(folder_ / "labels");
}

void ScanFolderWriter::write(const std::string& name, const Scan& scan,
                             const LabelledReturns& returns, const SensorModel& sensor,
                             double time_s, const std::optional<mrpt::poses::CPose3D>& sensor_pose,
                             bool pose_has_horizon) {
    if (times_s_.empty()) writeSensor(folder_ / "sensor.yaml", sensor, unnamed_, mount_);
    const fs::path points = folder_ / "velodyne" / (name + ".bin");
    const fs::path labels = folder_ / "labels" / (name + ".label");
    try {
        recordings::writeScan(points, scan);
        recordings::writeLabels(labels, returns.label, returns.component);
    } catch (...) {  // removes the partial scan
        std::error_code ignored;
        fs::remove(points, ignored);
        fs::remove(labels, ignored);
        throw;
    }
    names_.push_back(name);
    times_s_.push_back(observations::isTime(time_s) ? time_s : observations::kNoTime_s);
    poses_.push_back(sensor_pose);
    have_horizon_ = have_horizon_ && pose_has_horizon;
}

void ScanFolderWriter::finish() const {
    const fs::path file = folder_ / "times.txt";
    std::ofstream out(file);
    out << std::fixed << std::setprecision(9);
    std::vector<recordings::TimedPose> timed;
    std::vector<mrpt::poses::CPose3D> sensor_poses;
    for (const std::size_t i : recordings::orderOfNames(names_)) {  // in reading order
        out << times_s_[i] << "\n";
        if (!poses_[i]) continue;
        timed.push_back({times_s_[i], *poses_[i]});
        sensor_poses.push_back(*poses_[i]);
    }
    base::closeWritten(out, file);
    if (timed.empty()) return;
    if (have_horizon_) writeTumPoses(folder_ / "poses.tum", timed);
    if (timed.size() < times_s_.size()) return;
    recordings::writeKittiPoses(folder_ / "poses.txt", sensor_poses);
}

}  // namespace hagen::convert
