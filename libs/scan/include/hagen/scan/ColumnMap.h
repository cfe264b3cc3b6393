#pragma once
#include <hagen/scan/PixelDirections.h>
#include <hagen/scan/RangeImage.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// Maps the columns of a turn to a smaller image: full resolution within a window, wider columns
/// elsewhere.
struct ColumnMap {
    std::vector<std::int32_t> to_image;  ///< image column of each column of the turn
    std::vector<std::int32_t> to_turn;   ///< turn column of each column of the image

    std::vector<std::int32_t> even;  ///< evenly spaced image columns, one per group

    int columns() const { return static_cast<int>(to_image.size()); }  ///< of the whole turn
};

/// Divides the columns of a turn into groups of `group`, clockwise from column 0; the last group
/// may be smaller. The `count` groups from `first` on (wrapped) keep their columns; each other
/// group becomes one image column in the direction of its first column. The image always has groups
/// + (group - 1) count columns; unused columns are empty and opposite to the window. Reuses the
/// memory of `map`. Throws std::invalid_argument if the window does not fit into the turn, or if
/// group < 1.
void mapColumns(int columns, int group, int first, int count, ColumnMap& map);

/// Like projectScan(), but into the columns of the map.
void projectScan(const Scan& scan, const SensorModel& sensor, const ColumnMap& map, float context_m,
                 RangeImage& image, ProjectionWorkspace& work);

/// Selects the directions of the image's columns from those of the turn. Reuses memory.
void mapDirections(const PixelDirections& turn, const ColumnMap& map, PixelDirections& image);

}  // namespace hagen
