#pragma once
#include <vector>

namespace hagen {

// Stage 7 smooths many runs of values at once, one per vector lane.

/// The number of lanes: several vectors even with the widest instruction set, to hide the latency
/// of square roots and divisions.
template <class Real>
constexpr int kLanes = 128 / sizeof(Real);

/// A number per lane.
template <class Real>
struct alignas(64) Lanes {
    Real of[kLanes<Real>];
};

/// Rotates coordinates i and i + 1 of a vector.
template <class Real>
struct GivensRotation {
    Lanes<Real> cosine, sine;
    int i;
};

/// The leading eigenvectors of symmetric m x m matrices, one matrix per lane.
template <class Real>
struct EigenBatch {
    using Row = std::vector<Lanes<Real>>;
    Row matrix;        ///< m x m, row-major; only the lower triangle is used
    Row vectors;       ///< the eigenvectors, concatenated
    Lanes<Real> last;  ///< the eigenvalue of the last vector
    Lanes<Real> next;  ///< the next eigenvalue

    Row scale, diagonal, beside, product;
    std::vector<GivensRotation<Real>> rotations;
};

/// Up to kLanes runs, and memory to smooth them.
template <class Real>
struct RunBatch {
    using Values = std::vector<Lanes<Real>>;
    int m = 0;            ///< window size; each run has at least 2 m - 1 values
    int values = 0;       ///< length of the longest run
    Values series;        ///< the runs; shorter ones are padded with zeros
    Values tail;          ///< the last 2 (m - 1) values of each run
    Lanes<Real> columns;  ///< number of columns of each trajectory matrix

    Values smooth;        ///< result without the last m - 1 values of each run
    Values smooth_tail;   ///< last m - 1 values of the result
    Lanes<Real> error{};  ///< upper bound of the rounding error of the result

    Lanes<Real> trace;
    Values head, filter;
    EigenBatch<Real> eigen;
};

}  // namespace hagen
