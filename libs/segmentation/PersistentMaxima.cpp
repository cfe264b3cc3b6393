#include <hagen/segmentation/PersistentMaxima.h>
#include <algorithm>

namespace hagen {
namespace {

constexpr int kAbsent = -1;

/// Components of the pixels that the sinking level has reached. Each is named by its root, the
/// pixel at which it was born.
class Components {
 public:
    explicit Components(int pixels) : parent_(pixels, kAbsent) {}

    bool contains(int pixel) const { return parent_[pixel] != kAbsent; }
    void add(int pixel) { parent_[pixel] = pixel; }
    void join(int younger_root, int elder_root) { parent_[younger_root] = elder_root; }

    int root(int pixel) {
        while (parent_[pixel] != pixel) {
            parent_[pixel] = parent_[parent_[pixel]];
            pixel = parent_[pixel];
        }
        return pixel;
    }

 private:
    std::vector<int> parent_;
};

}  // namespace

void proximityOf(const Image<float>& depth_m, float zone_m, Image<float>& proximity_m) {
    proximity_m = (depth_m < zone_m).select(zone_m - depth_m, depth_m * 0.0f);  // NaN * 0 is NaN
}

void findPersistentMaxima(const Image<float>& proximity_m, float min_persistence_m,
                          std::vector<Maximum>& maxima) {
    const int rows = static_cast<int>(proximity_m.rows());
    const int columns = static_cast<int>(proximity_m.cols());
    const auto level = [&](int pixel) { return proximity_m.data()[pixel]; };
    const auto isOlder = [&](int a, int b) {
        return level(a) > level(b) || (level(a) == level(b) && a < b);
    };

    std::vector<int> oldest_first;
    for (int pixel = 0; pixel < rows * columns; ++pixel) {
        if (level(pixel) > 0.0f) oldest_first.push_back(pixel);
    }
    std::sort(oldest_first.begin(), oldest_first.end(), isOlder);

    Components components(rows * columns);
    std::vector<float> death_m(rows * columns, 0.0f);  // of the component born at a pixel
    for (const int pixel : oldest_first) {
        components.add(pixel);
        const int row = pixel % rows, column = pixel / rows;
        for (int column_step = -1; column_step <= 1; ++column_step) {
            const int neighbour_column = wrapColumn(column + column_step, columns);
            for (int neighbour_row = std::max(row - 1, 0);
                 neighbour_row <= std::min(row + 1, rows - 1); ++neighbour_row) {
                const int neighbour = neighbour_column * rows + neighbour_row;
                if (!components.contains(neighbour)) continue;
                int elder = components.root(neighbour), younger = components.root(pixel);
                if (elder == younger) continue;
                if (isOlder(younger, elder)) std::swap(elder, younger);
                death_m[younger] = level(pixel);
                components.join(younger, elder);
            }
        }
    }

    maxima.clear();
    for (const int pixel : oldest_first) {
        const Maximum maximum{pixel % rows, pixel / rows, level(pixel), death_m[pixel]};
        if (maximum.persistence_m() > 0.0f && maximum.persistence_m() >= min_persistence_m) {
            maxima.push_back(maximum);
        }
    }
}

}  // namespace hagen
