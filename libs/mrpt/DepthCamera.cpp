#include "mrpt/DepthCamera.h"
#include <hagen/mrpt/MrptMessage.h>
#include <hagen/scan/MostReturns.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace hagen::observations {
namespace {

using mrpt::img::DistortionModel;
using mrpt::img::TCamera;
using mrpt::obs::CObservation3DRangeScan;

/// A point in the image plane at a depth of 1.
struct ImagePoint {
    double right, down;
};

/// The distorted point, by the OpenCV model that MRPT calls "plumb bob".
ImagePoint distorted(const TCamera& camera, const ImagePoint& at) {
    const auto& k = camera.dist;  // in the order k1 k2 p1 p2 k3 k4 k5 k6
    const double x = at.right, y = at.down, r2 = x * x + y * y;
    const double radial =
        (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / (1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
    return {x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x),
            y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y};
}

/// The inverse of distorted(), by fixed-point iteration as in OpenCV.
ImagePoint undistorted(const TCamera& camera, const ImagePoint& seen) {
    if (camera.distortion == DistortionModel::none) return seen;
    constexpr int kMaxSteps = 20;
    constexpr double kTolerance = 1e-7;
    ImagePoint at = seen;
    for (int step = 0; step < kMaxSteps; ++step) {
        const ImagePoint there = distorted(camera, at);
        const double right = seen.right - there.right, down = seen.down - there.down;
        at = {at.right + right, at.down + down};
        if (std::abs(right) + std::abs(down) < kTolerance) break;
    }
    return at;
}

void checkCamera(const TCamera& camera) {
    const auto isValid = [](double pixels) { return pixels > 0 && std::isfinite(pixels); };
    if (!isValid(camera.fx()) || !isValid(camera.fy()) || !std::isfinite(camera.cx()) ||
        !std::isfinite(camera.cy())) {
        throw std::runtime_error("invalid focal length or principal point of the camera");
    }
    const bool is_finite = std::all_of(camera.dist.begin(), camera.dist.end(),
                                       [](double term) { return std::isfinite(term); });
    if (camera.distortion == DistortionModel::none) return;
    if (camera.distortion != DistortionModel::plumb_bob || !is_finite) {
        throw std::runtime_error(
            "unsupported lens distortion of the camera (supported: none, plumb_bob); store the "
            "points in the log");
    }
}

void add(float x_m, float y_m, float z_m, Scan& scan) {
    if (!std::isfinite(x_m) || !std::isfinite(y_m) || !std::isfinite(z_m)) return;
    if (x_m == 0 && y_m == 0 && z_m == 0) return;
    scan.x_m.push_back(x_m);
    scan.y_m.push_back(y_m);
    scan.z_m.push_back(z_m);
}

void readRanges(const CObservation3DRangeScan& observation, Scan& scan) {
    const auto& ranges = observation.rangeImage;
    for (const auto& [name, layer] : observation.rangeImageOtherLayers) {
        if (layer.rows() == ranges.rows() && layer.cols() == ranges.cols()) continue;
        throw std::runtime_error("layer '" + name + "' and the range image differ in size");
    }
    const TCamera& camera = observation.cameraParams;
    checkCamera(camera);
    const auto unit_m = static_cast<double>(observation.rangeUnits);
    if (!(unit_m > 0) || !std::isfinite(unit_m)) {
        throw std::runtime_error("invalid range unit: " + std::to_string(unit_m) + " m");
    }
    for (int r = 0; r < ranges.rows(); ++r) {
        for (int c = 0; c < ranges.cols(); ++c) {
            const ImagePoint at = undistorted(
                camera, {(c - camera.cx()) / camera.fx(), (r - camera.cy()) / camera.fy()});
            const double per_depth = observation.range_is_depth
                                         ? 1.0
                                         : std::sqrt(1 + at.right * at.right + at.down * at.down);
            const auto addRange = [&](std::uint16_t range) {
                if (range == 0) return;
                const double depth_m = range * unit_m / per_depth;
                add(static_cast<float>(depth_m), static_cast<float>(-at.right * depth_m),
                    static_cast<float>(-at.down * depth_m), scan);
            };
            addRange(ranges(r, c));
            for (const auto& [name, layer] : observation.rangeImageOtherLayers) {
                addRange(layer(r, c));
            }
        }
    }
}

void load(const CObservation3DRangeScan& observation) {
    try {
        observation.load();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        std::string files;
        if (observation.points3D_isExternallyStored()) {
            files += " " + observation.points3D_getExternalStorageFileAbsolutePath();
        }
        if (observation.rangeImage_isExternallyStored()) {
            files += " " + observation.rangeImage_getExternalStorageFileAbsolutePath("");
        }
        throw std::runtime_error("cannot read data from" + files + ": " + messageOf(e));
    }
}

}  // namespace

const CObservation3DRangeScan* depthScanOf(const mrpt::obs::CObservation& observation) {
    const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation);
    return scan == nullptr || !(scan->hasPoints3D || scan->hasRangeImage) ? nullptr : scan;
}

void readDepthScan(const CObservation3DRangeScan& observation, Scan& scan) {
    scan.clear();
    load(observation);
    checkReturns(std::max(observation.points3D_x.size(),
                          static_cast<std::size_t>(observation.rangeImage.size()) *
                              (1 + observation.rangeImageOtherLayers.size())));
    if (observation.hasPoints3D && !observation.points3D_x.empty()) {
        const auto &x = observation.points3D_x, &y = observation.points3D_y,
                   &z = observation.points3D_z;
        if (y.size() != x.size() || z.size() != x.size()) {
            throw std::runtime_error("the point arrays differ in size");
        }
        for (std::size_t i = 0; i < x.size(); ++i) add(x[i], y[i], z[i], scan);
    } else {
        readRanges(observation, scan);
    }
    scan.intensity.assign(scan.size(), 0.0f);
}

}  // namespace hagen::observations
