#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <cstdint>
#include <vector>

namespace hagen::evaluation {

/// Bogoslavskyi, Stachniss: "Efficient online segmentation for sparse 3D laser scans", PFG 85
/// (2017) 41-52; the clusters are those of "Fast range image-based segmentation of sparse 3D laser
/// scans for online operation", IROS 2016. Defaults are the published parameters where the papers
/// name them; docs/baselines.md says which are not theirs.
struct BogoslavskyiOptions {
    int columns = 870;                   ///< width of the range image
    float repair_step_m = 1.0f;          ///< holes between depths closer than this are filled
    int smoothing_window = 5;            ///< Savitzky-Golay filter: odd number of rows; 1: none
    float start_angle_deg = 45.0f;       ///< steeper lowest pixels are no ground
    float ground_difference_deg = 5.0f;  ///< ground's neighbours differ by less than this
    float cluster_angle_deg = 10.0f;     ///< theta: neighbours of a cluster have beta above this
    float zone_m = 20.0f;                ///< returns farther than this are ROU (not in the papers)
};

/// Savitzky-Golay filter along each column: a pixel gets the value at its place of the parabola
/// that fits the `window` values around it best. A pixel whose window is not whole, at an edge or
/// beside a gap, keeps its value; NaN stays NaN.
/// `window` is odd and positive, else std::invalid_argument; 1 changes nothing.
Image<float> savitzkyGolay(const Image<float>& image, int window);

/// The method as a segmenter: RoI is what is no ground within `zone_m`.
/// Ground grows breadth-first from the lowest pixel of each column over the smoothed image of
/// inclination angles. A return takes its pixel's label; a pixel without an angle is Roi, the safe
/// side. An entry a return; Unclassified out of the sensor's range.
/// Clusters change no label.
std::vector<Label> bogoslavskyiLabels(const Scan& scan, const SensorModel& sensor,
                                      const BogoslavskyiOptions& options = {});

/// The clusters of the returns labelled Roi: neighbours in the range image of depths
/// d1 >= d2, seen `a` apart, are of one object if
///
///   beta = atan2(d2 sin a, d1 - d2 cos a) > theta.
///
/// Clusters are numbered 1, 2, ... by their first return in the scan's order; 0 for returns that
/// are not Roi. An entry a return. `labels` has an entry a return, else std::invalid_argument.
std::vector<std::int32_t> bogoslavskyiClusters(const Scan& scan, const SensorModel& sensor,
                                               const std::vector<Label>& labels,
                                               const BogoslavskyiOptions& options = {});

}  // namespace hagen::evaluation
