#pragma once
#include <hagen/range_image/ColumnMap.h>
#include <hagen/range_image/PixelDirections.h>
#include <hagen/range_image/RangeImage.h>
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <hagen/segmentation/Extraction.h>
#include <hagen/segmentation/FilterWorkspace.h>
#include <hagen/segmentation/Ground.h>
#include <hagen/segmentation/Levelling.h>
#include <hagen/segmentation/Options.h>
#include <hagen/segmentation/OwnLabels.h>
#include <hagen/segmentation/PersistentMaxima.h>
#include <hagen/segmentation/Posture.h>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace hagen {

/// The filter's result for one scan: each stage's image, and the label of each return. Images are
/// I_h x I_w (range angles: I_h - 1 rows), NaN for pixels without a value.
struct SegmentationResult {
    RangeImage range_image;          ///< stage 1
    Image<float> repaired_m;         ///< stage 2, the depth image without one-pixel gaps
    Image<float> proximity_m;        ///< zone_m - depth, at least 0
    std::vector<Maximum> maxima;     ///< stage 3, with birth, death and persistence
    Image<float> sharpened_m;        ///< stage 4, proximity or depth
    Image<float> merged_m;           ///< stage 5, depth again
    Image<float> range_angle_rad;    ///< stage 6
    Image<float> smoothed_rad;       ///< stage 7
    Image<float> pixel_angle_rad;    ///< the angle of each pixel, used for labelling
    Image<Label> labels;             ///< stage 8, relabelled by height, limited to the zone
    Ground ground;                   ///< beyond the paper, see Ground.h
    Image<std::int32_t> components;  ///< obstacles, numbered from the nearest
    OwnLabels own_labels;            ///< of returns behind the closest one of their pixel
    LabelledReturns returns;         ///< stage 9, for each return of the scan
};

/// The Hagen filter for one sensor: separates near obstacles (RoI) from ground and far returns
/// (ROU). It has no state but the reused memory of its result and workspace. Filters do not depend
/// on each other or on the thread that runs them.
///
///     HagenFilter filter(sensorModel("VLP-16"));
///     Scan scan = ...;                       // coordinates; locateBeams() for the rest
///     const SegmentationResult& result = filter.segment(scan);
///     for (const auto i : result.returns.roi) avoid(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
class HagenFilter {
 public:
    /// Throws std::invalid_argument if options and sensor do not fit together; see checkOptions().
    explicit HagenFilter(SensorModel sensor, Options options = {});

    /// Segments one scan, which may be empty. `attitude` is the sensor's tilt, if known; a sensor
    /// may be mounted at any angle if it is. The images of a sensor that is upside down or on its
    /// side have the rows of its posture (Posture.h). The result is valid until the next call.
    /// Throws std::invalid_argument, saying what to call, if the scan has no ranges, azimuths and
    /// rows yet, or rows of another sensor (checkLocated()); the result is then unchanged.
    const SegmentationResult& segment(const Scan& scan,
                                      const std::optional<Attitude>& attitude = {});

    /// The same on images with the columns of a map of `options().columns` only, which takes less
    /// time: for scans that have few returns outside a window. A sensor that is not upright gets
    /// all columns.
    const SegmentationResult& segment(const Scan& scan, const std::optional<Attitude>& attitude,
                                      const ColumnMap& columns);

    /// Takes the result out of the filter, which uses the memory of `result` for the next scan
    /// instead. Keeps results beyond the next call without copying them.
    void exchangeResult(SegmentationResult& result) { std::swap(result_, result); }

    const SensorModel& sensor() const { return sensor_; }
    const Options& options() const { return options_; }

 private:
    /// The rows and columns of the image in one posture of the sensor.
    struct View {
        SensorModel sensor;
        PixelDirections directions;
    };
    View viewIn(Posture posture) const;
    const SegmentationResult& segment(const Scan& scan, const std::optional<Attitude>& attitude,
                                      const ColumnMap* columns);
    void runStages(const Scan& scan, const std::optional<Attitude>& horizon, const View& view,
                   const ColumnMap* columns);
    void judgeByGround(const Scan& scan, const std::optional<Attitude>& horizon,
                       const PixelDirections& directions,
                       const std::vector<std::int32_t>* even_columns);
    void judgeByHeight(const std::vector<std::int32_t>* even_columns);

    SensorModel sensor_;
    Options options_;
    std::map<Posture, View> views_;  ///< those that were needed so far
    SegmentationResult result_;
    FilterWorkspace work_;
};

}  // namespace hagen
