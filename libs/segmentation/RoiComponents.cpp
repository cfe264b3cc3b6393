#include <hagen/segmentation/RoiComponents.h>
#include <hwy/base.h>
#include <algorithm>
#include <vector>

#include "PixelLinks.h"
#include "RadixSort.h"

namespace hagen {
namespace {

constexpr std::int32_t kNoRun = 0;
constexpr std::uint64_t kFarthest = ~std::uint64_t{0};

/// All that is made of one image. Kept from scan to scan, so that none is allocated; holds nothing
/// between them. A run is a stretch of pixels linked one above the other.
struct Workspace {
    PixelLinks links;
    std::size_t runs = 0;                ///< how many, kNoRun included; the lists may be longer
    std::vector<std::int32_t> run;       ///< of each pixel that has one, framed
    std::vector<std::uint64_t> nearest;  ///< of each run: its closest pixel, depth before index
    std::vector<std::int32_t> nearer;    ///< of each run: a nearer one linked with it; or itself
    std::vector<std::int32_t> number;    ///< of each run's component
    std::vector<std::uint64_t> order, swap;
};

template <class Visit>
void forEachBit(std::uint64_t bits, int first, Visit visit) {
    for (; bits != 0; bits &= bits - 1) {
        visit(first + static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits)));
    }
}

/// Runs, numbered in the order of pixels, and their closest pixels.
void findRuns(Workspace& w) {
    const PixelLinks& links = w.links;
    w.run.assign(links.value.size(), kNoRun);
    if (w.nearest.size() < links.value.size()) w.nearest.resize(links.value.size());
    std::int32_t run = kNoRun;
    std::uint64_t nearest = kFarthest;
    w.nearest[run] = nearest;
    std::uint64_t above_last = 0;
    for (int word = 0; word < links.words(); ++word) {
        const int first = word * PixelLinks::kWord;
        const std::uint64_t begins = ~(links.above[word] << 1 | above_last);
        above_last = links.above[word] >> 63;
        forEachBit(links.present[word], first, [&](int pixel) {
            const std::uint64_t is_first = begins >> (pixel - first) & 1;
            run += static_cast<std::int32_t>(is_first);
            const std::uint64_t nearest_below = nearest | (0 - is_first);  // kFarthest at first
            nearest = std::min(nearest_below, sortingKey(links.value[pixel], pixel));
            w.run[pixel] = run;
            w.nearest[run] = nearest;
        });
    }
    w.runs = static_cast<std::size_t>(run) + 1;
}

/// The nearest of the runs that this one is joined with so far.
std::int32_t nearestOf(std::int32_t run, std::vector<std::int32_t>& nearer) {
    while (nearer[run] != run) {
        nearer[run] = nearer[nearer[run]];
        run = nearer[run];
    }
    return run;
}

/// Joins the runs of columns side by side, by one link each where many say the same.
void joinRuns(Workspace& w) {
    const PixelLinks& links = w.links;
    w.nearer.resize(w.runs);
    for (std::size_t run = 0; run < w.runs; ++run) {
        w.nearer[run] = static_cast<std::int32_t>(run);
    }
    const int last_column = links.pixels() - links.stride();
    for (int word = 0; word < links.words(); ++word) {
        forEachBit(links.first_right[word], word * PixelLinks::kWord, [&](int pixel) {
            const int right = pixel < last_column ? pixel + links.stride() : pixel - last_column;
            const std::int32_t a = nearestOf(w.run[pixel], w.nearer);
            const std::int32_t b = nearestOf(w.run[right], w.nearer);
            if (w.nearest[a] < w.nearest[b]) {
                w.nearer[b] = a;
            } else {
                w.nearer[a] = b;
            }
        });
    }
}

/// Components from the nearest on; each goes by its nearest run.
void numberRuns(Workspace& w) {
    w.order.clear();
    for (std::size_t run = 1; run < w.runs; ++run) {
        if (w.nearer[run] == static_cast<std::int32_t>(run)) {
            w.order.push_back((w.nearest[run] & ~std::uint64_t{0xffffffff}) | run);
        }
    }
    radixSort(w.order, w.swap);
    w.number.resize(w.nearer.size());
    std::int32_t number = 0;
    w.number[kNoRun] = number;
    for (const std::uint64_t key : w.order) w.number[itemOf(key)] = ++number;
    for (std::size_t run = 1; run < w.runs; ++run) {
        w.number[run] = w.number[nearestOf(static_cast<std::int32_t>(run), w.nearer)];
    }
}

}  // namespace

// Links are found for many pixels at once; then runs are joined and not pixels, and components
// sorted and not pixels.
void numberRoiComponents(const Image<float>& depth_m, const Image<Label>& labels, float max_gap_m,
                         Image<std::int32_t>& components) {
    thread_local Workspace workspace;
    Workspace& w = workspace;
    const int rows = static_cast<int>(depth_m.rows());
    const int columns = static_cast<int>(depth_m.cols());
    const float* const depth = depth_m.data();
    const Label* const label = labels.data();
    linkPixels(
        rows, columns,
        [&](int pixel) { return label[pixel] == Label::Roi ? depth[pixel] : kNoValue; }, max_gap_m,
        w.links);
    findRuns(w);
    joinRuns(w);
    numberRuns(w);
    components.resize(rows, columns);
    const std::int32_t* const number = w.number.data();
    for (int column = 0; column < columns; ++column) {
        const std::int32_t* const run = w.run.data() + column * w.links.stride();
        std::int32_t* const component = components.data() + column * rows;
        for (int row = 0; row < rows; ++row) component[row] = number[run[row]];
    }
}

}  // namespace hagen
