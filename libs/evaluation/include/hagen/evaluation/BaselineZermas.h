#pragma once
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <cstdint>
#include <vector>

namespace hagen::evaluation {

/// Zermas, Izzat, Papanikolopoulos: "Fast segmentation of 3D point clouds: a paradigm on LiDAR data
/// for autonomous vehicle applications", ICRA 2017. Defaults are the published parameters;
/// docs/baselines.md lists what the paper leaves open and the choices made here.
struct ZermasOptions {
    int segments = 3;            ///< N_segs: stretches of the x axis, one plane each
    int iterations = 3;          ///< N_iter: number of fits of a plane
    int lowest_points = 20;      ///< N_LPR: number of lowest points that are averaged for the LPR
    float seed_height_m = 0.4f;  ///< Th_seeds: seeds are lower than this above the LPR
    float ground_distance_m = 0.2f;  ///< Th_dist: ground is lower than this above the plane
    float run_distance_m = 0.5f;     ///< Th_run: consecutive returns of a run are closer than this
    float merge_distance_m = 1.0f;   ///< Th_merge: runs of adjacent lines merge if closer than this
    float zone_m = 20.0f;  ///< returns farther than this are ROU and are not used for the fit
};

/// Ground plane fitting (GPF, algorithm 1): Rou is ground, Roi is not; Unclassified returns are
/// outside the sensor's range limits or the zone and are not used. One label per return. A stretch
/// with fewer than three seeds, or seeds on a line, has no plane; its returns default to Roi
/// (conservative). Throws std::invalid_argument if segments, iterations or lowest_points is below
/// 1.
std::vector<Label> zermasGroundFit(const Scan& scan, const SensorModel& sensor,
                                   const ZermasOptions& options = {});

/// Scan line run (SLR, algorithm 2): returns the clusters of the returns labelled Roi. A line is
/// the row of a beam; it is circular. Neighbours within a line that are closer than Th_run form a
/// run. A run joins the clusters of the nearest returns in the line above if they are closer than
/// Th_merge. Clusters are numbered 1, 2, ... by their first return in the scan's order; 0 for
/// returns that are not Roi. One entry per return. `labels` must have one entry per return,
/// otherwise throws std::invalid_argument; the positions of Roi returns must be finite.
std::vector<std::int32_t> scanLineRuns(const Scan& scan, const SensorModel& sensor,
                                       const std::vector<Label>& labels,
                                       const ZermasOptions& options = {});

/// Returns the method as a segmenter: RoI is what GPF does not label as ground within `zone_m`. SLR
/// only numbers the obstacles and drops none, so it changes no label and is not run.
std::vector<Label> zermasLabels(const Scan& scan, const SensorModel& sensor,
                                const ZermasOptions& options = {});

}  // namespace hagen::evaluation
