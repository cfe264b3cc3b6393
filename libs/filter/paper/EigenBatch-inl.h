// Eigenvectors of several small symmetric matrices at once, one matrix per lane. Compiled once per
// instruction set.

#ifndef HAGEN_EIGEN_BATCH_H
#define HAGEN_EIGEN_BATCH_H
#include "filter/paper/RunBatch.h"

namespace hagen {

/// Off-diagonal elements below this fraction of the matrix are treated as 0. For doubles, the
/// fraction is far below the resolution of squared floats.
template <class Real>
constexpr double kNegligible = sizeof(Real) == sizeof(float) ? 0x1p-23 : 0x1p-44;

/// The smallest divisor. Its square does not underflow.
template <class Real>
constexpr double kTiny = sizeof(Real) == sizeof(float) ? 1e-30 : 1e-280;

}  // namespace hagen
#endif

#if defined(HAGEN_EIGEN_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HAGEN_EIGEN_BATCH_INL_H
#undef HAGEN_EIGEN_BATCH_INL_H
#else
#define HAGEN_EIGEN_BATCH_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Arithmetic on Lanes, with the syntax of single numbers.
template <class Real>
using D = hn::CappedTag<Real, kLanes<Real>>;
template <class Real>
constexpr int kVectorLanes = static_cast<int>(hn::MaxLanes(D<Real>()));
template <class Real>
constexpr int kVectors = kLanes<Real> / kVectorLanes<Real>;

template <class Real>
struct Pack {
    HWY_INLINE Pack() {}  // an implicit constructor is not compiled for this instruction set
    hn::Vec<D<Real>> part[kVectors<Real>];
};
template <class Real>
struct PackMask {
    HWY_INLINE PackMask() {}
    hn::Mask<D<Real>> part[kVectors<Real>];
};

#define HAGEN_EACH_PART _Pragma("GCC unroll 8") for (int k = 0; k < kVectors<Real>; ++k)

template <class Real>
HWY_INLINE Pack<Real> load(const Lanes<Real>& from) {
    Pack<Real> r;
    HAGEN_EACH_PART r.part[k] = hn::Load(D<Real>(), from.of + k * kVectorLanes<Real>);
    return r;
}
template <class Real>
HWY_INLINE void store(const Pack<Real>& a, Lanes<Real>& to) {
    HAGEN_EACH_PART hn::Store(a.part[k], D<Real>(), to.of + k * kVectorLanes<Real>);
}
template <class Real>
HWY_INLINE Pack<Real> all(double value) {
    Pack<Real> r;
    HAGEN_EACH_PART r.part[k] = hn::Set(D<Real>(), static_cast<Real>(value));
    return r;
}

// NOLINTBEGIN(bugprone-macro-parentheses): names and types cannot be parenthesised
#define HAGEN_BINARY(name, op, Result)                                       \
    template <class Real>                                                    \
    HWY_INLINE Result<Real> name(const Pack<Real>& a, const Pack<Real>& b) { \
        Result<Real> r;                                                      \
        HAGEN_EACH_PART r.part[k] = hn::op(a.part[k], b.part[k]);            \
        return r;                                                            \
    }
// NOLINTEND(bugprone-macro-parentheses)
HAGEN_BINARY(operator+, Add, Pack)
HAGEN_BINARY(operator-, Sub, Pack)
HAGEN_BINARY(operator*, Mul, Pack)
HAGEN_BINARY(operator/, Div, Pack)
HAGEN_BINARY(max, Max, Pack)
HAGEN_BINARY(withSignOf, CopySign, Pack)
HAGEN_BINARY(operator==, Eq, PackMask)
HAGEN_BINARY(operator<, Lt, PackMask)
#undef HAGEN_BINARY

template <class Real>
HWY_INLINE Pack<Real> squareRoot(const Pack<Real>& a) {
    Pack<Real> r;
    HAGEN_EACH_PART r.part[k] = hn::Sqrt(a.part[k]);
    return r;
}
template <class Real>
HWY_INLINE Pack<Real> absolute(const Pack<Real>& a) {
    Pack<Real> r;
    HAGEN_EACH_PART r.part[k] = hn::Abs(a.part[k]);
    return r;
}
template <class Real>
HWY_INLINE Pack<Real> select(const PackMask<Real>& mask, const Pack<Real>& yes,
                             const Pack<Real>& no) {
    Pack<Real> r;
    HAGEN_EACH_PART r.part[k] = hn::IfThenElse(mask.part[k], yes.part[k], no.part[k]);
    return r;
}
template <class Real>
HWY_INLINE Pack<Real> zeroIf(const PackMask<Real>& mask, const Pack<Real>& a) {
    Pack<Real> r;
    HAGEN_EACH_PART r.part[k] = hn::IfThenZeroElse(mask.part[k], a.part[k]);
    return r;
}
template <class Real>
HWY_INLINE PackMask<Real> operator||(const PackMask<Real>& a, const PackMask<Real>& b) {
    PackMask<Real> r;
    HAGEN_EACH_PART r.part[k] = hn::Or(a.part[k], b.part[k]);
    return r;
}
template <class Real>
HWY_INLINE bool allOf(const PackMask<Real>& mask) {
    bool r = true;
    HAGEN_EACH_PART r = r && hn::AllTrue(D<Real>(), mask.part[k]);
    return r;
}
#undef HAGEN_EACH_PART

/// Householder reduction Q^T A Q = T to a tridiagonal matrix, from the last row upwards, which
/// leaves the large eigenvalues at the lower end of T, where QL needs them. Row k of the matrix
/// stores the vector v of its reflection, `scale` stores 2 / v^T v (0: no reflection).
template <class Real>
void tridiagonalise(int m, EigenBatch<Real>& batch) {
    const auto row = [&](int i) { return &batch.matrix[i * m]; };
    Lanes<Real>* const p = batch.product.data();
    const Pack<Real> zero = all<Real>(0.0);
    for (int k = m - 1; k > 1; --k) {
        Lanes<Real>* const v = row(k);
        store(load(v[k]), batch.diagonal[k]);
        Pack<Real> square = zero;
        for (int i = 0; i < k; ++i) square = square + load(v[i]) * load(v[i]);
        const Pack<Real> last = load(v[k - 1]);
        const Pack<Real> norm = withSignOf(squareRoot(square), last);
        const Pack<Real> half = square + last * norm;
        const Pack<Real> scale = zeroIf(half < all<Real>(kTiny<Real>), all<Real>(1.0) / half);
        store(zero - norm, batch.beside[k - 1]);
        store(last + norm, v[k - 1]);
        store(scale, batch.scale[k]);

        // p = A v, using only the lower triangle of A
        for (int i = 0; i < k; ++i) {
            Pack<Real> sum = zero;
            for (int j = 0; j <= i; ++j) sum = sum + load(row(i)[j]) * load(v[j]);
            for (int j = i + 1; j < k; ++j) sum = sum + load(row(j)[i]) * load(v[j]);
            store(sum, p[i]);
        }
        // A - v w^T - w v^T, w = scale (p - v scale (p^T v) / 2)
        Pack<Real> dot = zero;
        for (int i = 0; i < k; ++i) dot = dot + load(p[i]) * load(v[i]);
        const Pack<Real> share = scale * (scale * dot * all<Real>(0.5));
        for (int i = 0; i < k; ++i) store(load(p[i]) * scale - share * load(v[i]), p[i]);
        for (int i = 0; i < k; ++i) {
            const Pack<Real> v_i = load(v[i]), w_i = load(p[i]);
            for (int j = 0; j <= i; ++j) {
                store(load(row(i)[j]) - (v_i * load(p[j]) + w_i * load(v[j])), row(i)[j]);
            }
        }
    }
    for (int k = 0; k < std::min(m, 2); ++k) store(load(row(k)[k]), batch.diagonal[k]);
    if (m > 1) store(load(row(1)[0]), batch.beside[0]);
}

/// The next QL sweep, which applies the rotations in [first, end).
template <class Real>
struct Sweep {
    int first, end;
    Pack<Real> shift;
};

/// Sets negligible off-diagonal entries to 0, and skips those that are 0 in all lanes. Wilkinson's
/// shift per lane: the eigenvalue of its first unfinished 2 x 2 block that is closer to the block's
/// first entry.
template <class Real>
HWY_INLINE void planSweep(const Pack<Real>& negligible, EigenBatch<Real>& batch,
                          Sweep<Real>& sweep) {
    const Pack<Real> zero = all<Real>(0.0);
    Pack<Real> beside = zero, upper = zero, lower = zero;
    int first = sweep.end, end = sweep.first;
    for (int i = sweep.end - 1; i >= sweep.first; --i) {
        const Pack<Real> e = load(batch.beside[i]);
        const PackMask<Real> is_done = absolute(e) < negligible;
        if (allOf(is_done)) {
            store(zero, batch.beside[i]);
            continue;
        }
        store(zeroIf(is_done, e), batch.beside[i]);
        first = i;
        end = std::max(end, i + 1);
        beside = select(is_done, beside, e);
        upper = select(is_done, upper, load(batch.diagonal[i]));
        lower = select(is_done, lower, load(batch.diagonal[i + 1]));
    }
    const Pack<Real> half = (lower - upper) * all<Real>(0.5), square = beside * beside;
    const Pack<Real> below = half + withSignOf(squareRoot(half * half + square), half);
    sweep = {first, end, upper - zeroIf(below == zero, square / below)};
}

/// One implicit QL sweep. If a lane's off-diagonal entry is 0, its rotation is exactly the identity
/// and the chase restarts above, so lanes do not affect each other.
template <class Real>
HWY_INLINE GivensRotation<Real>* qlSweep(const Sweep<Real>& sweep, EigenBatch<Real>& batch,
                                         GivensRotation<Real>* to) {
    const Pack<Real> zero = all<Real>(0.0), one = all<Real>(1.0);
    Lanes<Real>*const diagonal = batch.diagonal.data(), *const beside = batch.beside.data();
    Pack<Real> s = one, c = one, p = zero, g = load(diagonal[sweep.end]) - sweep.shift;
    PackMask<Real> begins = zero == zero;
    for (int i = sweep.end - 1; i >= sweep.first; --i, ++to) {
        const Pack<Real> e = load(beside[i]), d = load(diagonal[i]),
                         below = load(diagonal[i + 1]) - p;
        const PackMask<Real> idles = e == zero;
        const Pack<Real> f = s * e, b = c * e;
        const Pack<Real> r = squareRoot(f * f + g * g);
        store(zeroIf(begins, select(idles, g, r)), beside[i + 1]);
        const PackMask<Real> is_identity = idles || r == zero;
        const Pack<Real> inverse = one / r;
        s = zeroIf(is_identity, f * inverse);
        c = select(is_identity, one, g * inverse);
        store(c, to->cosine);
        store(s, to->sine);
        to->i = i;
        const Pack<Real> t = (d - below) * s + c * (b + b);
        p = s * t;
        store(below + p, diagonal[i + 1]);
        // Idle lanes continue with c = s = 1 and the next diagonal entry, as at the start.
        g = c * t - select(idles, sweep.shift - d, b);
        s = select(idles, one, s);
        begins = idles;
    }
    store(load(diagonal[sweep.first]) - p, diagonal[sweep.first]);
    store(zeroIf(begins, g), beside[sweep.first]);
    return to;
}

/// Diagonalises T by rotations, which are stored; returns their number. If rounding prevents
/// convergence, a lane may keep off-diagonal entries, but its vectors are still orthonormal.
template <class Real>
std::size_t diagonaliseTridiagonal(int m, EigenBatch<Real>& batch) {
    Pack<Real> largest = all<Real>(0.0);
    for (int i = 0; i < m; ++i) {
        largest = max(largest, absolute(load(batch.diagonal[i])));
        if (i + 1 < m) largest = max(largest, absolute(load(batch.beside[i])));
    }
    const Pack<Real> negligible = largest * all<Real>(kNegligible<Real>) + all<Real>(kTiny<Real>);
    std::size_t rotations = 0;
    Sweep<Real> sweep{0, m - 1, all<Real>(0.0)};
    for (int sweeps = 0; sweeps < 30 * m; ++sweeps) {
        planSweep(negligible, batch, sweep);
        if (sweep.first >= sweep.end) break;
        if (batch.rotations.size() < rotations + m) batch.rotations.resize(2 * (rotations + m));
        rotations = qlSweep(sweep, batch, &batch.rotations[rotations]) - batch.rotations.data();
    }
    return rotations;
}

/// Unit vectors along the `count` smallest (or largest) diagonal entries of each lane.
template <class Real>
void pickEigenvectors(int m, int count, bool smallest, EigenBatch<Real>& batch) {
    const Pack<Real> zero = all<Real>(0.0), one = all<Real>(1.0), taken = all<Real>(HUGE_VAL);
    if (!smallest) {
        for (int i = 0; i < m; ++i) store(zero - load(batch.diagonal[i]), batch.diagonal[i]);
    }
    for (int v = 0; v <= count; ++v) {
        Pack<Real> best = load(batch.diagonal[0]), index = zero;
        for (int i = 1; i < m; ++i) {
            const Pack<Real> value = load(batch.diagonal[i]);
            const PackMask<Real> is_better = value < best;
            best = select(is_better, value, best);
            index = select(is_better, all<Real>(i), index);
        }
        store(best, v < count ? batch.last : batch.next);
        for (int i = 0; v < count && i < m; ++i) {
            const PackMask<Real> is_it = index == all<Real>(i);
            store(select(is_it, one, zero), batch.vectors[v * m + i]);
            store(select(is_it, taken, load(batch.diagonal[i])), batch.diagonal[i]);
        }
    }
    if (!smallest) {
        store(zero - load(batch.last), batch.last);
        store(zero - load(batch.next), batch.next);
    }
}

/// Applies the inverse rotations to the vectors, from the last to the first.
template <class Real>
void undoRotations(int m, int count, std::size_t rotations, EigenBatch<Real>& batch) {
    const GivensRotation<Real>* const first = batch.rotations.data();
    for (const GivensRotation<Real>* rotation = first + rotations; rotation != first;) {
        --rotation;
        const Pack<Real> c = load(rotation->cosine), s = load(rotation->sine);
        for (int v = 0; v < count; ++v) {
            Lanes<Real>* const at = batch.vectors.data() + v * m + rotation->i;
            const Pack<Real> x = load(at[0]), y = load(at[1]);
            store(c * x + s * y, at[0]);
            store(c * y - s * x, at[1]);
        }
    }
}

/// Applies the inverse reflections to the vectors.
template <class Real>
void undoReflections(int m, int count, EigenBatch<Real>& batch) {
    for (int k = 2; k < m; ++k) {
        const Lanes<Real>* const v = &batch.matrix[k * m];
        for (int c = 0; c < count; ++c) {
            Lanes<Real>* const y = &batch.vectors[c * m];
            Pack<Real> dot = all<Real>(0.0);
            for (int i = 0; i < k; ++i) dot = dot + load(v[i]) * load(y[i]);
            dot = dot * load(batch.scale[k]);
            for (int i = 0; i < k; ++i) store(load(y[i]) - dot * load(v[i]), y[i]);
        }
    }
}

/// Writes the orthonormal eigenvectors of the `count` smallest (or largest) eigenvalues of
/// batch.matrix, which is overwritten, to batch.vectors. Uses Householder reduction and the
/// implicit QL method; rotations are applied to the requested vectors only.
template <class Real>
void eigenvectors(int m, int count, bool smallest, EigenBatch<Real>& batch) {
    batch.scale.resize(m);
    batch.diagonal.resize(m);
    batch.beside.resize(m);
    batch.product.resize(m);
    batch.vectors.resize(count * m);
    tridiagonalise(m, batch);
    const std::size_t rotations = diagonaliseTridiagonal(m, batch);
    pickEigenvectors(m, count, smallest, batch);
    undoRotations(m, count, rotations, batch);
    undoReflections(m, count, batch);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#endif
