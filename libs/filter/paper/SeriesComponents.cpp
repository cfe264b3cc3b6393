#include <Eigen/Dense>
#include "filter/paper/SingularSpectrumAnalysis.h"

namespace hagen {
namespace {

/// Returns the means of the antidiagonals; the n-th antidiagonal has the entries (w, n - w).
Eigen::VectorXd antidiagonalMeans(const Eigen::MatrixXd& matrix) {
    Eigen::VectorXd means(matrix.rows() + matrix.cols() - 1);
    for (Eigen::Index n = 0; n < means.size(); ++n) {
        const Eigen::Index first = std::max<Eigen::Index>(0, n - matrix.cols() + 1);
        const Eigen::Index last = std::min<Eigen::Index>(n, matrix.rows() - 1);
        double sum = 0.0;
        for (Eigen::Index w = first; w <= last; ++w) sum += matrix(w, n - w);
        means(n) = sum / static_cast<double>(last - first + 1);
    }
    return means;
}

}  // namespace

SeriesComponents decomposeSeries(const Eigen::ArrayXf& series, int window_size) {
    const Eigen::Index columns = series.size() - window_size + 1;
    Eigen::MatrixXd trajectory(window_size, columns);
    for (Eigen::Index k = 0; k < columns; ++k) {
        trajectory.col(k) = series.segment(k, window_size).matrix().cast<double>();
    }
    // The solver sorts eigenvalues in ascending order; eigenvectors are columns.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(trajectory *
                                                                trajectory.transpose());
    SeriesComponents components;
    components.eigenvalues = solver.eigenvalues().reverse();
    components.elementary.resize(series.size(), window_size);
    for (int c = 0; c < window_size; ++c) {
        const Eigen::VectorXd vector = solver.eigenvectors().col(window_size - 1 - c);
        const Eigen::RowVectorXd scores = vector.transpose() * trajectory;
        components.elementary.col(c) = antidiagonalMeans(vector * scores);
    }
    return components;
}

}  // namespace hagen
