#pragma once
#include <hagen/scan/Image.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen {

/// An image of levels with a frame around it, as one array. The frame has a zero between columns
/// and, on both sides, a copy of the column at the opposite edge. Neighbours are thus at constant
/// offsets, and loops need no border checks.
struct FramedLevels {
    int rows = 0, columns = 0;
    std::vector<float> level;  ///< >= 0; 0 for empty pixels

    int stride() const { return rows + 1; }
    int indexOf(int row, int column) const { return 1 + (column + 1) * stride() + row; }
    int rowOf(int index) const { return (index - 1) % stride(); }
    int columnOf(int index) const { return (index - 1) / stride() - 1; }
};

/// Sets empty and negative pixels to 0.
void frameLevels(const Image<float>& image, FramedLevels& framed);

/// The offsets of a pixel's 8 neighbours, in circular order; even neighbours share an edge with the
/// pixel.
constexpr int kNeighbours = 8;
std::array<int, kNeighbours> neighbourOffsets(int stride);

/// The pixels at which components of {pixel >= level} are born or may meet as the level decreases,
/// and a path from every pixel above 0 to a maximum. Pixels are indices into the framed levels.
struct CriticalPixels {
    /// For each pixel, an older neighbour, or itself if it is a maximum; for a frame pixel, the
    /// pixel it copies.
    std::vector<std::int32_t> ascent;
    /// For each pixel, the bit set of its older neighbours.
    std::vector<std::int32_t> older_neighbours;
    std::size_t maxima = 0, saddles = 0;  ///< counts; the lists may have unused entries
    std::vector<std::int32_t> maximum;    ///< pixels without an older neighbour, ascending
    /// Pixels whose older neighbours are not all adjacent to each other, ascending. Other pixels
    /// join at most one component.
    std::vector<std::int32_t> saddle;
};

/// The higher pixel is older; ties go to the smaller index in the image.
void findCriticalPixels(const FramedLevels& framed, CriticalPixels& critical);

}  // namespace hagen
