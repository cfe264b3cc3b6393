#include "convert/ViewOutput.h"

#include <hagen/scan/Angle.h>
#include <algorithm>
#include <cmath>
#include "base/Folder.h"
#include "base/NumberText.h"
#include "base/WriteFile.h"
#include "base/view/ViewPage.h"
#include "filter/RoiBoxes.h"
#include "filter/image/Posture.h"

namespace hagen::convert {
namespace {

using base::Json;
using observations::ObservationSegmenter;

constexpr std::size_t kMaxFrames = 500, kMaxBytes = 39'000'000;  // the page itself has 1 MB
constexpr int kMaxAngleColumns = 450, kMaxBoxes = 30;
constexpr double kGroundStep_m = 1.5;
constexpr double kMaxBack_s = 1, kMaxGap_s = 3600, kAssumedPeriod_s = 0.1, kMinApart_s = 0.001;

double rounded(double value) { return std::round(1000 * value) / 1000; }

/// The first three rows of a transform.
template <class Matrix>
Json json(const Matrix& transform) {
    Json rows = Json::array();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            rows.push_back(std::round(1e5 * static_cast<double>(transform(row, column))) / 1e5);
        }
    }
    return rows;
}

/// Returns by pixel, nearest first. Leaves out those without a range.
base::ViewReturns returnsOf(const Scan& scan, const SegmentationResult& result) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < scan.size(); ++i) {
        if (hasValue(scan.range_m[i]) && scan.range_m[i] > 0) order.push_back(i);
    }
    const auto& pixel = result.range_image.depth_mapper;
    const int rows = static_cast<int>(result.labels.rows());
    // By row, because neighbours in a row have similar ranges.
    const auto key = [&](std::uint32_t i) {
        return std::make_tuple(pixel[i] % rows, pixel[i] / rows, scan.range_m[i]);
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    base::ViewReturns returns;
    returns.rows = rows;
    returns.columns = static_cast<int>(result.labels.cols());
    for (const std::uint32_t i : order) {
        returns.add(scan.x_m[i], scan.y_m[i], scan.z_m[i],
                    static_cast<std::uint8_t>(result.returns.label[i]));
        returns.obstacle.push_back(result.returns.component[i]);
        returns.pixel.push_back(pixel[i]);
        if (scan.intensity.empty()) continue;
        returns.intensity.push_back(scan.intensity[i]);
    }
    return returns;
}

/// Angles from 0 to 90 degrees as 1 to 64, row by row, every `step` columns; 0: none.
std::vector<std::uint8_t> bytesOf(const Image<float>& angle_rad, int step) {
    std::vector<std::uint8_t> bytes;
    for (int row = 0; row < angle_rad.rows(); ++row) {
        for (int column = 0; column < angle_rad.cols(); column += step) {
            const float value = angle_rad(row, column);
            bytes.push_back(hasValue(value)
                                ? base::roundedTo<std::uint8_t>(
                                      1 + 63 * std::abs(static_cast<double>(value)) / (kPi / 2))
                                : std::uint8_t{0});
        }
    }
    return bytes;
}

Json boxesOf(const Scan& scan, const LabelledReturns& returns) {
    Json boxes = Json::array();
    for (const RoiBox& box : boxRoiComponents(scan, returns)) {
        Json values = {box.component, box.returns, rounded(static_cast<double>(box.nearest_m))};
        for (const Eigen::Vector3f& corner : {box.extents_m.min(), box.extents_m.max()}) {
            for (const float value : corner) {
                values.push_back(std::round(100 * static_cast<double>(value)) / 100);
            }
        }
        boxes.push_back(values);
        if (boxes.size() == kMaxBoxes) break;
    }
    return boxes;
}

/// The ground within the zone, as a square grid of heights in cm in the ground frame.
Json groundOf(const Ground& ground, const Eigen::Matrix3f& image_from_sensor, float zone_m,
              base::ViewArrays& arrays) {
    const int half = static_cast<int>(std::ceil(static_cast<double>(zone_m) / kGroundStep_m));
    std::vector<std::int16_t> heights;
    for (int j = -half; j <= half; ++j) {
        for (int i = -half; i <= half; ++i) {
            const double height_m =
                ground.has_surface
                    ? static_cast<double>(ground.surface.at(static_cast<float>(i * kGroundStep_m),
                                                            static_cast<float>(j * kGroundStep_m)))
                    : 0;
            heights.push_back(base::roundedTo<std::int16_t>(100 * height_m));
        }
    }
    arrays.add("ground", heights, true);
    Eigen::Isometry3f from_image = ground.from_sensor;
    from_image.linear() *= image_from_sensor.transpose();
    return {{"from_scan", json(from_image.matrix())},
            {"min_m", -half * kGroundStep_m},
            {"step_m", kGroundStep_m},
            {"side", 2 * half + 1}};
}

Json valuesOf(const ScanReport& report, bool is_ground_seen) {
    const double share = 100 * static_cast<double>(report.roi) /
                         static_cast<double>(std::max<std::size_t>(1, report.returns));
    const auto nearest_m = static_cast<double>(report.nearest_roi_m);
    return {
        {"scan", report.name},
        {"sensor", report.sensor_label},
        {"nearest obstacle", std::isnan(nearest_m) ? "none" : base::fixedText(nearest_m, 1) + " m"},
        {"obstacles", std::to_string(report.obstacles)},
        {"RoI returns", base::fixedText(share, 1) + " %"},
        {"ground", is_ground_seen ? "seen" : "not seen"},
        {"time per scan", base::fixedText(report.latency_ms, 1) + " ms"}};
}

/// Increasing times from the first scan [s]. Scans of one LiDAR at the same time are assumed to be
/// 0.1 s apart, also scans after a jump of the clock.
std::vector<double> timesOf(const std::vector<ScanReport>& scans) {
    std::vector<double> times_s;
    double time_s = 0;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        if (i == 0) {
            times_s.push_back(0);
            continue;
        }
        const double apart_s = scans[i].time_s - scans[i - 1].time_s;
        const bool is_jump = !(apart_s > -kMaxBack_s && apart_s < kMaxGap_s);
        const bool is_untimed = apart_s == 0 && scans[i].sensor_label == scans[i - 1].sensor_label;
        time_s += is_jump || is_untimed ? kAssumedPeriod_s : apart_s;
        times_s.push_back(std::max(time_s, times_s.back() + kMinApart_s));
    }
    return times_s;
}

template <class Value>
Json chart(const char* label, const std::vector<double>& times_s,
           const std::vector<ScanReport>& scans, Value value) {
    Json times = Json::array(), values = Json::array();
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const auto number = static_cast<double>(value(scans[i]));
        times.push_back(rounded(times_s[i]));
        values.push_back(std::isnan(number) ? Json() : Json(rounded(number)));
    }
    return {{"label", label}, {"times_s", times}, {"values", values}};
}

}  // namespace

ViewOutput::ViewOutput(const std::filesystem::path& file, std::size_t every, bool overwrite)
    : path_(file, base::kFile, overwrite),
      is_thinned_(every == 0),
      every_(std::max<std::size_t>(1, every)) {}

/// The pose of the image frame in the page: from the map, otherwise from the attitude. Empty if
/// unknown.
Json ViewOutput::poseOf(const ObservationSegmenter::Output& segmented,
                        const Eigen::Matrix3f& image_from_sensor) {
    Eigen::Isometry3d from_sensor = Eigen::Isometry3d::Identity();
    if (segmented.pose.sensor_pose) {
        const mrpt::poses::CPose3D& pose = *segmented.pose.sensor_pose;
        from_sensor.linear() = pose.getRotationMatrix().asEigen();
        from_sensor.translation() = Eigen::Vector3d(pose.x(), pose.y(), pose.z());
        if (!origin_m_) origin_m_ = from_sensor.translation();
        from_sensor.translation() -= *origin_m_;
    } else if (segmented.pose.attitude) {
        from_sensor.linear() = levelFromSensor(*segmented.pose.attitude).cast<double>();
    } else {
        return {};
    }
    from_sensor.linear() *= image_from_sensor.cast<double>().transpose();
    return json(from_sensor.matrix());
}

void ViewOutput::write(const ScanReport& report, const ObservationSegmenter::Output& segmented) {
    const std::size_t number = scans_++, of_lidar = scans_of_lidar_[report.sensor_label]++;
    if (of_lidar % every_ != 0) return;
    const SegmentationResult& result = *segmented.result;
    const int step = 1 + static_cast<int>(result.range_angle_rad.cols() - 1) / kMaxAngleColumns;
    const std::optional<Attitude>& attitude = segmented.pose.attitude;
    const Eigen::Matrix3f image_from_sensor =
        imageFromSensor(postureOf(attitude, *segmented.sensor), attitude);
    Scan scan = *segmented.scan;
    rotatePoints(image_from_sensor, *segmented.scan, scan);
    base::ViewArrays arrays;
    addReturns(returnsOf(scan, result), arrays);
    std::vector<std::int32_t> maxima;
    for (const Maximum& maximum : result.maxima) {
        maxima.push_back(static_cast<std::int32_t>(maximum.column * result.labels.rows()) +
                         maximum.row);
    }
    std::sort(maxima.begin(), maxima.end());
    arrays.add("maxima", maxima, true);
    arrays.add("angle", bytesOf(result.range_angle_rad, step), true);
    const bool is_raw = segmented.options->raw_angles;
    arrays.add("smoothed", bytesOf(is_raw ? result.range_angle_rad : result.smoothed_rad, step),
               true);
    Json frame = {{"image", {result.labels.rows(), result.labels.cols()}},
                  {"angle_step", step},
                  {"values", valuesOf(report, result.ground.is_seen)},
                  {"boxes", boxesOf(scan, result.returns)}};
    const Json pose = poseOf(segmented, image_from_sensor);
    if (!pose.is_null()) {
        frame["pose"] = pose;
        frame["is_placed"] = segmented.pose.sensor_pose.has_value();
    }
    if (result.ground.is_seen) {
        frame["ground"] =
            groundOf(result.ground, image_from_sensor, segmented.options->zone_m, arrays);
    }
    frame.update(arrays.json());
    frames_.push_back({number, of_lidar, base::dumpJson(frame)});
    bytes_ += frames_.back().json.size();
    while (is_thinned_ && every_ < scans_ && (frames_.size() > kMaxFrames || bytes_ > kMaxBytes)) {
        every_ *= 2;
        frames_.erase(
            std::remove_if(frames_.begin(), frames_.end(),
                           [&](const Frame& each) { return each.scan_of_lidar % every_ != 0; }),
            frames_.end());
        bytes_ = 0;
        for (const Frame& each : frames_) bytes_ += each.json.size();
    }
}

void ViewOutput::finish(const Conversion& conversion, const ConversionReport& report) {
    const std::vector<ScanReport>& scans = report.scan_reports;
    const std::vector<double> times_s = timesOf(scans);
    Json frame_times = Json::array(), notes = Json::array();
    std::vector<std::string> frames;
    for (Frame& frame : frames_) {
        frame_times.push_back(rounded(times_s.at(frame.scan)));
        frames.push_back(std::move(frame.json));
    }
    for (const auto& [label, sensor] : report.sensors) {
        notes.push_back((label.empty() ? "" : label + ": ") + sensor);
    }
    if (every_ > 1) {
        notes.push_back("1 of " + std::to_string(every_) +
                        " scans is shown; the statistics cover all " +
                        std::to_string(scans.size()) + " scans");
    }
    if (report.scans_without_ground * 2 > report.scans) {
        notes.push_back(
            {{"text", "No ground in most scans: everything near is RoI."}, {"is_alarm", true}});
    }
    const Json data = {
        {"format", "hagen-view-1"},
        {"heading", base::lastNameOf(conversion.input)},
        {"notes", notes},
        {"zone_m", report.settings.options.zone_m},
        {"frame_times_s", frame_times},
        {"charts",
         {chart("nearest obstacle [m]", times_s, scans,
                [](const ScanReport& scan) { return scan.nearest_roi_m; }),
          chart("obstacles", times_s, scans, [](const ScanReport& scan) { return scan.obstacles; }),
          chart("time per scan [ms]", times_s, scans,
                [](const ScanReport& scan) { return scan.latency_ms; })}}};
    std::ofstream out = base::openToWrite(path_.temporary(), path_.path());
    base::writeViewPage(out, data, frames);
    base::closeWritten(out, path_.path());
}

}  // namespace hagen::convert
