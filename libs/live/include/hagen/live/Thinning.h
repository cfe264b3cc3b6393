#pragma once
#include <hagen/scan/Scan.h>
#include <cstddef>
#include <vector>

namespace hagen::live {

/// Selects the context returns of a packet far from a sector: the nearest return of each pixel in
/// every n-th column, or the lowest return of its row up to the next of these columns if clearly
/// lower. Ground visible in gaps between obstacles shows their height.
class Thinning {
 public:
    /// `rows` of the sensor and `columns` of the image. `every` is n; 0 selects nothing.
    Thinning(int rows, int columns, int every);

    /// Indices into the packet's returns; valid until the next call. `up` is the sign of the upward
    /// direction along the sensor's z axis; if 0 (sensor on its side), heights are not compared.
    const std::vector<std::size_t>& of(const Scan& packet, float up = 1);

 private:
    struct Kept {
        std::size_t pixel;
        float below_m;  ///< lower returns replace the kept return
    };

    int rows_, columns_, every_;
    std::vector<std::size_t> kept_;
    std::vector<std::size_t> pixel_;     ///< column group and row of each return
    std::vector<Kept> kept_pixels_;      ///< one per kept return
    std::vector<std::size_t> at_pixel_;  ///< index into `kept_pixels_`; kNone between calls
};

}  // namespace hagen::live
