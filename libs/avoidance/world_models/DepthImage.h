#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen::avoidance {

/// The nearest and the farthest return of a scan in each pixel of an image around the sensor, and
/// in a pyramid of coarser images, each half the size of the previous one.
///
/// A pixel is about half a degree: 512 columns, 256 rows. Its coordinates grow with azimuth and
/// elevation but need no inverse trigonometric functions.
class DepthImage {
 public:
    /// A position in the image in pixels: column in [0, 512), row in [0, 256).
    struct Place {
        float column, row;
    };
    struct Depths {
        float nearest_m, farthest_m;  ///< 0: no return
    };
    static constexpr float kPixelsPerUnit = 128;  ///< a unit is about one radian ahead

    DepthImage();

    static Place placeOf(const Eigen::Vector3f& ray);
    void project(const std::vector<Eigen::Vector3f>& points_m, const Eigen::Vector3f& origin_m);

    /// Depths within a rectangle of pixels around a place. It is enlarged to whole pixels of the
    /// finest image in which half of it spans at most `max_half` rows and 16 times as many columns
    /// (columns are narrow near the poles).
    Depths depthsAround(const Place& place, float half_columns, float half_rows,
                        float max_half) const;

    /// 4 x 4 x 4 places, processed at once in the order of a block of RollingBox, and the rectangle
    /// of pixels around each place in the image of one level.
    using Values = Eigen::Array<float, 64, 1>;
    using Pixels = Eigen::Array<int, 64, 1>;
    struct Block {
        Values away_m;
        Pixels left, right, low, high;
        int level;
    };
    static Block block(const Eigen::Vector3f& to_first_m, float step_m, float half_columns,
                       float half_rows, float max_half);
    Depths depths(const Block& block, unsigned place) const {
        return depthsIn(block.level, block.left[place], block.right[place], block.low[place],
                        block.high[place]);
    }

    std::size_t bytes() const;

 private:
    static constexpr int kColumns = 512, kRows = 256, kLevels = 9;
    struct Pixel {
        std::uint16_t nearest_mm, farthest_mm;
    };
    static int levelFor(float half_columns, float half_rows, float max_half);
    Depths depthsIn(int level, int left, int right, int low, int high) const;
    std::size_t indexOf(int level, int column, int row) const {
        return first_[level] + static_cast<std::size_t>((row << (9 - level)) + column);
    }

    std::size_t first_[kLevels];  ///< index of each level's first pixel
    std::vector<Pixel> pixels_;
};

}  // namespace hagen::avoidance
