#include <hagen/segmentation/RoiComponents.h>
#include <algorithm>
#include <cstring>
#include <vector>

#include "ColumnBits.h"
#include "RadixSort.h"

namespace hagen {
namespace {

/// All that is made of one image. Kept from scan to scan, so that none is allocated; holds nothing
/// between them. A run is a stretch of RoI pixels of a column, linked one above the other. The
/// lists may be longer than what is in them.
struct Workspace {
    ColumnBits roi, lowest;  ///< RoI pixels with a depth, and those that are their run's lowest
    ColumnLinks links;       ///< of RoI with RoI; on the right only the lowest that says the same
    std::size_t pixels = 0, runs = 0;
    std::vector<std::int32_t> pixel;     ///< the RoI pixels, ascending
    std::vector<std::int32_t> run;       ///< of each pixel of the image, if it is RoI
    std::vector<std::uint32_t> nearest;  ///< of each run: its least depth, as bits, which order so
    std::vector<std::int32_t> first;     ///< of each run: an earlier one linked with it, or itself
    std::vector<std::uint64_t> closest;  ///< of a component's first run: its nearest run
    std::vector<std::int32_t> number;    ///< of each run: its component
    std::vector<std::uint64_t> order, swap;
};

void keepRoiLinks(int words, int columns, Workspace* w) {
    std::uint64_t *const roi = w->roi.data(), *const lowest = w->lowest.data();
    std::uint64_t *const above = w->links.above.data(), *const right = w->links.right.data();
    const std::uint64_t* const present = w->links.present.data();
    const int all = columns * words;
    for (int n = 0; n < all; ++n) roi[n] &= present[n];
    for (int column = 0; column < columns; ++column) {
        std::uint64_t linked_below = 0;
        for (int n = column * words; n < (column + 1) * words; ++n) {
            const std::uint64_t next = n + 1 < (column + 1) * words ? roi[n + 1] : 0;
            above[n] &= roi[n] & (roi[n] >> 1 | next << (kWordRows - 1));
            lowest[n] = roi[n] & ~(above[n] << 1 | linked_below);
            linked_below = above[n] >> (kWordRows - 1);
        }
    }
    for (int column = 0; column < columns; ++column) {
        const int to_next = column + 1 < columns ? words : words - all;
        std::uint64_t same_below = 0;
        for (int n = column * words; n < (column + 1) * words; ++n) {
            right[n] &= roi[n] & roi[n + to_next];
            const std::uint64_t same = right[n] & above[n] & above[n + to_next];
            right[n] &= ~(same << 1 | same_below);
            same_below = same >> (kWordRows - 1);
        }
    }
}

/// Calls visit(pixel, word, bit) for each pixel in these bits of an image, in its order.
template <class Visit>
void forEachPixel(const ColumnBits& bits, int rows, int columns, Visit visit) {
    int word = 0;
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < rows; row += kWordRows, ++word) {
            const int first = column * rows + row;
            forEachBit(bits[word], [&](int bit) { visit(first + bit, word, bit); });
        }
    }
}

/// Runs, in the order of pixels, and how near they come.
void findRuns(const float* depth_m, int rows, int columns, Workspace* w) {
    const std::uint64_t* const lowest = w->lowest.data();
    std::int32_t *const run_of = w->run.data(), *pixel_end = w->pixel.data();
    std::uint32_t* const nearest = w->nearest.data();
    std::int32_t run = -1;
    std::uint32_t least = 0;
    forEachPixel(w->roi, rows, columns, [&](int pixel, int word, int bit) {
        const auto is_lowest = static_cast<std::uint32_t>(lowest[word] >> bit & 1);
        std::uint32_t depth;
        std::memcpy(&depth, depth_m + pixel, sizeof depth);
        run += static_cast<std::int32_t>(is_lowest);
        least = std::min(least | (0 - is_lowest), depth);  // from the lowest on
        nearest[run] = least;
        run_of[pixel] = run;
        *pixel_end++ = pixel;
    });
    w->runs = static_cast<std::size_t>(run + 1);
    w->pixels = static_cast<std::size_t>(pixel_end - w->pixel.data());
}

/// The first of the runs that this one is joined with so far.
std::int32_t firstOf(std::int32_t run, std::int32_t* first) {
    while (first[run] != run) {
        first[run] = first[first[run]];
        run = first[run];
    }
    return run;
}

/// Joins the runs of columns side by side.
void joinRuns(int rows, int columns, Workspace* w) {
    const int to_first_column = rows - rows * columns, last_column = rows * (columns - 1);
    const std::int32_t* const run_of = w->run.data();
    std::int32_t* const first = w->first.data();
    for (std::size_t run = 0; run < w->runs; ++run) first[run] = static_cast<std::int32_t>(run);
    forEachPixel(w->links.right, rows, columns, [&](int pixel, int, int) {
        const std::int32_t a = run_of[pixel];
        const std::int32_t b = run_of[pixel + (pixel < last_column ? rows : to_first_column)];
        if (first[b] == b && a < b) {  // the first link of b, as most are
            first[b] = first[a];
        } else {
            const std::int32_t first_a = firstOf(a, first), first_b = firstOf(b, first);
            first[std::max(first_a, first_b)] = std::min(first_a, first_b);
        }
    });
}

/// Components, from the nearest on. Runs are in the order of pixels: so of two equally near ones
/// the earlier has the first pixel.
void numberRuns(Workspace* w) {
    std::int32_t *const first = w->first.data(), *const number = w->number.data();
    std::uint64_t* const closest = w->closest.data();
    std::fill_n(closest, w->runs, ~std::uint64_t{0});
    for (std::size_t run = 0; run < w->runs; ++run) {
        first[run] = first[first[run]];  // that of an earlier run is found already
        std::uint64_t& key = closest[first[run]];
        key = std::min(key, std::uint64_t{w->nearest[run]} << 32 | run);
    }
    w->order.resize(w->runs + 1);
    std::size_t components = 0;
    for (std::size_t run = 0; run < w->runs; ++run) {
        const std::uint64_t key = closest[first[run]];
        w->order[components] = key;
        components += itemOf(key) == run;
    }
    w->order.resize(components);
    radixSort(w->order, w->swap);
    std::int32_t last = 0;
    for (const std::uint64_t key : w->order) number[first[itemOf(key)]] = ++last;
    for (std::size_t run = 0; run < w->runs; ++run) number[run] = number[first[run]];
}

}  // namespace

// Links are found for many pixels at once; then runs are joined and not pixels, and components
// sorted and not pixels.
void numberRoiComponents(const Image<float>& depth_m, const Image<Label>& labels, float max_gap_m,
                         Image<std::int32_t>& components) {
    thread_local Workspace workspace;
    Workspace& w = workspace;
    const int rows = static_cast<int>(depth_m.rows()), columns = static_cast<int>(depth_m.cols());
    const auto pixels = static_cast<std::size_t>(depth_m.size());
    findLinks(depth_m, max_gap_m, w.links);
    findLabelled(labels, Label::Roi, w.roi);
    w.lowest.resize(w.roi.size());
    for (auto* list : {&w.pixel, &w.run, &w.first, &w.number}) list->resize(pixels);
    w.nearest.resize(pixels);
    w.closest.resize(pixels);
    keepRoiLinks(wordsOf(rows), columns, &w);
    findRuns(depth_m.data(), rows, columns, &w);
    joinRuns(rows, columns, &w);
    numberRuns(&w);
    components.setZero(rows, columns);
    for (std::size_t n = 0; n < w.pixels; ++n) {
        const std::int32_t pixel = w.pixel[n];
        components.data()[pixel] = w.number[w.run[pixel]];
    }
}

}  // namespace hagen
