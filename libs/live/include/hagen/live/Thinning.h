#pragma once
#include <hagen/scan/Scan.h>
#include <cstddef>
#include <vector>

namespace hagen::live {

/// Which of a packet's returns are context far from a sector: the closest one of each pixel, in
/// each n-th column. It gives way to the lowest return of its row up to the next such column, if
/// that is clearly lower: the ground in gaps between obstacles shows how high these are.
class Thinning {
 public:
    /// Of a sensor with so many rows, and images with so many columns. `every`: n; 0: none.
    Thinning(int rows, int columns, int every);

    /// Indices into the packet's returns; valid until the next call. `up`: 1, or -1 for a sensor
    /// that is upside down: along its z axis. 0, for one on its side: nothing is taken for lower.
    const std::vector<std::size_t>& of(const Scan& packet, float up = 1);

 private:
    struct Kept {
        std::size_t pixel;
        float below_m;  ///< what is lower takes its place
    };

    int rows_, columns_, every_;
    std::vector<std::size_t> kept_;
    std::vector<std::size_t> pixel_;     ///< of each return: its group of columns, and row
    std::vector<Kept> kept_pixels_;      ///< one per kept return
    std::vector<std::size_t> at_pixel_;  ///< its place among these; between two calls: none
};

}  // namespace hagen::live
