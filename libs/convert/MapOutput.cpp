#include <hagen/convert/MapOutput.h>
#include <hagen/mrpt/MapFile.h>
#include <hagen/mrpt/TimeStamp.h>
#include "convert/ConversionOutputs.h"
#include "mrpt/Deskew.h"

#include <algorithm>
#include <chrono>

namespace hagen::convert {

namespace {

using mrpt::poses::CPose3D;

Eigen::Isometry3d isometryOf(const CPose3D& pose) {
    return Eigen::Isometry3d(
        Eigen::Matrix4d(pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen()));
}

double durationOf(const Scan& scan) {
    const auto last = std::max_element(scan.time_s.begin(), scan.time_s.end());
    const double duration_s = last == scan.time_s.end() ? 0 : static_cast<double>(*last);
    return std::isfinite(duration_s) && observations::isTime(duration_s) ? duration_s : 0;
}

mrpt::Clock::time_point later(mrpt::Clock::time_point time, double by_s) {
    return time +
           std::chrono::duration_cast<mrpt::Clock::duration>(std::chrono::duration<double>(by_s));
}

}  // namespace

std::optional<PlacedScan> placeInMap(const observations::ObservationSegmenter::Output& segmented,
                                     const mrpt::obs::CObservation& observation,
                                     const observations::Trajectory& vehicle) {
    if (!segmented.pose.sensor_pose) return std::nullopt;
    const CPose3D& sensor_on_vehicle = segmented.pose.sensor_on_vehicle;
    Scan scan = *segmented.scan;
    const bool moves =
        !scan.time_s.empty() && observations::deskew(vehicle, observation.timestamp,
                                                     sensor_on_vehicle, *segmented.sensor, scan);
    const double duration_s = durationOf(scan);
    const auto middle =
        moves ? vehicle.at(later(observation.timestamp, duration_s / 2)) : std::nullopt;

    PlacedScan placed{{}, !moves};
    observations::MappedScan& mapped = placed.mapped;
    mapped.time_s = observations::secondsOf(observation.timestamp) + duration_s;
    mapped.origin_m = isometryOf(middle ? *middle + sensor_on_vehicle : *segmented.pose.sensor_pose)
                          .translation()
                          .cast<float>();
    const Eigen::Isometry3d to_map = isometryOf(*segmented.pose.sensor_pose);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const Label label = segmented.result->returns.label[i];
        if (label == Label::Unclassified) continue;
        const Eigen::Vector3d seen(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        mapped.points_m.push_back((to_map * seen).cast<float>());
        mapped.labels.push_back(label);
    }
    return placed;
}

MapOutput::MapOutput(const std::vector<std::filesystem::path>& files,
                     const observations::ScanMapOptions& options, bool overwrite)
    : map_(options) {
    for (const auto& file : files) {
        observations::checkMapFile(file);
        all_.add(files_.emplace_back(file, base::kFile, overwrite));
    }
}

/// Writes the formats that modify the tree most last, because the tree is not copied: it may fill
/// the memory.
void MapOutput::write() {
    for (const char* ending : {".3Dscene", ".ot", ".bt"}) {
        for (const base::OutputPath& file : files_) {
            if (file.path().extension() != ending) continue;
            all_.write(file, [&] {
                observations::saveMapInPlace(map_.tree(), file.temporary(), file.path());
            });
        }
    }
}

void MapOutput::commit() { all_.commit(); }

std::string MapOutput::keepPartial() {
    std::string names;
    for (base::OutputPath& file : files_) {
        all_.write(file,
                   [&] { names += (names.empty() ? "" : " ") + file.keepPartial().string(); });
    }
    if (!all_.failures().empty()) throw std::runtime_error(all_.failures());
    return names;
}

}  // namespace hagen::convert
