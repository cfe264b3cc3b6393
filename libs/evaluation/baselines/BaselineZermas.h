#pragma once
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <vector>

namespace hagen::evaluation {

/// Zermas, Izzat, Papanikolopoulos: "Fast segmentation of 3D point clouds: a paradigm on LiDAR data
/// for autonomous vehicle applications", ICRA 2017. Defaults are the published parameters;
/// docs/baselines.md lists choices where the paper is ambiguous.
struct ZermasOptions {
    int segments = 3;            ///< N_segs: stretches of the x axis, one plane each
    int iterations = 3;          ///< N_iter: number of fits of a plane
    int lowest_points = 20;      ///< N_LPR: number of lowest points that are averaged for the LPR
    float seed_height_m = 0.4f;  ///< Th_seeds: maximum height of seeds above the LPR
    float ground_distance_m = 0.2f;  ///< Th_dist: maximum height of ground above the plane
    float zone_m = 20.0f;  ///< returns farther than this are ROU and are not used for the fit
};

/// Ground plane fitting (GPF, algorithm 1). Returns one label per return: Rou for ground, otherwise
/// Roi; Unclassified outside the sensor's range limits or the zone, where returns are not used. A
/// stretch with fewer than three seeds, or seeds on a line, has no plane; its returns are Roi
/// (conservative). Throws std::invalid_argument for segments, iterations or lowest_points below 1.
std::vector<Label> zermasGroundFit(const Scan& scan, const SensorModel& sensor,
                                   const ZermasOptions& options = {});

/// Like zermasGroundFit(), but returns beyond the zone are ROU. The paper's scan line runs (SLR) do
/// not affect labels and are omitted.
std::vector<Label> zermasLabels(const Scan& scan, const SensorModel& sensor,
                                const ZermasOptions& options = {});

}  // namespace hagen::evaluation
