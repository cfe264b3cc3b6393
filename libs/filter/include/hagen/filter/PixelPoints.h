#pragma once
#include <hagen/scan/PixelDirections.h>
#include <hagen/scan/RangeImage.h>
#include <hagen/scan/Scan.h>
#include <Eigen/Geometry>

namespace hagen {

/// The positions of a depth image's pixels: one image per coordinate, NaN for empty pixels.
struct PixelPoints {
    Image<float> x_m, y_m, z_m;

    Eigen::Vector3f at(Eigen::Index pixel) const {
        return {x_m.data()[pixel], y_m.data()[pixel], z_m.data()[pixel]};
    }
    void set(Eigen::Index pixel, const Eigen::Vector3f& point_m) {
        x_m.data()[pixel] = point_m.x();
        y_m.data()[pixel] = point_m.y();
        z_m.data()[pixel] = point_m.z();
    }
};

/// Locates the pixels in the sensor frame: at their closest return or, if repaired, at `depth_m`
/// along their beam. Requires `image` of this scan.
void locatePixels(const Scan& scan, const PixelDirections& directions, const RangeImage& image,
                  const Image<float>& depth_m, PixelPoints& pixels);

/// Transforms the pixels to another frame.
void movePixels(const Eigen::Isometry3f& to_from_here, PixelPoints& pixels);

}  // namespace hagen
