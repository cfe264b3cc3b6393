#include <hagen/scan/ColumnMap.h>
#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace hagen {

void mapColumns(int columns, int group, int first, int count, ColumnMap& map) {
    const int groups = group > 0 ? (columns + group - 1) / group : 0;
    if (columns < 1 || group < 1 || first < 0 || first >= groups || count < 0 || count > groups) {
        throw std::invalid_argument("mapColumns: the window does not fit into the turn");
    }
    map.to_image.resize(static_cast<std::size_t>(columns));
    map.to_turn.clear();
    map.even.clear();
    // The image begins opposite to the window, so that unused columns are not beside the window.
    const int opposite = (first + count + (groups - count) / 2) % groups;
    for (int k = opposite; k < opposite + groups; ++k) {
        const int g = k % groups, begin = g * group, end = std::min(begin + group, columns);
        const auto at = static_cast<std::int32_t>(map.to_turn.size());
        const bool is_in_window = (g < first ? g + groups : g) - first < count;
        for (int column = begin; column < end; ++column) {
            map.to_image[column] = at + (is_in_window ? column - begin : 0);
        }
        map.even.push_back(at);
        if (is_in_window) {
            for (int column = begin; column < end; ++column) map.to_turn.push_back(column);
        } else {
            map.to_turn.push_back(begin);
        }
    }
    const int size = groups + (group - 1) * count;
    map.to_turn.resize(static_cast<std::size_t>(size), map.to_turn.back());
}

void mapDirections(const PixelDirections& turn, const ColumnMap& map, PixelDirections& image) {
    image.row_sine = turn.row_sine;
    image.row_cosine = turn.row_cosine;
    image.column_sine.clear();
    image.column_cosine.clear();
    for (const std::int32_t column : map.to_turn) {
        image.column_sine.push_back(turn.column_sine[column]);
        image.column_cosine.push_back(turn.column_cosine[column]);
    }
}

}  // namespace hagen
