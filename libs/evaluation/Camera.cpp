#include <hagen/evaluation/Camera.h>
#include <hagen/scan/Angle.h>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "evaluation/YamlFile.h"

namespace hagen::evaluation {
namespace {

double numberOf(const YAML::Node& node, const std::string& key) {
    double value = 0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
        throw std::invalid_argument(key + " must be a number" +
                                    (node.IsScalar() ? ", not '" + node.Scalar() + "'" : ""));
    }
    return value;
}

constexpr int kMaxPixelsPerSide = 20000;  // larger values are typing errors
constexpr double kMaxTotalPixels = 50e6;

void checkImageSize(double value, const std::string& key) {
    if (value >= 1 && value <= kMaxPixelsPerSide && value == std::floor(value)) return;
    throw std::invalid_argument(key + " must be a whole number of pixels from 1 to " +
                                std::to_string(kMaxPixelsPerSide));
}

}  // namespace

PinholeCamera readCamera(const std::filesystem::path& file) {
    std::map<std::string, double> values{{"width", NAN},   {"height", NAN},    {"fx", NAN},
                                         {"fy", NAN},      {"cx", NAN},        {"cy", NAN},
                                         {"yaw_deg", NAN}, {"pitch_deg", NAN}, {"roll_deg", NAN}};
    Eigen::Vector3d position_m = Eigen::Vector3d::Constant(NAN);
    forEachYamlEntry(file, "width: 640", [&](const std::string& key, const YAML::Node& node) {
        if (key == "position_m") {
            if (!node.IsSequence() || node.size() != 3) {
                throw std::invalid_argument("position_m must be [x, y, z]");
            }
            for (int i = 0; i < 3; ++i) position_m(i) = numberOf(node[i], "each of position_m");
            return;
        }
        const auto value = values.find(key);
        if (value == values.end()) throw std::invalid_argument("unknown key '" + key + "'");
        value->second = numberOf(node, key);
        if (key == "width" || key == "height") checkImageSize(value->second, key);
        if ((key == "fx" || key == "fy") && !(value->second > 0)) {
            throw std::invalid_argument(key + " must be above 0");
        }
    });
    for (const auto& [key, value] : values) {
        if (std::isnan(value))
            throw std::runtime_error(file.string() + ": has no key '" + key + "'");
    }
    if (position_m.hasNaN()) throw std::runtime_error(file.string() + ": has no key 'position_m'");

    PinholeCamera camera;
    camera.width_px = static_cast<int>(values["width"]);
    camera.height_px = static_cast<int>(values["height"]);
    if (static_cast<double>(camera.width_px) * camera.height_px > kMaxTotalPixels) {
        throw std::runtime_error(file.string() + ": has more than 50 million pixels");
    }
    camera.fx_px = values["fx"];
    camera.fy_px = values["fy"];
    camera.cx_px = values["cx"];
    camera.cy_px = values["cy"];
    using Eigen::AngleAxisd, Eigen::Vector3d;
    camera.pose.linear() = (AngleAxisd(radians(values["yaw_deg"]), Vector3d::UnitZ()) *
                            AngleAxisd(radians(values["pitch_deg"]), Vector3d::UnitY()) *
                            AngleAxisd(radians(values["roll_deg"]), Vector3d::UnitX()))
                               .toRotationMatrix();
    camera.pose.translation() = position_m;
    return camera;
}

std::vector<CameraPixel> visibleReturns(const PinholeCamera& camera, const Scan& scan) {
    const Eigen::Isometry3d to_camera = camera.pose.inverse();
    constexpr auto kFar = std::numeric_limits<double>::infinity();
    std::vector<double> nearest_m(
        static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px),
        kFar);
    std::vector<std::size_t> index(nearest_m.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (std::isnan(scan.range_m[i])) continue;
        const Eigen::Vector3d body =
            to_camera * Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]).cast<double>();
        if (!(body.x() > 0)) continue;  // behind the camera
        // In the body frame, right is -y and down is -z.
        const double u = std::floor(camera.cx_px - camera.fx_px * body.y() / body.x() + 0.5);
        const double v = std::floor(camera.cy_px - camera.fy_px * body.z() / body.x() + 0.5);
        if (!(u >= 0 && u < camera.width_px && v >= 0 && v < camera.height_px)) continue;
        const std::size_t pixel =
            static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width_px) +
            static_cast<std::size_t>(u);
        const double distance_m = body.norm();
        if (distance_m >= nearest_m[pixel]) continue;
        nearest_m[pixel] = distance_m;
        index[pixel] = i;
    }
    std::vector<CameraPixel> pixels;
    for (std::size_t p = 0; p < nearest_m.size(); ++p) {
        if (nearest_m[p] == kFar) continue;
        const auto width = static_cast<std::size_t>(camera.width_px);
        pixels.push_back({static_cast<int>(p % width), static_cast<int>(p / width), index[p]});
    }
    return pixels;
}

}  // namespace hagen::evaluation
