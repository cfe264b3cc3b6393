#include "filter/paper/Labelling.h"
#include <hagen/scan/Angle.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>
#include "filter/paper/SeedGate.h"

#include "filter/FindColumnBits.h"

namespace hagen {
namespace {

constexpr float kNoGate_rad = static_cast<float>(radians(90));

void setPixel(int column, int row, int rows, ColumnBits& bits) {
    bits[column * wordsOf(rows) + row / kWordRows] |= std::uint64_t{1} << row % kWordRows;
}

/// The lowest pixel of each column, if it has an angle.
void lowestPixels(const ColumnBits& present, const ColumnBits& has_angle, int words,
                  ColumnBits& lowest) {
    lowest.resize(present.size());
    for (std::size_t first = 0; first < present.size(); first += words) {
        bool is_below = false;
        for (std::size_t word = first; word < first + words; ++word) {
            const std::uint64_t one = present[word] & (0 - present[word]);
            lowest[word] = is_below ? 0 : one & has_angle[word];
            is_below |= present[word] != 0;
        }
    }
}

/// Keeps the lowest pixels that may be ground.
void gateLowest(const Image<float>& depth_m, const Image<float>& angle_rad, float gate_rad,
                std::vector<int>& seeds, ColumnBits& lowest) {
    const int rows = static_cast<int>(depth_m.rows()), words = wordsOf(rows);
    seeds.clear();
    for (int word = 0; word < static_cast<int>(lowest.size()); ++word) {
        const int first = word / words * rows + word % words * kWordRows;
        forEachBit(lowest[word], [&](int bit) { seeds.push_back(first + bit); });
        lowest[word] = 0;
    }
    gateSeeds(depth_m, angle_rad, gate_rad, seeds);
    for (const int seed : seeds) setPixel(seed / rows, seed % rows, rows, lowest);
}

/// The highest and the nearest pixel with an angle in each column.
void topAndNearestPixels(const Image<float>& depth_m, const Image<float>& angle_rad,
                         ColumnBits& seeds) {
    const int rows = static_cast<int>(angle_rad.rows());
    std::fill(seeds.begin(), seeds.end(), 0);
    for (int column = 0; column < static_cast<int>(angle_rad.cols()); ++column) {
        int highest = -1, nearest = -1;
        for (int row = 0; row < rows; ++row) {
            if (!hasValue(angle_rad(row, column)) || !hasValue(depth_m(row, column))) continue;
            highest = row;
            if (nearest < 0 || depth_m(row, column) < depth_m(nearest, column)) nearest = row;
        }
        if (highest < 0) continue;
        setPixel(column, highest, rows, seeds);
        setPixel(column, nearest, rows, seeds);
    }
}

/// Spreads the reached pixels of a column up and down along its links.
template <class Words>
void spreadInColumn(Words words, const std::uint64_t* above, std::uint64_t* reached) {
    // Upwards, the carry of an addition propagates along consecutive links.
    std::uint64_t from_below = 0;
    for (int word = 0; word < words; ++word) {
        const std::uint64_t links = above[word], from = reached[word];
        const std::uint64_t leaving = links + (from & links), sum = leaving + from_below;
        reached[word] = from | (sum ^ links);
        from_below = leaving < links || sum < leaving;
    }
    // Downwards, there is no carry, so the step length is doubled instead.
    std::uint64_t from_above = 0;
    for (int word = words - 1; word >= 0; --word) {
        std::uint64_t links = above[word], down = reached[word];
        const std::uint64_t next = links & (down >> 1 | from_above) & ~down;
        if (next != 0) {  // rare, because ground seeds are the lowest pixels of columns
            down |= next;
            for (int way = 1; way < kWordRows; way *= 2) {
                down |= links & down >> way;
                links &= links >> way;
            }
            reached[word] = down;
        }
        from_above = down << (kWordRows - 1);
    }
}

/// Grows the regions from the pixels reached so far. The order does not change the result, so whole
/// columns spread to their neighbours; a column that gains pixels is queued to spread itself.
template <class Words>
void growRegions(Words words, int columns, const ColumnLinks& links, LabellingWorkspace* w) {
    w->waiting.resize(static_cast<std::size_t>(columns) + 1);  // plus a scratch entry
    w->is_waiting.assign(static_cast<std::size_t>(columns), false);
    int* const waiting = w->waiting.data();
    int* const is_waiting = w->is_waiting.data();
    std::uint64_t* const reached = w->reached.data();
    const std::uint64_t *const above = links.above.data(), *const right = links.right.data();
    int count = 0;
    const auto spread = [&](int column) {
        spreadInColumn(words, above + column * words, reached + column * words);
    };
    const auto give = [&](int from, int to, const std::uint64_t* link) {
        std::uint64_t more = 0;
        for (int word = 0; word < words; ++word) {
            const std::uint64_t given = reached[from * words + word] & link[word];
            more |= given & ~reached[to * words + word];
            reached[to * words + word] |= given;
        }
        waiting[count] = to;
        count += more != 0 && is_waiting[to] == 0;
        is_waiting[to] |= more != 0;
    };
    for (int column = 0; column < columns; ++column) spread(column);
    for (int column = 0; column < columns; ++column) {  // most have already spread
        const int on_right = column + 1 < columns ? column + 1 : 0;
        std::uint64_t differ = 0;
        for (int word = 0; word < words; ++word) {
            const int n = column * words + word;
            differ |= (reached[n] ^ reached[on_right * words + word]) & right[n];
        }
        if (differ == 0) continue;
        give(column, on_right, right + column * words);
        give(on_right, column, right + column * words);
    }
    while (count > 0) {
        const int column = waiting[--count];
        is_waiting[column] = false;
        spread(column);
        const int on_left = column > 0 ? column - 1 : columns - 1;
        const int on_right = column + 1 < columns ? column + 1 : 0;
        give(column, on_left, right + on_left * words);
        give(column, on_right, right + column * words);
    }
}

/// The eight bits of each byte value, as bytes 0 or 1.
using Bytes = std::array<std::uint8_t, 8>;
constexpr std::array<Bytes, 256> makeBytesOfBits() {
    std::array<Bytes, 256> table{};
    for (unsigned bits = 0; bits < table.size(); ++bits) {
        for (unsigned n = 0; n < 8; ++n) {
            table[bits][n] = static_cast<std::uint8_t>(bits >> n & 1);
        }
    }
    return table;
}
constexpr std::array<Bytes, 256> kBytesOfBits = makeBytesOfBits();

/// Writes the labels of a word of pixels, eight at a time.
void writeLabels(std::uint64_t present, std::uint64_t rou, int pixels, Label* labels) {
    static_assert(static_cast<int>(Label::Unclassified) == 0 && static_cast<int>(Label::Rou) == 1 &&
                  static_cast<int>(Label::Roi) == 2);
    const std::uint64_t roi = present & ~rou;
    for (int n = 0; n < pixels; n += 8) {
        std::uint64_t ones, twos;
        std::memcpy(&ones, kBytesOfBits[rou >> n & 255].data(), sizeof ones);
        std::memcpy(&twos, kBytesOfBits[roi >> n & 255].data(), sizeof twos);
        const std::uint64_t eight = ones + 2 * twos;
        if (n + 8 <= pixels) {
            std::memcpy(labels + n, &eight, 8);
        } else {
            std::memcpy(labels + n, &eight, static_cast<std::size_t>(pixels - n));
        }
    }
}

/// ROU pixels are reached from the ground, or not reached from the RoI. Pixels without an angle are
/// RoI.
void writeLabels(const LabellingWorkspace& w, bool from_ground, Image<Label>* labels) {
    const int rows = static_cast<int>(labels->rows()), columns = static_cast<int>(labels->cols());
    const std::uint64_t turned = from_ground ? 0 : ~std::uint64_t{0};
    std::size_t word = 0;
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < rows; row += kWordRows, ++word) {
            const std::uint64_t is_there = w.present[word];
            const std::uint64_t rou =
                is_there & w.angles.present[word] & (w.reached[word] ^ turned);
            writeLabels(is_there, rou, std::min(rows - row, kWordRows),
                        labels->data() + column * rows + row);
        }
    }
}

}  // namespace

// Fast because it finds links for many pixels at once and grows regions by whole columns.
void labelRegions(const Image<float>& depth_m, const Image<float>& pixel_angle_rad, float beta_rad,
                  Seeds seeds, float seed_gate_rad, Image<Label>& labels, LabellingWorkspace& w) {
    const int rows = static_cast<int>(depth_m.rows()), columns = static_cast<int>(depth_m.cols());
    const bool from_ground = seeds != Seeds::TopAndNearest;
    findPresent(depth_m, w.present, w.seam);
    findLinks(pixel_angle_rad, beta_rad, w.angles, w.seam);
    w.reached.resize(w.present.size());
    if (seeds == Seeds::Every) {
        w.reached = w.angles.present;
    } else if (seeds == Seeds::Lowest) {
        lowestPixels(w.present, w.angles.present, wordsOf(rows), w.reached);
        if (seed_gate_rad < kNoGate_rad)
            gateLowest(depth_m, pixel_angle_rad, seed_gate_rad, w.seeds, w.reached);
    } else {
        topAndNearestPixels(depth_m, pixel_angle_rad, w.reached);
    }
    if (seeds != Seeds::Every)
        withWordsOf(rows, [&](auto words) { growRegions(words, columns, w.angles, &w); });
    labels.resize(rows, columns);
    writeLabels(w, from_ground, &labels);
}

void limitToZone(const Image<float>& depth_m, float zone_m, Image<Label>& labels) {
    const float* const depth = depth_m.data();
    Label* const label = labels.data();
    for (Eigen::Index pixel = 0; pixel < depth_m.size(); ++pixel) {
        label[pixel] = depth[pixel] > zone_m ? Label::Rou : label[pixel];
    }
}

}  // namespace hagen
