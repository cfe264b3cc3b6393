#include "evaluation/baselines/BaselineBogoslavskyi.h"
#include <hagen/scan/Angle.h>
#include <hagen/scan/RangeImage.h>
#include <Eigen/Core>
#include <cmath>
#include <stdexcept>
#include <string>
#include "filter/image/GapRepair.h"
#include "filter/paper/RangeAngle.h"

namespace hagen::evaluation {
namespace {

float radiansOf(float angle_deg) {
    return static_cast<float>(radians(static_cast<double>(angle_deg)));
}

/// Savitzky and Golay's smoothing weights: those of the rows -half ... half in the value at 0 of
/// the least-squares parabola through them.
Eigen::VectorXf parabolaWeights(int half) {
    if (half == 0) return Eigen::VectorXf::Ones(1);
    double squares = 0, fourth_powers = 0;
    for (int k = -half; k <= half; ++k) {
        squares += k * k;
        fourth_powers += static_cast<double>(k * k) * (k * k);
    }
    const double determinant = (2 * half + 1) * fourth_powers - squares * squares;
    Eigen::VectorXf weights(2 * half + 1);
    for (int k = -half; k <= half; ++k) {
        weights[k + half] = static_cast<float>((fourth_powers - squares * (k * k)) / determinant);
    }
    return weights;
}

/// Grows the ground breadth-first from the lowest pixel of each column.
Image<bool> growGround(const Image<float>& depth_m, const Image<float>& angle_rad,
                       const BogoslavskyiOptions& options) {
    const int rows = static_cast<int>(angle_rad.rows());
    const int columns = static_cast<int>(angle_rad.cols());
    const float start_rad = radiansOf(options.start_angle_deg);
    const float difference_rad = radiansOf(options.ground_difference_deg);
    Image<bool> ground = Image<bool>::Constant(rows, columns, false);
    std::vector<int> queue;
    for (int column = 0; column < columns; ++column) {
        int row = 0;
        while (row < rows && !hasValue(depth_m(row, column))) ++row;
        if (row == rows || !(angle_rad(row, column) < start_rad)) continue;
        ground(row, column) = true;
        queue.push_back(column * rows + row);
    }
    for (std::size_t next = 0; next < queue.size(); ++next) {
        const int row = queue[next] % rows, column = queue[next] / rows;
        forEachOf4Neighbours(row, column, rows, columns, [&](int to_row, int to_column) {
            const float difference =
                std::abs(angle_rad(to_row, to_column) - angle_rad(row, column));
            if (ground(to_row, to_column) || !(difference < difference_rad)) return;
            ground(to_row, to_column) = true;
            queue.push_back(to_column * rows + to_row);
        });
    }
    return ground;
}

}  // namespace

Image<float> savitzkyGolay(const Image<float>& image, int window) {
    if (window < 1 || window % 2 == 0) {
        throw std::invalid_argument("the number of rows of a smoothing window must be odd, not " +
                                    std::to_string(window));
    }
    const Eigen::VectorXf weights = parabolaWeights(window / 2);
    Image<float> smooth = image;
    for (Eigen::Index column = 0; column < image.cols(); ++column) {
        for (Eigen::Index row = window / 2; row + window / 2 < image.rows(); ++row) {
            const float value =
                image.col(column).segment(row - window / 2, window).matrix().dot(weights);
            if (hasValue(value)) smooth(row, column) = value;  // otherwise the window has a gap
        }
    }
    return smooth;
}

std::vector<Label> bogoslavskyiLabels(const Scan& scan, const SensorModel& sensor,
                                      const BogoslavskyiOptions& options) {
    RangeImage image;
    ProjectionWorkspace work;
    projectScan(scan, sensor, options.columns, sensor.max_range_m, image, work);
    Image<float> depth_m, between_beams_rad, angle_rad;
    repairGaps(image.depth_m, options.repair_step_m, depth_m);
    rangeAngles(depth_m, pixelDirections(sensor, 0), between_beams_rad);
    carryAngles(savitzkyGolay(between_beams_rad, options.smoothing_window), angle_rad);
    const Image<bool> ground = growGround(depth_m, angle_rad, options);

    std::vector<Label> labels(scan.size(), Label::Unclassified);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const std::int32_t pixel = image.depth_mapper[i];
        if (pixel == RangeImage::kNoPixel) continue;
        const bool is_roi = !ground.data()[pixel] && scan.range_m[i] <= options.zone_m;
        labels[i] = is_roi ? Label::Roi : Label::Rou;
    }
    return labels;
}

}  // namespace hagen::evaluation
