#include <hagen/observations/ScanFolder.h>
#include <hagen/observations/ScanFolderWriter.h>
#include <hagen/range_image/Angle.h>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <stdexcept>

namespace hagen {
namespace {

namespace fs = std::filesystem;

std::string numbered(std::size_t scan) {
    char name[32];
    std::snprintf(name, sizeof name, "%06zu", scan);
    return name;
}

void checkWritten(std::ofstream& out, const fs::path& file) {
    out.close();
    if (!out) throw std::runtime_error(file.string() + ": cannot be written; is the disk full?");
}

void writeSensor(const fs::path& file, const SensorModel& sensor) {
    std::ofstream out(file);
    out << "# Beams of this recording (" << sensor.name << "), lowest first\n"
        << "sensor:\n  model: custom\n  elevations_deg: [" << std::setprecision(9);
    for (int row = 0; row < sensor.rows(); ++row) {
        out << (row > 0 ? ", " : "") << degrees(sensor.elevations_rad[row]);
    }
    out << "]\n  min_range_m: " << sensor.min_range_m << "\n  max_range_m: " << sensor.max_range_m
        << "\n";
    checkWritten(out, file);
}

}  // namespace

ScanFolderWriter::ScanFolderWriter(const fs::path& folder, bool overwrite)
    : path_(folder, OutputPath::Kind::ScanFolder, overwrite) {
    fs::create_directories(path_.temporary() / "velodyne");
    fs::create_directories(path_.temporary() / "labels");
}

void ScanFolderWriter::write(const Scan& scan, const LabelledReturns& returns,
                             const SensorModel& sensor, double time_s, const std::string& name) {
    if (times_s_.empty()) writeSensor(path_.temporary() / "sensor.yaml", sensor);
    const std::string own_name = name.empty() ? numbered(times_s_.size()) : name;
    std::vector<Label> labels(returns.label.begin(), returns.label.begin() + scan.size());
    std::vector<std::int32_t> components(returns.component.begin(),
                                         returns.component.begin() + scan.size());
    writeScan(path_.temporary() / "velodyne" / (own_name + ".bin"), scan);
    writeLabels(path_.temporary() / "labels" / (own_name + ".label"), labels, components);
    times_s_.push_back(time_s);
}

void ScanFolderWriter::writeTimes() const {
    const fs::path file = path_.temporary() / "times.txt";
    std::ofstream out(file);
    out << std::fixed << std::setprecision(6);
    for (const double time_s : times_s_) out << time_s - times_s_.front() << "\n";
    checkWritten(out, file);
}

void ScanFolderWriter::copyPoses(const fs::path& poses_file) {
    fs::copy_file(poses_file, path_.temporary() / "poses.txt");
}

void ScanFolderWriter::commit() {
    writeTimes();
    path_.commit();
}

fs::path ScanFolderWriter::keepPartial() {
    writeTimes();
    return path_.keepPartial();
}

}  // namespace hagen
