#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/logs/ScanFolderWriter.h>
#include <hagen/simulation/Kind.h>

#include <filesystem>
#include <vector>

namespace hagen::simulated_logs {

/// What is known of a simulated scan's returns.
struct Truth {
    std::vector<simulation::Kind> kind;
    std::vector<std::uint16_t> object;
};

/// Writes simulated scans as a scan folder (see ScanFolder.h) with the truth:
///
///     labels/NNNNNN.label     the label, and the object's number
///     semantic/NNNNNN.label   the kind's number, and the object's
///     kinds.yaml              names and labels of those kinds
///     altitudes.txt           height of the sensor above the ground [m], a line a scan
class TruthFolder {
 public:
    /// Throws std::runtime_error where the folder cannot be written.
    TruthFolder(const std::filesystem::path& folder, bool overwrite);

    void write(const Scan& scan, const Truth& truth, const SensorModel& sensor, double time_s,
               const mrpt::poses::CPose3D& sensor_pose, double altitude_m);
    /// Ends it and gives it its name.
    void commit();
    /// Ends it as a part, and returns its name.
    std::filesystem::path keepPartial();

 private:
    void finish();

    base::OutputPath path_;
    logs::ScanFolderWriter writer_;
    std::vector<double> altitudes_m_;
};

}  // namespace hagen::simulated_logs
