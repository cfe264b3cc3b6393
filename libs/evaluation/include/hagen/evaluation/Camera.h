#pragma once
#include <hagen/scan/Scan.h>
#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace hagen::evaluation {

/// A pinhole camera without distortion, mounted next to the LiDAR.
struct PinholeCamera {
    int width_px = 0, height_px = 0;
    double fx_px = 0, fy_px = 0;  ///< focal lengths
    double cx_px = 0, cy_px = 0;  ///< principal point; (0, 0) is the centre of the top left pixel
    /// Pose of the camera body (x forward along the optical axis, y left, z up) in the sensor's
    /// frame.
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

/// Reads a camera file, such as config/camera_forward.yaml. Every key is required. Throws
/// std::runtime_error; the message names file and key.
PinholeCamera readCamera(const std::filesystem::path& file);

/// A pixel and the return visible in it.
struct CameraPixel {
    int u = 0, v = 0;  ///< column from the left, row from the top
    std::size_t index = 0;
};

/// Returns the pixels with a visible return: if several returns project to a pixel, the one nearest
/// to the camera. Sorted by row and column. Ignores returns without a range.
std::vector<CameraPixel> visibleReturns(const PinholeCamera& camera, const Scan& scan);

}  // namespace hagen::evaluation
