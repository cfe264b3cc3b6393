#pragma once
#include <hagen/scan/PixelDirections.h>
#include <hagen/scan/RangeImage.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// The columns of an image that has those of a whole turn in a window only, and wide ones
/// elsewhere: a smaller image of the whole turn.
struct ColumnMap {
    std::vector<std::int32_t> to_image;  ///< per column of the whole turn: that of the image
    std::vector<std::int32_t> to_turn;   ///< per column of the image: the turn's in its place

    std::vector<std::int32_t> even;  ///< of the image, evenly over the turn: one per group

    int columns() const { return static_cast<int>(to_image.size()); }  ///< of the whole turn
};

/// The columns of a turn in groups of `group`, clockwise from column 0; the last one may be
/// smaller. `count` groups from `first` on (wrapped) keep their columns; each other one is a single
/// column of the image, with the direction of its first. The image has groups + (group - 1) count
/// columns in all, wherever the window is; what is left over is empty, and opposite to the window.
/// Reuses the memory of `map`. Throws std::invalid_argument if the window does not fit into the
/// turn, or group < 1.
void mapColumns(int columns, int group, int first, int count, ColumnMap& map);

/// As projectScan() for the whole turn, into the columns of the map.
void projectScan(const Scan& scan, const SensorModel& sensor, const ColumnMap& map, float context_m,
                 RangeImage& image, ProjectionWorkspace& work);

/// The directions of the image's pixels, of those of the whole turn. Reuses memory.
void mapDirections(const PixelDirections& turn, const ColumnMap& map, PixelDirections& image);

}  // namespace hagen
