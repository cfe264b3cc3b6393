#pragma once
#include <hagen/range_image/Image.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen {

/// An image of levels with a frame around it, as one array: above each column a zero, which is also
/// below the next one, and on both sides a copy of the column at the other end of the turn. So a
/// neighbour is at the same offset from every pixel, and no loop needs to check for the image's
/// ends.
struct FramedLevels {
    int rows = 0, columns = 0;
    std::vector<float> level;  ///< 0 or above, 0 where a pixel is empty

    int stride() const { return rows + 1; }
    int indexOf(int row, int column) const { return 1 + (column + 1) * stride() + row; }
    int rowOf(int index) const { return (index - 1) % stride(); }
    int columnOf(int index) const { return (index - 1) / stride() - 1; }
};

/// Empty pixels, and those below 0, become 0.
void frameLevels(const Image<float>& image, FramedLevels& framed);

/// The offsets of a pixel's 8 neighbours, going around; the even ones share an edge with it.
constexpr int kNeighbours = 8;
std::array<int, kNeighbours> neighbourOffsets(int stride);

/// The pixels at which components of {pixel >= level} are born or may meet as the level sinks, and
/// from every pixel above 0 a way up to a maximum. Pixels are indices into the framed levels.
struct CriticalPixels {
    /// For each pixel its oldest neighbour or another older one, itself where it is a maximum; for
    /// a pixel of the frame the one that it copies.
    std::vector<std::int32_t> ascent;
    /// For each pixel the set of its older neighbours, bit n for the n-th.
    std::vector<std::int32_t> older_neighbours;
    std::size_t maxima = 0, saddles = 0;  ///< how many; the lists are longer
    std::vector<std::int32_t> maximum;    ///< pixels without an older neighbour, ascending
    /// Pixels whose older neighbours are not all adjacent around it, ascending. Any other pixel
    /// joins a single component, or none.
    std::vector<std::int32_t> saddle;
};

/// The higher pixel is the older; of two equally high, the one with the smaller index in the image.
void findCriticalPixels(const FramedLevels& framed, CriticalPixels& critical);

}  // namespace hagen
