#pragma once
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <vector>

namespace hagen::evaluation {

/// Bogoslavskyi, Stachniss: "Efficient online segmentation for sparse 3D laser scans", PFG 85
/// (2017) 41-52. Defaults are the published parameters where the paper states them;
/// docs/baselines.md lists the others.
struct BogoslavskyiOptions {
    int columns = 870;  ///< width of the range image
    float repair_step_m =
        1.0f;  ///< gaps are filled if the depths on both sides differ by less than this
    int smoothing_window = 5;       ///< Savitzky-Golay filter: odd number of rows; 1 disables it
    float start_angle_deg = 45.0f;  ///< the lowest pixel is ground unless steeper than this
    float ground_difference_deg = 5.0f;  ///< neighbouring ground pixels differ by less than this
    float zone_m = 20.0f;                ///< returns farther than this are ROU (not in the paper)
};

/// Savitzky-Golay filter along each column: the least-squares parabola through the `window` values
/// around a pixel. A pixel with an incomplete window, at an edge or next to a gap, keeps its value.
/// Throws std::invalid_argument unless `window` is odd and positive; 1 changes nothing.
Image<float> savitzkyGolay(const Image<float>& image, int window);

/// Returns one label per return: RoI within `zone_m` unless ground; Unclassified outside the
/// sensor's range limits. Ground grows breadth-first from the lowest pixel of each column over the
/// smoothed image of inclination angles. A pixel without an angle is Roi (conservative). The
/// paper's clusters do not affect labels and are omitted.
std::vector<Label> bogoslavskyiLabels(const Scan& scan, const SensorModel& sensor,
                                      const BogoslavskyiOptions& options = {});

}  // namespace hagen::evaluation
