#include <hagen/filter/CellTops.h>

namespace hagen {

void raiseHighest(const PixelCells& cells, const Image<float>& known_m, CellTops& tops) {
    float* const highest_m = tops.highest_m.data();
    for (Eigen::Index pixel = 0; pixel < known_m.size(); ++pixel) {
        float& own_m = highest_m[cells.cell.data()[pixel]];
        own_m = known_m.data()[pixel] > own_m ? known_m.data()[pixel] : own_m;  // ignores NaN
    }
}

float highestOf(const CellTops& tops, int cell) {
    const int row = cell % CellArea::kSide, column = cell / CellArea::kSide;
    const CellArea& area = tops.area;
    const bool is_computed = row >= area.first_row && row < area.end_row &&
                             column >= area.first_column && column < area.end_column;
    return is_computed ? tops.two_m[2 * static_cast<std::size_t>(cell)] : kNoValue;
}

}  // namespace hagen
