#include "convert/simulated/GroundTruthFolder.h"

#include <hagen/recordings/ScanFolder.h>
#include "base/WriteFile.h"

#include <fstream>
#include <iomanip>

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

}  // namespace

GroundTruthFolder::GroundTruthFolder(const fs::path& folder, bool overwrite, const Attitude& mount)
    : path_(folder, recordings::kScanFolders, overwrite), writer_(made(path_.temporary()), mount) {
    fs::create_directory(path_.temporary() / "semantic");
    writeKinds(path_.temporary() / "kinds.yaml");
    base::writeText("Made by rawlog-simulate, which may replace this folder.\n",
                    path_.temporary() / recordings::ScanFolder::kSimulatedBy,
                    path_.path() / recordings::ScanFolder::kSimulatedBy);
}

void GroundTruthFolder::write(const Scan& scan, const GroundTruthLabels& truth,
                              const SensorModel& sensor, double time_s,
                              const mrpt::poses::CPose3D& sensor_pose, double altitude_m) {
    LabelledReturns returns;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        returns.label.push_back(sensor.sees(scan.range_m[i]) ? simulation::labelOf(truth.kind[i])
                                                             : Label::Unclassified);
    }
    returns.component.assign(truth.object.begin(), truth.object.end());
    const std::string name = scanName(altitudes_m_.size());
    writer_.write(name, scan, returns, sensor, time_s, sensor_pose, true);
    recordings::writeLabels(path_.temporary() / "semantic" / (name + ".label"),
                            asLabels(truth.kind), returns.component);
    altitudes_m_.push_back(altitude_m);
}

void GroundTruthFolder::finish() {
    const fs::path file = path_.temporary() / "altitudes.txt";
    std::ofstream out(file);
    out << std::fixed << std::setprecision(3);
    for (const double altitude_m : altitudes_m_) out << altitude_m << "\n";
    base::closeWritten(out, file);
    writer_.finish();
}

void GroundTruthFolder::commit() {
    finish();
    path_.commit();
}

fs::path GroundTruthFolder::keepPartial() {
    finish();
    return path_.keepPartial();
}

}  // namespace hagen::convert
