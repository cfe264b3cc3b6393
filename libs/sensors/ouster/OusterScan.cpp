#include "sensors/ouster/OusterScan.h"

#include <hagen/scan/Angle.h>

#include <algorithm>
#include <cmath>

namespace hagen::sensors {
namespace {

struct ColumnPlace {
    double encoder_rad;  ///< encoder angle, counter-clockwise
    float time_s;
};

void add(const OusterSensor& sensor, std::size_t pixel, const ColumnPlace& column, double range_m,
         std::uint8_t reflectivity, Scan& scan) {
    const double azimuth_rad = column.encoder_rad + sensor.azimuth_rad[pixel];
    const double altitude_rad = sensor.altitude_rad[pixel];
    const double from_beam_m = range_m - std::hypot(sensor.beam_origin_m, sensor.beam_origin_up_m);
    const double level_m = from_beam_m * std::cos(altitude_rad);
    const Eigen::Vector3d in_lidar(
        level_m * std::cos(azimuth_rad) + sensor.beam_origin_m * std::cos(column.encoder_rad),
        level_m * std::sin(azimuth_rad) + sensor.beam_origin_m * std::sin(column.encoder_rad),
        from_beam_m * std::sin(altitude_rad) + sensor.beam_origin_up_m);
    const Eigen::Vector3f point = (sensor.lidar_to_sensor.linear() * in_lidar).cast<float>();
    scan.x_m.push_back(point.x());
    scan.y_m.push_back(point.y());
    scan.z_m.push_back(point.z());
    scan.intensity.push_back(static_cast<float>(reflectivity) / 255.0f);
    scan.range_m.push_back(point.norm());
    scan.azimuth_rad.push_back(std::atan2(point.y(), point.x()));
    scan.row.push_back(sensor.row[pixel]);
    scan.time_s.push_back(column.time_s);
}

}  // namespace

Scan scanOf(const OusterFrame& frame, const OusterSensor& sensor) {
    std::vector<std::size_t> measured;  // columns in order of measurement
    for (std::size_t column = 0; column < frame.columns; ++column) {
        if (frame.state[column] == OusterFrame::Column::Valid) measured.push_back(column);
    }
    std::stable_sort(measured.begin(), measured.end(), [&](std::size_t a, std::size_t b) {
        return frame.column_time_ns[a] < frame.column_time_ns[b];
    });
    Scan scan;
    scan.reserve(measured.size() * sensor.pixels);
    scanColumns(frame, sensor, measured, scan);
    return scan;
}

void scanColumns(const OusterFrame& frame, const OusterSensor& sensor,
                 const std::vector<std::size_t>& columns, Scan& scan) {
    scan.clear();
    const double unit_m = static_cast<double>(sensor.profile.range_unit_m);
    for (const std::size_t column : columns) {
        if (frame.state[column] != OusterFrame::Column::Valid) continue;
        const double turned =
            static_cast<double>(column) / static_cast<double>(sensor.columns_per_frame);
        const std::uint64_t since_ns =
            frame.column_time_ns[column] - frame.column_time_ns[columns.front()];
        const ColumnPlace place{2 * kPi * (1 - turned),
                                static_cast<float>(1e-9 * static_cast<double>(since_ns))};
        for (const std::size_t pixel : sensor.beam_pixels) {
            const std::size_t at = frame.at(pixel, column);
            if (frame.range[at] > 0) {
                add(sensor, pixel, place, unit_m * frame.range[at], frame.reflectivity[at], scan);
            }
            if (!frame.second_range.empty() && frame.second_range[at] > 0) {
                add(sensor, pixel, place, unit_m * frame.second_range[at],
                    frame.second_reflectivity[at], scan);
            }
        }
    }
    scan.beams = beamSpan(*sensor.model);
}

}  // namespace hagen::sensors
