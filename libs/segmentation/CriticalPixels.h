#pragma once
#include <hagen/range_image/Image.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen {

/// An image of levels with a frame of zeros around it, as one array: above each column a pixel that
/// is also below the next one, and on both sides the column from the other end of the turn. So a
/// neighbour lies at the same distance from every pixel, and nothing need ask where the image ends.
struct FramedLevels {
    int rows = 0, columns = 0;
    std::vector<float> level;  ///< 0 or above, 0 where a pixel is empty

    int stride() const { return rows + 1; }
    int indexOf(int row, int column) const { return 1 + (column + 1) * stride() + row; }
    int rowOf(int index) const { return (index - 1) % stride(); }
    int columnOf(int index) const { return (index - 1) / stride() - 1; }
};

/// Empty pixels, and those below 0, become 0.
void frame(const Image<float>& image, FramedLevels& framed);

/// The 8 neighbours around a pixel, counter-clockwise; those at even places share an edge with it.
constexpr int kNeighbours = 8;
std::array<int, kNeighbours> neighbourOffsets(int stride);

/// The pixels at which components of {pixel >= level} are born or may meet as the level sinks, and
/// from every pixel above 0 a way up. Pixels are indices into the framed levels.
struct CriticalPixels {
    /// Of each pixel its oldest neighbour or another that is older, itself where it is a maximum;
    /// of a pixel of the frame the one that it repeats.
    std::vector<std::int32_t> ascent;
    /// Of each pixel the set of older neighbours, bit n for the n-th.
    std::vector<std::int32_t> older_neighbours;
    std::size_t maxima = 0, saddles = 0;  ///< how many; the lists are longer
    std::vector<std::int32_t> maximum;    ///< without an older neighbour, in ascending order
    /// With older neighbours that are not side by side around it, in ascending order. Any other
    /// pixel joins a single component, or none.
    std::vector<std::int32_t> saddle;
};

/// Older is what is higher; of two pixels equally high the one with the smaller index in the image.
void findCriticalPixels(const FramedLevels& framed, CriticalPixels& critical);

}  // namespace hagen
