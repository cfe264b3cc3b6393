#pragma once
#include <hagen/range_image/Label.h>
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <cstdint>
#include <vector>

namespace hagen::evaluation {

/// Zermas, Izzat, Papanikolopoulos: "Fast segmentation of 3D point clouds: a paradigm on LiDAR data
/// for autonomous vehicle applications", ICRA 2017. Defaults are the published parameters;
/// docs/baselines.md says what the paper leaves open and what was chosen.
struct ZermasOptions {
    int segments = 3;                ///< N_segs: stretches of the x axis, a plane each
    int iterations = 3;              ///< N_iter: times that a plane is fitted
    int lowest_points = 20;          ///< N_LPR: lowest points whose mean height is the LPR's
    float seed_height_m = 0.4f;      ///< Th_seeds: seeds lie lower than this above the LPR
    float ground_distance_m = 0.2f;  ///< Th_dist: ground lies lower than this above the plane
    float run_distance_m = 0.5f;     ///< Th_run: returns of a run are closer than this in turn
    float merge_distance_m = 1.0f;   ///< Th_merge: runs of adjacent lines closer than this merge
    float zone_m = 20.0f;            ///< returns farther than this are ROU, and fit no plane
};

/// Ground plane fitting (GPF, algorithm 1): Rou is ground, Roi is not, Unclassified
/// is out of the sensor's range or of the zone, and takes no part. An entry a return.
/// A stretch whose seeds are fewer than three, or lie on a line, has no plane; what stands there is
/// Roi, the safe side.
/// Throws std::invalid_argument where segments, iterations or lowest_points is below 1.
std::vector<Label> zermasGroundFit(const Scan& scan, const SensorModel& sensor,
                                   const ZermasOptions& options = {});

/// Scan line run (SLR, algorithm 2): the clusters of the returns labelled Roi.
/// A line is a beam's row, which closes on itself. Within a line neighbours closer than Th_run are
/// a run; a run joins the clusters of those returns of the line above that are nearest to
/// its own and closer than Th_merge. Clusters are numbered 1, 2, ... by their first return in the
/// scan's order; 0 for returns that are not Roi. An entry a return.
/// `labels` has an entry a return, else std::invalid_argument; Roi returns have a finite position.
std::vector<std::int32_t> scanLineRuns(const Scan& scan, const SensorModel& sensor,
                                       const std::vector<Label>& labels,
                                       const ZermasOptions& options = {});

/// The method as a segmenter: RoI is what GPF leaves within `zone_m`. SLR numbers the obstacles and
/// drops none: it changes no label, and is not run.
std::vector<Label> zermasLabels(const Scan& scan, const SensorModel& sensor,
                                const ZermasOptions& options = {});

}  // namespace hagen::evaluation
