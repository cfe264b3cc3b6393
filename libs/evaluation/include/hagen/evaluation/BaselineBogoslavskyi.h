#pragma once
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <cstdint>
#include <vector>

namespace hagen::evaluation {

/// Bogoslavskyi, Stachniss: "Efficient online segmentation for sparse 3D laser scans", PFG 85
/// (2017) 41-52; the clusters are those of "Fast range image-based segmentation of sparse 3D laser
/// scans for online operation", IROS 2016. Defaults are the published parameters where the papers
/// state them; docs/baselines.md lists the others.
struct BogoslavskyiOptions {
    int columns = 870;  ///< width of the range image
    float repair_step_m =
        1.0f;  ///< gaps are filled if the depths on both sides differ by less than this
    int smoothing_window = 5;            ///< Savitzky-Golay filter: odd number of rows; 1: none
    float start_angle_deg = 45.0f;       ///< the lowest pixel is ground unless steeper than this
    float ground_difference_deg = 5.0f;  ///< neighbouring ground pixels differ by less than this
    float cluster_angle_deg =
        10.0f;             ///< theta: neighbours belong to one cluster if beta exceeds this
    float zone_m = 20.0f;  ///< returns farther than this are ROU (not in the papers)
};

/// Savitzky-Golay filter along each column: a pixel gets the value of the least-squares parabola
/// through the `window` values around it. A pixel whose window is incomplete, at an edge or next to
/// a gap, keeps its value; NaN stays NaN. `window` must be odd and positive, otherwise throws
/// std::invalid_argument; 1 changes nothing.
Image<float> savitzkyGolay(const Image<float>& image, int window);

/// Returns the method as a segmenter: RoI is everything within `zone_m` that is not ground. Ground
/// grows breadth-first from the lowest pixel of each column over the smoothed image of inclination
/// angles. A return takes its pixel's label; a pixel without an angle defaults to Roi
/// (conservative). One label per return; Unclassified outside the sensor's range limits. Clusters
/// do not change any label.
std::vector<Label> bogoslavskyiLabels(const Scan& scan, const SensorModel& sensor,
                                      const BogoslavskyiOptions& options = {});

/// Returns the clusters of the returns labelled Roi: neighbours in the range image with depths d1
/// >= d2, seen `a` apart, belong to one object if
///
///   beta = atan2(d2 sin a, d1 - d2 cos a) > theta.
///
/// Clusters are numbered 1, 2, ... by their first return in the scan's order; 0 for returns that
/// are not Roi. One entry per return. `labels` must have one entry per return, otherwise throws
/// std::invalid_argument.
std::vector<std::int32_t> bogoslavskyiClusters(const Scan& scan, const SensorModel& sensor,
                                               const std::vector<Label>& labels,
                                               const BogoslavskyiOptions& options = {});

}  // namespace hagen::evaluation
