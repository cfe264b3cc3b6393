#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/simulation/ObjectClass.h>
#include "convert/ScanFolderWriter.h"

#include <filesystem>
#include <vector>

namespace hagen::convert {

/// Ground truth of a simulated scan, one entry per return.
struct GroundTruthLabels {
    std::vector<simulation::ObjectClass> kind;
    std::vector<std::uint16_t> object;
};

/// Writes simulated scans with ground truth as a scan folder (see ScanFolder.h):
///
///     labels/NNNNNN.label     the label, and the object's number
///     semantic/NNNNNN.label   the number of the object class, and the object's
///     kinds.yaml              names and labels of the classes
///     simulated_by.txt        marks the folder as replaceable
///     altitudes.txt           height of the sensor above the ground [m], one line per scan
class GroundTruthFolder {
 public:
    /// `mount` is the sensor's tilt on the level vehicle. Throws std::runtime_error if the folder
    /// cannot be written.
    GroundTruthFolder(const std::filesystem::path& folder, bool overwrite,
                      const Attitude& mount = {});

    const base::OutputPath& place() const { return path_; }
    void write(const Scan& scan, const GroundTruthLabels& truth, const SensorModel& sensor,
               double time_s, const mrpt::poses::CPose3D& sensor_pose, double altitude_m);
    /// Completes the folder and renames it into place.
    void commit();
    /// Keeps the folder as a partial folder and returns its name.
    std::filesystem::path keepPartial();

 private:
    void finish();

    base::OutputPath path_;
    ScanFolderWriter writer_;
    std::vector<double> altitudes_m_;
};

}  // namespace hagen::convert
