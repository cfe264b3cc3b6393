#pragma once
#include <hagen/filter/Extraction.h>
#include <hagen/filter/Ground.h>
#include <hagen/filter/OwnLabels.h>
#include <hagen/filter/PersistentMaxima.h>
#include <hagen/scan/RangeImage.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// The filter's result for one scan: each stage's image, and the label of each return. Images are
/// I_h x I_w (range angles: I_h - 1 rows), NaN for pixels without a value. Stages 3 to 5 and 7 are
/// empty with Options::raw_angles, `components` is empty without Options::number_obstacles.
struct SegmentationResult {
    RangeImage range_image;          ///< stage 1
    Image<float> repaired_m;         ///< stage 2, the depth image without one-pixel gaps
    Image<float> proximity_m;        ///< zone_m - depth, at least 0
    std::vector<Maximum> maxima;     ///< stage 3, with birth, death and persistence
    Image<float> sharpened_m;        ///< stage 4, proximity or depth
    Image<float> merged_m;           ///< stage 5, converted back to depth
    Image<float> range_angle_rad;    ///< stage 6
    Image<float> smoothed_rad;       ///< stage 7
    Image<float> pixel_angle_rad;    ///< the angle of each pixel, used for labelling
    Image<Label> labels;             ///< stage 8, relabelled by height, limited to the zone
    Ground ground;                   ///< beyond the paper, see Ground.h
    Image<std::int32_t> components;  ///< obstacles, numbered from the nearest
    OwnLabels own_labels;            ///< for returns behind the closest return of their pixel
    LabelledReturns returns;         ///< stage 9, for each return of the scan
};

}  // namespace hagen
