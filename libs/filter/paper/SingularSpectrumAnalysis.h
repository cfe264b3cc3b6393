#pragma once
#include <hagen/scan/Image.h>
#include <Eigen/Core>
#include <cstdint>
#include <vector>
#include "filter/ColumnBits.h"
#include "filter/paper/RunBatch.h"

namespace hagen {

/// Workspace of smoothColumns(). Reuse it between scans to avoid allocations; it has no state.
struct SsaWorkspace {
    /// A sequence of `values` consecutive pixels of a column that all have a value.
    struct Run {
        float* begin;
        int values;
    };

    ColumnBits has_value;
    std::vector<float> seam;
    std::vector<Run> found, runs;     ///< runs in pixel order, and sorted by length
    std::vector<int> next_of_length;  ///< for each length, index of the next run in `runs`
    RunBatch<float> floats;
    RunBatch<double> doubles;
};

/// Stage 7, singular spectrum analysis (section III-D) of each column of angles: the trajectory
/// matrix X (W x K, K = N - W + 1) of a series of N values, its projection onto the
/// `principal_components` (PC) leading eigenvectors of X X^T, and the means along its antidiagonals
/// (hankelization). A series is a run of values without a gap. A run shorter than W + PC is not
/// changed: its matrix has at most PC components, or does not exist. PC = W returns the input.
/// Requires 1 <= PC <= W. If the eigenvalues PC and PC + 1 coincide, the leading components, and
/// therefore the result, are not unique; otherwise the result matches the definition to 2e-4.
/// `smoothed` gets the size and the gaps (NaN) of `values`, and must not be the same image.
void smoothColumns(const Image<float>& values, int window_size, int principal_components,
                   Image<float>& smoothed, SsaWorkspace& work);

/// The components of one series of N values, as in stage 7.
struct SeriesComponents {
    /// W eigenvalues of X X^T, descending; a component's share of X is its eigenvalue divided by
    /// their sum.
    Eigen::VectorXd eigenvalues;
    /// N x W: column c is the elementary series of component c, the hankelized projection of X onto
    /// its eigenvector. The sum of the first PC columns is the result of smoothColumns(), the sum
    /// of all W columns is the series.
    Eigen::MatrixXd elementary;
};

/// Requires 1 <= W <= N and a series without gaps.
SeriesComponents decomposeSeries(const Eigen::ArrayXf& series, int window_size);

}  // namespace hagen
