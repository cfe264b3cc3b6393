#include "filter/RoiComponents.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "filter/FindColumnBits.h"
#include "filter/RadixSort.h"

namespace hagen {
namespace {

/// Keeps only the links between RoI pixels.
template <class Words>
void keepRoiLinks(Words words, int columns, ComponentsWorkspace* w) {
    std::uint64_t *const roi = w->roi.data(), *const lowest = w->lowest.data();
    std::uint64_t *const above = w->links.above.data(), *const right = w->links.right.data();
    const std::uint64_t* const present = w->links.present.data();
    const int all = columns * words;
    for (int n = 0; n < all; ++n) roi[n] &= present[n];
    for (int column = 0; column < columns; ++column) {
        const int first = column * words;
        std::uint64_t linked_below = 0;
        for (int word = 0; word < words; ++word) {
            const int n = first + word;
            const std::uint64_t next = word + 1 < words ? roi[n + 1] << (kWordRows - 1) : 0;
            above[n] &= roi[n] & (roi[n] >> 1 | next);
            lowest[n] = roi[n] & ~(above[n] << 1 | linked_below);
            linked_below = above[n] >> (kWordRows - 1);
        }
    }
    for (int column = 0; column < columns; ++column) {
        const int first = column * words, first_on_right = column + 1 < columns ? first + words : 0;
        std::uint64_t same_below = 0;
        for (int word = 0; word < words; ++word) {
            const int n = first + word, next = first_on_right + word;
            const std::uint64_t linked = right[n] & roi[n] & roi[next];
            const std::uint64_t same = linked & above[n] & above[next];
            right[n] = linked & ~(same << 1 | same_below);
            same_below = same >> (kWordRows - 1);
        }
    }
}

/// Calls visit(first, word) for each word of an image's columns, in pixel order.
template <class Visit>
void forEachWord(int rows, int columns, Visit visit) {
    int word = 0;
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < rows; row += kWordRows) visit(column * rows + row, word++);
    }
}

/// Finds the runs, in pixel order, and their minimum depths.
void findRuns(const float* depth_m, int rows, int columns, ComponentsWorkspace* w) {
    std::uint32_t* const nearest = w->nearest.data();
    std::ptrdiff_t run = -1;
    std::uint32_t min = 0;
    forEachWord(rows, columns, [&](int first, int word) {
        const float* const depths_m = depth_m + first;
        std::int32_t* const runs = w->run.data() + first;
        const std::uint64_t lowest = w->lowest[word];
        forEachBit(w->roi[word], [&](int bit) {
            const auto is_lowest = static_cast<std::ptrdiff_t>(lowest >> bit & 1);
            std::uint32_t depth;
            std::memcpy(&depth, depths_m + bit, sizeof depth);
            run += is_lowest;
            min = std::min(min | static_cast<std::uint32_t>(-is_lowest), depth);
            nearest[run] = min;  // runs are visited from the lowest pixel upwards
            runs[bit] = static_cast<std::int32_t>(run);
        });
    });
    w->runs = static_cast<std::size_t>(run + 1);
}

/// The first of the runs joined with this run.
std::int32_t firstOf(std::int32_t run, std::int32_t* first) {
    while (first[run] != run) {
        first[run] = first[first[run]];
        run = first[run];
    }
    return run;
}

void joinRuns(int rows, int columns, ComponentsWorkspace* w) {
    const int to_first_column = rows - rows * columns, last_column = rows * (columns - 1);
    const std::int32_t* const run_of = w->run.data();
    std::int32_t* const first = w->first.data();
    for (std::size_t run = 0; run < w->runs; ++run) first[run] = static_cast<std::int32_t>(run);
    forEachWord(rows, columns, [&](int first_pixel, int word) {
        const std::int32_t* const runs = run_of + first_pixel;
        const std::int32_t* const on_right =
            runs + (first_pixel < last_column ? rows : to_first_column);
        forEachBit(w->links.right[word], [&](int bit) {
            const std::int32_t a = runs[bit], b = on_right[bit];
            if (first[b] == b && a < b) {  // usual case: the first link of b
                first[b] = first[a];
            } else {
                const std::int32_t first_a = firstOf(a, first), first_b = firstOf(b, first);
                first[std::max(first_a, first_b)] = std::min(first_a, first_b);
            }
        });
    });
}

/// Numbers the components, nearest first. Runs are in pixel order, so ties go to the smaller pixel
/// index.
void numberRuns(ComponentsWorkspace* w) {
    std::int32_t *const first = w->first.data(), *const number = w->number.data();
    std::uint64_t* const closest = w->closest.data();
    const std::uint32_t* const nearest = w->nearest.data();
    const std::size_t runs = w->runs;
    std::fill_n(closest, runs, ~std::uint64_t{0});
    for (std::size_t run = 0; run < runs; ++run) {
        first[run] = first[first[run]];  // already final for earlier runs
        const std::uint64_t key = std::uint64_t{nearest[run]} << 32 | run;
        if (key < closest[first[run]]) closest[first[run]] = key;
    }
    w->order.resize(w->runs + 1);
    std::uint64_t* const order = w->order.data();
    std::size_t components = 0;
    for (std::size_t run = 0; run < runs; ++run) {
        const std::uint64_t key = closest[first[run]];
        order[components] = key;
        components += itemOf(key) == run;
    }
    w->order.resize(components);
    radixSort(w->order, w->swap);
    std::int32_t last = 0;
    for (const std::uint64_t key : w->order) number[first[itemOf(key)]] = ++last;
    for (std::size_t run = 0; run < runs; ++run) number[run] = number[first[run]];
}

/// Renumbers components 1, 2, ... in order, skipping components without returns (all their pixels
/// were repaired). `max` is the highest number.
void renumber(std::int32_t max, LabelledReturns& returns, std::vector<std::int32_t>& number) {
    std::vector<std::int32_t>& component = returns.component;
    number.assign(static_cast<std::size_t>(max) + 1, 0);
    for (const std::uint32_t i : returns.roi) number[component[i]] = 1;
    number[0] = 0;
    for (std::size_t c = 1; c < number.size(); ++c) number[c] += number[c - 1];
    if (number.back() == max) return;  // no gaps
    for (const std::uint32_t i : returns.roi) component[i] = number[component[i]];
}

}  // namespace

// Fast because it finds links for many pixels at once, and joins and sorts runs and components
// instead of pixels.
void numberRoiComponents(const Image<float>& depth_m, const Image<Label>& labels, float max_gap_m,
                         Image<std::int32_t>& components, ComponentsWorkspace& w) {
    const int rows = static_cast<int>(depth_m.rows()), columns = static_cast<int>(depth_m.cols());
    const auto pixels = static_cast<std::size_t>(depth_m.size());
    findLinks(depth_m, max_gap_m, w.links, w.depth_seam);
    findLabelled(labels, Label::Roi, w.roi, w.label_seam);
    w.lowest.resize(w.roi.size());
    for (auto* list : {&w.run, &w.first, &w.number}) list->resize(pixels);
    w.nearest.resize(pixels);
    w.closest.resize(pixels);
    withWordsOf(rows, [&](auto words) { keepRoiLinks(words, columns, &w); });
    findRuns(depth_m.data(), rows, columns, &w);
    joinRuns(rows, columns, &w);
    numberRuns(&w);
    components.setZero(rows, columns);
    const std::int32_t* const number = w.number.data();
    forEachWord(rows, columns, [&](int first, int word) {
        const std::int32_t* const runs = w.run.data() + first;
        std::int32_t* const numbers = components.data() + first;
        forEachBit(w.roi[word], [&](int bit) { numbers[bit] = number[runs[bit]]; });
    });
}

void numberReturns(const Scan& scan, const RangeImage& image, const Image<std::int32_t>& components,
                   const OwnLabels& own_labels, float max_gap_m, LabelledReturns& returns,
                   ComponentsWorkspace& work) {
    returns.component.assign(scan.size(), 0);
    std::int32_t max = 0;
    for (const std::uint32_t i : returns.roi) {
        const std::int32_t pixel = image.depth_mapper[i];
        if (pixel == RangeImage::kNoPixel) continue;
        returns.component[i] = components.data()[pixel];
        max = std::max(max, returns.component[i]);
    }
    for (const std::int32_t i : own_labels.returns) {
        if (returns.component[i] == 0) continue;  // includes returns without a pixel
        const float depth_m = image.depth_m.data()[image.depth_mapper[i]];
        if (!(std::abs(scan.range_m[i] - depth_m) < max_gap_m)) returns.component[i] = 0;
    }
    renumber(max, returns, work.without_gaps);
}

}  // namespace hagen
