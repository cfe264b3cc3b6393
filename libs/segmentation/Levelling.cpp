#include <hagen/segmentation/Levelling.h>
#include <hagen/segmentation/RangeAngle.h>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

namespace hagen {

Eigen::Matrix3f levelFromSensor(const Attitude& attitude) {
    return (Eigen::AngleAxisf(attitude.pitch_rad, Eigen::Vector3f::UnitY()) *
            Eigen::AngleAxisf(attitude.roll_rad, Eigen::Vector3f::UnitX()))
        .toRotationMatrix();
}

void rangeAngles(const Image<float>& depth_m, const PixelDirections& directions,
                 const std::optional<Attitude>& attitude, Image<float>& range_angle_rad) {
    if (!attitude) return rangeAngles(depth_m, directions, range_angle_rad);
    const int rows = static_cast<int>(depth_m.rows()), columns = static_cast<int>(depth_m.cols());
    const Eigen::Matrix3f level = levelFromSensor(*attitude);
    range_angle_rad.resize(rows - 1, columns);
    for (int column = 0; column < columns; ++column) {
        const Eigen::Vector3f outwards = level * Eigen::Vector3f(directions.column_cosine[column],
                                                                 directions.column_sine[column], 0);
        const Eigen::Vector3f upwards = level.col(2);
        const auto at = [&](int row) -> Eigen::Vector3f {
            return depth_m(row, column) *
                   (directions.row_cosine[row] * outwards + directions.row_sine[row] * upwards);
        };
        for (int row = 0; row + 1 < rows; ++row) {
            const Eigen::Vector3f step_m = at(row + 1) - at(row);
            range_angle_rad(row, column) =
                hasValue(depth_m(row, column)) && hasValue(depth_m(row + 1, column))
                    ? std::atan2(std::abs(step_m.z()), step_m.head<2>().norm())
                    : kNoValue;
        }
    }
}

}  // namespace hagen
