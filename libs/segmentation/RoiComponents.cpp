#include <hagen/segmentation/RoiComponents.h>
#include <algorithm>
#include <cmath>
#include <vector>

namespace hagen {

void numberRoiComponents(const Image<float>& depth_m, const Image<Label>& labels, float max_gap_m,
                         Image<std::int32_t>& components) {
    const int rows = static_cast<int>(depth_m.rows());
    const int columns = static_cast<int>(depth_m.cols());
    components.setZero(rows, columns);

    std::vector<int> nearest_first;
    for (int pixel = 0; pixel < rows * columns; ++pixel) {
        if (labels.data()[pixel] == Label::Roi) nearest_first.push_back(pixel);
    }
    std::sort(nearest_first.begin(), nearest_first.end(), [&](int a, int b) {
        const float depth_a = depth_m.data()[a], depth_b = depth_m.data()[b];
        return depth_a < depth_b || (depth_a == depth_b && a < b);
    });

    // The closest pixel that has no number yet is the closest one of the next component.
    std::int32_t number = 0;
    std::vector<int> queue;
    for (const int closest : nearest_first) {
        if (components.data()[closest] != 0) continue;
        components.data()[closest] = ++number;
        queue.assign(1, closest);
        for (std::size_t next = 0; next < queue.size(); ++next) {
            const int row = queue[next] % rows, column = queue[next] / rows;
            forEachOf4Neighbours(row, column, rows, columns, [&](int to_row, int to_column) {
                if (labels(to_row, to_column) != Label::Roi) return;
                if (components(to_row, to_column) != 0) return;
                const float gap_m = std::abs(depth_m(to_row, to_column) - depth_m(row, column));
                if (!(gap_m < max_gap_m)) return;
                components(to_row, to_column) = number;
                queue.push_back(to_column * rows + to_row);
            });
        }
    }
}

}  // namespace hagen
