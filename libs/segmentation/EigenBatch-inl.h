// Eigenvectors of several small symmetric matrices at once, a matrix a lane: once for each
// instruction set.

#ifndef HAGEN_EIGEN_BATCH_H
#define HAGEN_EIGEN_BATCH_H
#include <vector>

namespace hagen {

/// So many matrices at once, in several vectors even where vectors are widest: while one waits for
/// a root or a division, the others go on.
constexpr int kLanes = 16;

/// The same number of each matrix.
struct alignas(64) Lanes {
    double of[kLanes];
};

/// Turns coordinates i and i + 1 of a vector.
struct Rotation {
    Lanes cosine, sine;
    int i;
};

/// The memory of eigenvectors(), of matrices m x m.
struct EigenBatch {
    std::vector<Lanes> matrix;   ///< m x m, row by row, of which the lower triangle counts
    std::vector<Lanes> vectors;  ///< the eigenvectors found, one after the other

    std::vector<Lanes> scale, diagonal, beside, product;
    std::vector<Rotation> rotations;
};

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

/// Arithmetic on Lanes, as one would write it for a single number.
using D = hn::CappedTag<double, kLanes>;
constexpr int kVectorLanes = static_cast<int>(hn::MaxLanes(D()));
constexpr int kVectors = kLanes / kVectorLanes;

struct Pack {
    hn::Vec<D> part[kVectors];
};
struct PackMask {
    hn::Mask<D> part[kVectors];
};

#define HAGEN_EACH_PART _Pragma("GCC unroll 8") for (int k = 0; k < kVectors; ++k)

HWY_INLINE Pack load(const Lanes& from) {
    Pack r;
    HAGEN_EACH_PART r.part[k] = hn::Load(D(), from.of + k * kVectorLanes);
    return r;
}
HWY_INLINE void store(const Pack& a, Lanes& to) {
    HAGEN_EACH_PART hn::Store(a.part[k], D(), to.of + k * kVectorLanes);
}
HWY_INLINE Pack all(double value) {
    Pack r;
    HAGEN_EACH_PART r.part[k] = hn::Set(D(), value);
    return r;
}

#define HAGEN_BINARY(name, op, Result)                            \
    HWY_INLINE Result name(const Pack& a, const Pack& b) {        \
        Result r;                                                 \
        HAGEN_EACH_PART r.part[k] = hn::op(a.part[k], b.part[k]); \
        return r;                                                 \
    }
HAGEN_BINARY(operator+, Add, Pack)
HAGEN_BINARY(operator-, Sub, Pack)
HAGEN_BINARY(operator*, Mul, Pack)
HAGEN_BINARY(operator/, Div, Pack)
HAGEN_BINARY(max, Max, Pack)
HAGEN_BINARY(withSignOf, CopySign, Pack)
HAGEN_BINARY(operator==, Eq, PackMask)
HAGEN_BINARY(operator<, Lt, PackMask)
#undef HAGEN_BINARY

HWY_INLINE Pack squareRoot(const Pack& a) {
    Pack r;
    HAGEN_EACH_PART r.part[k] = hn::Sqrt(a.part[k]);
    return r;
}
HWY_INLINE Pack absolute(const Pack& a) {
    Pack r;
    HAGEN_EACH_PART r.part[k] = hn::Abs(a.part[k]);
    return r;
}
HWY_INLINE Pack select(const PackMask& mask, const Pack& yes, const Pack& no) {
    Pack r;
    HAGEN_EACH_PART r.part[k] = hn::IfThenElse(mask.part[k], yes.part[k], no.part[k]);
    return r;
}
HWY_INLINE Pack zeroIf(const PackMask& mask, const Pack& a) {
    Pack r;
    HAGEN_EACH_PART r.part[k] = hn::IfThenZeroElse(mask.part[k], a.part[k]);
    return r;
}
HWY_INLINE PackMask operator||(const PackMask& a, const PackMask& b) {
    PackMask r;
    HAGEN_EACH_PART r.part[k] = hn::Or(a.part[k], b.part[k]);
    return r;
}
HWY_INLINE bool allOf(const PackMask& mask) {
    bool r = true;
    HAGEN_EACH_PART r = r && hn::AllTrue(D(), mask.part[k]);
    return r;
}
#undef HAGEN_EACH_PART

/// Householder's reduction Q^T A Q = T to a tridiagonal matrix, from the last row upwards: that
/// leaves the large eigenvalues at the lower end of T, where QL wants them. Row k of the matrix
/// keeps the reflection's vector v, `scale` its 2 / v^T v (0: none).
inline void tridiagonalise(int m, EigenBatch& batch) {
    const auto row = [&](int i) { return &batch.matrix[i * m]; };
    Lanes* const p = batch.product.data();
    const Pack zero = all(0.0);
    for (int k = m - 1; k > 1; --k) {
        Lanes* const v = row(k);
        store(load(v[k]), batch.diagonal[k]);
        Pack square = zero;
        for (int i = 0; i < k; ++i) square = square + load(v[i]) * load(v[i]);
        const Pack last = load(v[k - 1]);
        const Pack norm = withSignOf(squareRoot(square), last);
        const Pack half = square + last * norm;
        const Pack scale = zeroIf(half < all(1e-280), all(1.0) / half);
        store(zero - norm, batch.beside[k - 1]);
        store(last + norm, v[k - 1]);
        store(scale, batch.scale[k]);

        // p = A v, of which only the lower triangle counts
        for (int i = 0; i < k; ++i) {
            Pack sum = zero;
            for (int j = 0; j <= i; ++j) sum = sum + load(row(i)[j]) * load(v[j]);
            for (int j = i + 1; j < k; ++j) sum = sum + load(row(j)[i]) * load(v[j]);
            store(sum, p[i]);
        }
        // A - v w^T - w v^T, w = scale (p - v scale (p^T v) / 2)
        Pack dot = zero;
        for (int i = 0; i < k; ++i) dot = dot + load(p[i]) * load(v[i]);
        const Pack share = scale * (scale * dot * all(0.5));
        for (int i = 0; i < k; ++i) store(load(p[i]) * scale - share * load(v[i]), p[i]);
        for (int i = 0; i < k; ++i) {
            const Pack v_i = load(v[i]), w_i = load(p[i]);
            for (int j = 0; j <= i; ++j) {
                store(load(row(i)[j]) - (v_i * load(p[j]) + w_i * load(v[j])), row(i)[j]);
            }
        }
    }
    for (int k = 0; k < std::min(m, 2); ++k) store(load(row(k)[k]), batch.diagonal[k]);
    if (m > 1) store(load(row(1)[0]), batch.beside[0]);
}

/// What diagonaliseTridiagonal() is to do next: the rotations of [first, end).
struct Sweep {
    int first, end;
    Pack shift;
};

/// Sets off-diagonal entries that are as good as 0 to 0, and leaves out where all lanes have them.
/// Wilkinson's shift for each lane: the eigenvalue of its first 2 x 2 block that is not done,
/// nearer to the first entry of the two.
HWY_INLINE void planSweep(const Pack& negligible, EigenBatch& batch, Sweep& sweep) {
    const Pack zero = all(0.0);
    Pack beside = zero, upper = zero, lower = zero;
    int first = sweep.end, end = sweep.first;
    for (int i = sweep.end - 1; i >= sweep.first; --i) {
        const Pack e = load(batch.beside[i]);
        const PackMask is_done = absolute(e) < negligible;
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
    const Pack half = (lower - upper) * all(0.5), square = beside * beside;
    const Pack below = half + withSignOf(squareRoot(half * half + square), half);
    sweep = {first, end, upper - zeroIf(below == zero, square / below)};
}

/// One implicit QL sweep. A lane's rotation is the identity, exactly, where its off-diagonal entry
/// is 0, and the chase begins anew above: so a lane never feels how far others are.
HWY_INLINE Rotation* qlSweep(const Sweep& sweep, EigenBatch& batch, Rotation* to) {
    const Pack zero = all(0.0), one = all(1.0);
    Lanes *const diagonal = batch.diagonal.data(), *const beside = batch.beside.data();
    Pack s = one, c = one, p = zero, g = load(diagonal[sweep.end]) - sweep.shift;
    PackMask begins = zero == zero;
    for (int i = sweep.end - 1; i >= sweep.first; --i, ++to) {
        const Pack e = load(beside[i]), d = load(diagonal[i]), below = load(diagonal[i + 1]) - p;
        const PackMask idles = e == zero;
        const Pack f = s * e, b = c * e;
        const Pack r = squareRoot(f * f + g * g);
        store(zeroIf(begins, select(idles, g, r)), beside[i + 1]);
        const PackMask is_identity = idles || r == zero;
        const Pack inverse = one / r;
        s = zeroIf(is_identity, f * inverse);
        c = select(is_identity, one, g * inverse);
        store(c, to->cosine);
        store(s, to->sine);
        to->i = i;
        const Pack t = (d - below) * s + c * (b + b);
        p = s * t;
        store(below + p, diagonal[i + 1]);
        // An idle lane goes on with c = s = 1 and the next diagonal entry, as at the beginning.
        g = c * t - select(idles, sweep.shift - d, b);
        s = select(idles, one, s);
        begins = idles;
    }
    store(load(diagonal[sweep.first]) - p, diagonal[sweep.first]);
    store(zeroIf(begins, g), beside[sweep.first]);
    return to;
}

/// T becomes diagonal, by rotations that are kept; returns how many. Should rounding be in its way,
/// a lane may keep entries beside its diagonal; its vectors are orthonormal all the same. What is
/// taken for 0 is far below what the squares of floats tell.
inline std::size_t diagonaliseTridiagonal(int m, EigenBatch& batch) {
    Pack largest = all(0.0);
    for (int i = 0; i < m; ++i) {
        largest = max(largest, absolute(load(batch.diagonal[i])));
        if (i + 1 < m) largest = max(largest, absolute(load(batch.beside[i])));
    }
    const Pack negligible = largest * all(0x1p-44) + all(1e-300);
    std::size_t rotations = 0;
    Sweep sweep{0, m - 1, all(0.0)};
    for (int sweeps = 0; sweeps < 30 * m; ++sweeps) {
        planSweep(negligible, batch, sweep);
        if (sweep.first >= sweep.end) break;
        if (batch.rotations.size() < rotations + m) batch.rotations.resize(2 * (rotations + m));
        rotations = qlSweep(sweep, batch, &batch.rotations[rotations]) - batch.rotations.data();
    }
    return rotations;
}

/// Unit vectors, in each lane where its `count` smallest (or largest) diagonal entries are.
inline void pickEigenvectors(int m, int count, bool smallest, EigenBatch& batch) {
    const Pack zero = all(0.0), one = all(1.0), taken = all(HUGE_VAL);
    if (!smallest) {
        for (int i = 0; i < m; ++i) store(zero - load(batch.diagonal[i]), batch.diagonal[i]);
    }
    for (int v = 0; v < count; ++v) {
        Pack best = load(batch.diagonal[0]), index = zero;
        for (int i = 1; i < m; ++i) {
            const Pack value = load(batch.diagonal[i]);
            const PackMask is_better = value < best;
            best = select(is_better, value, best);
            index = select(is_better, all(i), index);
        }
        for (int i = 0; i < m; ++i) {
            const PackMask is_it = index == all(i);
            store(select(is_it, one, zero), batch.vectors[v * m + i]);
            store(select(is_it, taken, load(batch.diagonal[i])), batch.diagonal[i]);
        }
    }
}

/// What diagonalised T, undone on the vectors, from the last rotation to the first.
inline void undoRotations(int m, int count, std::size_t rotations, EigenBatch& batch) {
    const Rotation* const first = batch.rotations.data();
    for (const Rotation* rotation = first + rotations; rotation-- != first;) {
        const Pack c = load(rotation->cosine), s = load(rotation->sine);
        for (int v = 0; v < count; ++v) {
            Lanes* const at = batch.vectors.data() + v * m + rotation->i;
            const Pack x = load(at[0]), y = load(at[1]);
            store(c * x + s * y, at[0]);
            store(c * y - s * x, at[1]);
        }
    }
}

/// What made the matrix tridiagonal, undone.
inline void undoReflections(int m, int count, EigenBatch& batch) {
    for (int k = 2; k < m; ++k) {
        const Lanes* const v = &batch.matrix[k * m];
        for (int c = 0; c < count; ++c) {
            Lanes* const y = &batch.vectors[c * m];
            Pack dot = all(0.0);
            for (int i = 0; i < k; ++i) dot = dot + load(v[i]) * load(y[i]);
            dot = dot * load(batch.scale[k]);
            for (int i = 0; i < k; ++i) store(load(y[i]) - dot * load(v[i]), y[i]);
        }
    }
}

/// The orthonormal eigenvectors of the `count` smallest (or largest) eigenvalues of batch.matrix,
/// which is lost, into batch.vectors: by Householder's reduction and the implicit QL method, whose
/// rotations are applied to the wanted vectors alone.
inline void eigenvectors(int m, int count, bool smallest, EigenBatch& batch) {
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
