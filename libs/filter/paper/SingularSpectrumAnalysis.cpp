// Many runs are smoothed at once, one per lane. A trajectory matrix and its transpose have the same
// components, so the shorter side is the window. Only the smaller set of components, to keep or to
// remove, is computed. Projection and hankelization are one linear filter. Floats are used first,
// then doubles for the few runs that need them.
#include "filter/paper/SingularSpectrumAnalysis.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>
#include "filter/FindColumnBits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/paper/SingularSpectrumAnalysis.cpp"
#include <hwy/foreach_target.h>  // compiled once per instruction set
#include <hwy/highway.h>

#include "filter/paper/EigenBatch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

/// The Gram matrix (m x m) of the trajectory matrix's rows, divided by its trace. Each entry is
/// computed from the previous entry along the diagonal.
template <class Real>
void rowProducts(RunBatch<Real>& batch) {
    const int m = batch.m, columns = batch.values - m + 1;
    const Pack<Real> zero = all<Real>(0);
    const Lanes<Real>* const series = batch.series.data();
    const Lanes<Real>* const tail = batch.tail.data() + m - 1;  // values after the first row
    batch.head.resize(columns);                                 // the first row
    for (int k = 0; k < columns; ++k) {
        const auto is_within = all<Real>(k) < load(batch.columns);
        store(select(is_within, load(series[k]), zero), batch.head[k]);
    }
    batch.eigen.matrix.resize(m * m);
    Lanes<Real>* const matrix = batch.eigen.matrix.data();
    Pack<Real> trace = zero;
    for (int i = 0; i < m; ++i) {
        Pack<Real> sum = zero;
        for (int k = 0; k < columns; ++k) sum = sum + load(batch.head[k]) * load(series[i + k]);
        store(sum, matrix[i * m]);
        for (int j = 1; i + j < m; ++j) {
            sum = sum - load(series[j - 1]) * load(series[i + j - 1]) +
                  load(tail[j - 1]) * load(tail[i + j - 1]);
            store(sum, matrix[(i + j) * m + j]);
        }
    }
    for (int i = 0; i < m; ++i) trace = trace + load(matrix[i * m + i]);
    store(trace, batch.trace);
    const Pack<Real> scale = all<Real>(1) / max(trace, all<Real>(kTiny<Real>));
    for (int i = 0; i < m; ++i) {
        for (int j = 0; j <= i; ++j) store(load(matrix[i * m + j]) * scale, matrix[i * m + j]);
    }
}

/// The projection onto the eigenvectors, m x m; overwrites the matrix.
template <class Real>
void projection(int m, int vectors, EigenBatch<Real>& eigen) {
    const Lanes<Real>* const v = eigen.vectors.data();
    for (int i = 0; i < m; ++i) {
        for (int j = 0; j <= i; ++j) {
            Pack<Real> sum = all<Real>(0);
            for (int c = 0; c < vectors; ++c) sum = sum + load(v[c * m + i]) * load(v[c * m + j]);
            store(sum, eigen.matrix[i * m + j]);
            store(sum, eigen.matrix[j * m + i]);
        }
    }
}

template <class Real>
HWY_INLINE Pack<Real> weightedSum(const Lanes<Real>* weights, const Lanes<Real>* values,
                                  int count) {
    Pack<Real> sum = all<Real>(0);
    for (int k = 0; k < count; ++k) sum = sum + load(weights[k]) * load(values[k]);
    return sum;
}

/// The means along the antidiagonals of the trajectory matrix's projection, as a filter of the
/// series: the sum along each diagonal of the m x m projection is the weight of the value at that
/// distance. Each of the first m - 1 values adds a row of the projection to the filter, and each of
/// the last m - 1 values removes a row.
template <class Real>
void antidiagonalMeans(RunBatch<Real>& batch) {
    const int m = batch.m;
    const Lanes<Real>*const series = batch.series.data(), *const tail = batch.tail.data();
    const Lanes<Real>* const row = batch.eigen.matrix.data();
    batch.smooth.resize(batch.values);
    batch.smooth_tail.resize(m);
    batch.filter.assign(2 * m - 1, Lanes<Real>{});
    Lanes<Real>* const filter = batch.filter.data();
    for (int n = 0; n < m; ++n) {
        Lanes<Real>* const added = filter + m - 1 - n;
        for (int w = 0; w < m; ++w) store(load(added[w]) + load(row[n * m + w]), added[w]);
        store(weightedSum(added, series, m + n) * all<Real>(1.0 / (n + 1)), batch.smooth[n]);
    }
    for (int n = m; n <= batch.values - m; ++n) {
        store(weightedSum(filter, series + n - m + 1, 2 * m - 1) * all<Real>(1.0 / m),
              batch.smooth[n]);
    }
    for (int n = 0, left = m - 1; left > 0; ++n, --left) {
        Lanes<Real>* const lost = filter + m - 1 - n;
        for (int w = 0; w < m; ++w) store(load(lost[w]) - load(row[n * m + w]), lost[w]);
        store(weightedSum(filter, tail + n, m - 1 + left) * all<Real>(1.0 / left),
              batch.smooth_tail[n]);
    }
}

/// Subtracts the computed components from the series, if they are to be removed.
template <class Real>
void subtractSmooth(RunBatch<Real>& batch) {
    const int m = batch.m;
    for (int n = 0; n <= batch.values - m; ++n) {
        store(load(batch.series[n]) - load(batch.smooth[n]), batch.smooth[n]);
    }
    for (int n = 0; n + 1 < m; ++n) {
        store(load(batch.tail[n + m - 1]) - load(batch.smooth_tail[n]), batch.smooth_tail[n]);
    }
}

/// Rounding rotates the kept components by a rounding error of the matrix, divided by the gap
/// between the eigenvalues PC and PC + 1. At most this fraction of the last kept component is lost,
/// and its entries do not exceed its singular value.
void boundRoundingError(RunBatch<float>& batch) {
    constexpr double rounding = 0x1p-24, of_eigenvalue = 16 * rounding;
    const Pack<float> last = load(batch.eigen.last), next = load(batch.eigen.next);
    const Pack<float> gap = absolute(last - next) - all<float>(of_eigenvalue);
    const Pack<float> kept = max(max(last, next), all<float>(of_eigenvalue));
    const Pack<float> singular_value = squareRoot(kept * load(batch.trace));
    store(singular_value * all<float>(rounding) / max(gap, all<float>(kTiny<float>)), batch.error);
}

/// Requires more rows and columns of the trajectory matrix than components.
template <class Real>
void smoothBatch(int principal_components, RunBatch<Real>& batch) {
    const int removed = batch.m - principal_components;
    const bool removes = removed <= principal_components;
    const int vectors = removes ? removed : principal_components;
    rowProducts(batch);
    eigenvectors(batch.m, vectors, removes, batch.eigen);
    projection(batch.m, vectors, batch.eigen);
    antidiagonalMeans(batch);
    if (removes) subtractSmooth(batch);
}

}  // namespace

void smoothWithFloats(int principal_components, RunBatch<float>& batch) {
    smoothBatch(principal_components, batch);
    boundRoundingError(batch);
}
void smoothWithDoubles(int principal_components, RunBatch<double>& batch) {
    smoothBatch(principal_components, batch);
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(smoothWithFloats);
HWY_EXPORT(smoothWithDoubles);

/// Maximum effect of rounding on a value, in the value's unit. On real scans it was less than a
/// fifth of this.
constexpr float kTolerance = 2e-4f;

using Run = SsaWorkspace::Run;

/// The first bit in [from, end) that differs from the bits of `same`, which are all 0 or all 1;
/// `end` if all are equal.
std::size_t otherBit(const std::uint64_t* words, std::size_t from, std::size_t end,
                     std::uint64_t same) {
    for (; from < end; from = (from / 64 + 1) * 64) {
        const std::uint64_t others = (words[from / 64] ^ same) >> from % 64;
        if (others != 0) {
            return std::min(end, from + hwy::Num0BitsBelowLS1Bit_Nonzero64(others));
        }
    }
    return end;
}

/// Fills work.runs with the runs of at least `fewest` values, sorted by length.
void findRuns(Image<float>& image, int fewest, SsaWorkspace& work) {
    std::vector<Run>&found = work.found, &runs = work.runs;
    std::vector<int>& start_of = work.next_of_length;
    const auto rows = static_cast<std::size_t>(image.rows());
    const auto pixels = static_cast<std::size_t>(image.size());
    findPresent(image, work.has_value, work.seam);
    const std::uint64_t* words = work.has_value.data();
    found.clear();
    found.reserve(pixels / fewest);
    runs.reserve(pixels / fewest);
    start_of.assign(rows + 2, 0);
    for (std::size_t column = 0; column < pixels;
         column += rows, words += wordsOf(static_cast<int>(rows))) {
        for (std::size_t row = 0; row + fewest <= rows;) {
            const std::size_t begin = otherBit(words, row, rows, 0);
            row = otherBit(words, begin, rows, ~std::uint64_t{0});
            const int values = static_cast<int>(row - begin);
            if (values < fewest) continue;
            found.push_back({image.data() + column + begin, values});
            ++start_of[values + 1];
        }
    }
    for (std::size_t length = 1; length <= rows; ++length) start_of[length + 1] += start_of[length];
    runs.resize(found.size());
    for (const Run& run : found) runs[start_of[run.values]++] = run;
}

void smooth(int principal_components, RunBatch<float>& batch) {
    HWY_DYNAMIC_DISPATCH(smoothWithFloats)(principal_components, batch);
}
void smooth(int principal_components, RunBatch<double>& batch) {
    HWY_DYNAMIC_DISPATCH(smoothWithDoubles)(principal_components, batch);
}

/// Reserves memory for all possible runs, so that later scans do not allocate.
template <class Real>
void reserve(int window_size, int rows, RunBatch<Real>& batch) {
    const int m = std::min(window_size, (rows + 1) / 2);
    EigenBatch<Real>& eigen = batch.eigen;
    for (auto* values :
         {&batch.series, &batch.tail, &batch.smooth, &batch.smooth_tail, &batch.head, &batch.filter,
          &eigen.scale, &eigen.diagonal, &eigen.beside, &eigen.product}) {
        values->reserve(rows);
    }
    eigen.matrix.reserve(m * m);
    eigen.vectors.reserve(m * m);
    eigen.rotations.reserve(4 * m * m);  // usually two sweeps per eigenvalue
}

/// Fills lanes without a run with the last run.
template <class Real>
void fillLanes(const Run* runs, int count, RunBatch<Real>& batch) {
    const int tail_values = 2 * (batch.m - 1);
    batch.values = runs[count - 1].values;
    batch.series.resize(batch.values);
    batch.tail.resize(tail_values);
    for (int lane = 0; lane < kLanes<Real>; ++lane) {
        const Run& run = runs[std::min(lane, count - 1)];
        const float* const tail = run.begin + run.values - tail_values;
        for (int n = 0; n < run.values; ++n) {
            batch.series[n].of[lane] = static_cast<Real>(run.begin[n]);
        }
        for (int n = run.values; n < batch.values; ++n) batch.series[n].of[lane] = 0;
        for (int n = 0; n < tail_values; ++n) batch.tail[n].of[lane] = static_cast<Real>(tail[n]);
        batch.columns.of[lane] = static_cast<Real>(run.values - batch.m + 1);
    }
}

template <class Real>
void takeLane(const RunBatch<Real>& batch, int lane, const Run& run) {
    const int tail = run.values - batch.m + 1;
    for (int n = 0; n < tail; ++n) run.begin[n] = static_cast<float>(batch.smooth[n].of[lane]);
    for (int n = tail; n < run.values; ++n) {
        run.begin[n] = static_cast<float>(batch.smooth_tail[n - tail].of[lane]);
    }
}

/// Smooths runs, which are sorted by length. Runs whose rounding error is too large are not written
/// and stay in `runs`.
template <class Real>
void smoothRuns(int window_size, int principal_components, RunBatch<Real>& batch,
                std::vector<Run>& runs) {
    const auto shorterSide = [&](const Run& run) {
        return std::min(window_size, run.values - window_size + 1);
    };
    std::size_t left = 0;
    for (std::size_t first = 0, end; first < runs.size(); first = end) {
        batch.m = shorterSide(runs[first]);
        end = std::min(first + kLanes<Real>, runs.size());
        while (shorterSide(runs[end - 1]) != batch.m) --end;
        fillLanes(&runs[first], static_cast<int>(end - first), batch);
        smooth(principal_components, batch);
        for (std::size_t i = first; i < end; ++i) {
            const int lane = static_cast<int>(i - first);
            if (batch.error.of[lane] < kTolerance) {
                takeLane(batch, lane, runs[i]);
            } else {
                runs[left++] = runs[i];
            }
        }
    }
    runs.resize(left);
}

}  // namespace

void smoothColumns(const Image<float>& values, int window_size, int principal_components,
                   Image<float>& smoothed, SsaWorkspace& work) {
    smoothed = values;
    if (principal_components == window_size) return;
    // Skips shorter runs, because all of their components would be kept.
    findRuns(smoothed, window_size + principal_components, work);
    reserve(window_size, static_cast<int>(values.rows()), work.floats);
    reserve(window_size, static_cast<int>(values.rows()), work.doubles);
    smoothRuns(window_size, principal_components, work.floats, work.runs);
    smoothRuns(window_size, principal_components, work.doubles, work.runs);
}

}  // namespace hagen
#endif
