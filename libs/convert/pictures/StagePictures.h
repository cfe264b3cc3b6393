#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/filter/HagenFilter.h>
#include <hagen/filter/Options.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <filesystem>
#include <optional>
#include <string>

namespace hagen::convert {

/// A segmented scan to draw: input and result of one call of HagenFilter::segment(). Keeps
/// references to the caller's objects.
struct StageView {
    const Scan& scan;           ///< result of turnScan() if the sensor is not upright
    const SensorModel& sensor;  ///< sensor of the image rows, from sensorIn()
    const Options& options;
    const SegmentationResult& result;
    std::string title;  ///< for example the source of the scan
    /// Azimuth (finite, counter-clockwise from x) of the column whose principal components are
    /// shown (rounded to the nearest column). Default: the column of the nearest RoI pixel in a
    /// smoothed column, otherwise of the nearest RoI pixel, otherwise straight ahead.
    std::optional<float> azimuth_deg = std::nullopt;
};

/// The output kind: a folder of the pictures of drawStages(), or a folder of such folders.
extern const base::OutputKind kStagePictures;

/// Draws the result of each stage for a scan as PNGs in the existing `folder`:
///
///     overview.png       top view with the nearest obstacles labelled, and the images below
///     1_depth.png        the distance image
///     2_maxima.png       its persistent maxima, and the barcode of their births and deaths
///     3_merged.png       the distance image with sharpened maxima
///     4_range_angle.png  the range angle image
///     5_smoothed.png     the smoothed image, and the principal components of one column
///     6_labels.png       RoI and ROU; neighbouring obstacles differ in colour
///     7_top_view.png     the returns in top view, in the same colours
///
/// Images show azimuths from +180 to -180 degrees, left of the sensor on the left, with the lowest
/// beam at the bottom; pixels without a value are grey. Throws std::invalid_argument if the images
/// do not have one row per beam, std::runtime_error like Drawing::draw().
void drawStages(const StageView& view, const std::filesystem::path& folder);

}  // namespace hagen::convert
