#pragma once
#include <hagen/range_image/Image.h>
#include <Eigen/Core>

namespace hagen {

/// Stage 7, singular spectrum analysis (section III-D) of each column of angles: the trajectory
/// matrix X (W x K, K = N - W + 1) of a series of N values, its projection onto the
/// `principal_components` (PC) leading eigenvectors of X X^T, and the means along its antidiagonals
/// (hankelization). A series is a run of values without a gap; a run shorter than W stays as it is,
/// and one shorter than W + PC, whose matrix has no more than PC components. PC = W gives the input
/// back.
/// Requires 1 <= PC <= W. Where the eigenvalues PC and PC + 1 coincide, the leading components, and
/// so the result, are not unique; where they do not, it is that of the definition to 2e-4.
/// `smoothed` has the size and the gaps (NaN) of `values`, and must not be it.
void smoothColumns(const Image<float>& values, int window_size, int principal_components,
                   Image<float>& smoothed);

/// What stage 7 sees of one series of N values.
struct SeriesComponents {
    /// W eigenvalues of X X^T, descending; each over their sum is the component's share of X.
    Eigen::VectorXd eigenvalues;
    /// N x W: column c is the elementary series of component c, the hankelized projection of X onto
    /// its eigenvector. The sum of the first PC columns is what smoothColumns() makes of the
    /// series, that of all W is the series.
    Eigen::MatrixXd elementary;
};

/// Requires 1 <= W <= N and a series without a gap.
SeriesComponents decomposeSeries(const Eigen::ArrayXf& series, int window_size);

}  // namespace hagen
