#pragma once
#include <hagen/range_image/Image.h>

namespace hagen {

/// Stage 7, singular spectrum analysis (section III-D) of each column of angles: the trajectory
/// matrix X (W x K, K = N - W + 1) of a series of N values, its projection onto the
/// `principal_components` (PC) leading eigenvectors of X X^T, and the means along its antidiagonals
/// (hankelization). A series is a run of values without a gap; a run shorter than W stays as it is.
/// PC = W gives the input back.
/// Requires 1 <= PC <= W. Where the eigenvalues PC and PC + 1 coincide, the leading components, and
/// so the result, are not unique. `smoothed` has the size and the gaps (NaN) of `values`, and must
/// not be it.
void smoothColumns(const Image<float>& values, int window_size, int principal_components,
                   Image<float>& smoothed);

}  // namespace hagen
