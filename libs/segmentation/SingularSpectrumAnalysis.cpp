// Runs of one length are smoothed together, a run a lane. A trajectory matrix and its transpose
// have the same components, so the shorter side is the window; and of the components, the fewer are
// computed, the leading ones or those to be taken away.
#include <hagen/segmentation/SingularSpectrumAnalysis.h>
#include <algorithm>
#include <cmath>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "SingularSpectrumAnalysis.cpp"
#include <hwy/foreach_target.h>  // once more for each instruction set
#include <hwy/highway.h>

#include "EigenBatch-inl.h"

#ifndef HAGEN_RUN_BATCH
#define HAGEN_RUN_BATCH
namespace hagen {
namespace {

/// Runs of `values` values each, at most kLanes, and what smoothing them needs.
struct RunBatch {
    int values = 0;
    std::vector<Lanes> series, sums;
    EigenBatch eigen;
};

}  // namespace
}  // namespace hagen
#endif

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

/// The m x m products of the trajectory matrix's rows, along each diagonal from the one before.
void rowProducts(int m, RunBatch& batch) {
    const int columns = batch.values - m + 1;
    const Lanes* const s = batch.series.data();
    batch.eigen.matrix.resize(m * m);
    for (int i = 0; i < m; ++i) {
        Pack sum = all(0.0);
        for (int k = 0; k < columns; ++k) sum = sum + load(s[k]) * load(s[i + k]);
        store(sum, batch.eigen.matrix[i * m]);
        for (int j = 1; i + j < m; ++j) {
            sum = sum - load(s[j - 1]) * load(s[i + j - 1]) +
                  load(s[j - 1 + columns]) * load(s[i + j - 1 + columns]);
            store(sum, batch.eigen.matrix[(i + j) * m + j]);
        }
    }
}

/// The sums along the antidiagonals of the trajectory matrix's projection onto the eigenvectors:
/// its scores, convolved with them.
void antidiagonalSums(int m, int vectors, RunBatch& batch) {
    const int columns = batch.values - m + 1;
    const Lanes* const series = batch.series.data();
    batch.sums.resize(batch.values);
    Lanes* const sums = batch.sums.data();
    for (int n = 0; n < batch.values; ++n) store(all(0.0), sums[n]);
    for (int c = 0; c < vectors; ++c) {
        const Lanes* const v = &batch.eigen.vectors[c * m];
        for (int k = 0; k < columns; ++k) {
            Pack score = all(0.0);
            for (int w = 0; w < m; ++w) score = score + load(v[w]) * load(series[k + w]);
            for (int w = 0; w < m; ++w) store(load(sums[k + w]) + load(v[w]) * score, sums[k + w]);
        }
    }
}

}  // namespace

/// The series becomes smooth. Requires more rows and columns of the trajectory matrix than
/// components.
void smoothBatch(int window_size, int principal_components, RunBatch& batch) {
    const int m = std::min(window_size, batch.values - window_size + 1);
    const int removed = m - principal_components;
    const bool removes = removed <= principal_components;
    const int vectors = removes ? removed : principal_components;
    rowProducts(m, batch);
    eigenvectors(m, vectors, removes, batch.eigen);
    antidiagonalSums(m, vectors, batch);
    for (int n = 0; n < batch.values; ++n) {
        const int count = std::min(std::min(n + 1, batch.values - n), m);
        const Pack mean = load(batch.sums[n]) / all(count);
        store(removes ? load(batch.series[n]) - mean : mean, batch.series[n]);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(smoothBatch);

/// A run of `values` pixels with a value.
struct Run {
    float* begin;
    int values;
};

/// Those of at least `fewest` values, in order of their length.
void findRuns(Image<float>& image, int fewest, std::vector<Run>& runs) {
    // Kept from scan to scan, so that none is allocated; hold nothing between them.
    thread_local std::vector<Run> kept_found;
    thread_local std::vector<int> kept_start_of;
    std::vector<Run>& found = kept_found;
    std::vector<int>& start_of = kept_start_of;  // the place of the next run of this length

    const int rows = static_cast<int>(image.rows());
    found.clear();
    start_of.assign(rows + 2, 0);
    for (int column = 0; column < image.cols(); ++column) {
        const auto pixels = image.data() + column * image.rows();
        for (int row = 0; row + fewest <= rows;) {
            // Backwards, so that a gap rules out all that begins before it.
            int end = row + fewest;
            while (end > row && hasValue(pixels[end - 1])) --end;
            if (end > row) {
                row = end;
                continue;
            }
            end = row + fewest;
            while (end < rows && hasValue(pixels[end])) ++end;
            found.push_back({pixels + row, end - row});
            ++start_of[end - row + 1];
            row = end + 1;
        }
    }
    for (int length = 1; length <= rows; ++length) start_of[length + 1] += start_of[length];
    runs.resize(found.size());
    for (const Run& run : found) runs[start_of[run.values]++] = run;
}

void smoothRuns(const Run* runs, int count, int window_size, int principal_components,
                RunBatch& batch) {
    batch.values = runs->values;
    batch.series.resize(batch.values);
    for (int lane = 0; lane < kLanes; ++lane) {
        const float* const from = runs[std::min(lane, count - 1)].begin;
        for (int n = 0; n < batch.values; ++n) {
            batch.series[n].of[lane] = static_cast<double>(from[n]);
        }
    }
    HWY_DYNAMIC_DISPATCH(smoothBatch)(window_size, principal_components, batch);
    for (int lane = 0; lane < count; ++lane) {
        for (int n = 0; n < batch.values; ++n) {
            runs[lane].begin[n] = static_cast<float>(batch.series[n].of[lane]);
        }
    }
}

}  // namespace

void smoothColumns(const Image<float>& values, int window_size, int principal_components,
                   Image<float>& smoothed) {
    // Kept from scan to scan, so that none is allocated; hold nothing between them.
    thread_local std::vector<Run> kept_runs;
    thread_local RunBatch kept_batch;
    std::vector<Run>& runs = kept_runs;
    RunBatch& batch = kept_batch;

    smoothed = values;
    if (principal_components == window_size) return;
    // A shorter run's trajectory matrix has no more rows or columns than components are kept.
    findRuns(smoothed, window_size + principal_components, runs);
    for (std::size_t first = 0, end; first < runs.size(); first = end) {
        end = first;
        while (end < runs.size() && end < first + kLanes && runs[end].values == runs[first].values)
            ++end;
        smoothRuns(&runs[first], static_cast<int>(end - first), window_size, principal_components,
                   batch);
    }
}

}  // namespace hagen
#endif
