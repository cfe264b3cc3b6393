#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <hagen/segmentation/HagenFilter.h>
#include <hagen/segmentation/Options.h>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hagen::pictures {

/// A segmented scan to draw: what one call of HagenFilter::segment() was given and made. Refers to
/// the caller's.
struct StageView {
    const Scan& scan;  ///< what the filter was given; with a sliding window, all of the window
    const SensorModel& sensor;
    const Options& options;
    const SegmentationResult& result;
    std::string title;  ///< any text; where the scan comes from
    /// The column (the one closest to this finite azimuth, counter-clockwise from x) whose
    /// principal components are shown. None: that of the nearest RoI pixel whose column the
    /// analysis smoothed, else of the nearest RoI pixel, else straight ahead.
    std::optional<float> azimuth_deg = std::nullopt;
};

/// The pictures that drawStages() makes: one a stage, and an overview of all.
const std::vector<std::string>& stagePictures();
/// A folder of such pictures, or of folders of them.
extern const base::OutputKind kStagePictures;

/// Draws what each stage made of a scan, as PNGs of these names in `folder`, which is there:
///
///   1_depth.png        the depth image
///   2_maxima.png       its persistent maxima, and the barcode of their births and deaths
///   3_merged.png       the depth image with the maxima sharpened
///   4_range_angle.png  the range angle image
///   5_smoothed.png     the same smoothed, and one column's principal components
///   6_labels.png       RoI and ROU, a colour an obstacle
///   7_top_view.png     the returns from above, in the same colours
///   stages.png         all of them
///
/// Images have the azimuth from +180 to -180 degrees, left of the sensor on the left, and the
/// lowest beam at the bottom; pixels without a value are grey. One call runs gnuplot once.
/// Throws std::runtime_error as runGnuplot() does.
void drawStages(const StageView& view, const std::filesystem::path& folder);

}  // namespace hagen::pictures
