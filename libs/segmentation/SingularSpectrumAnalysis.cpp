#include <hagen/segmentation/SingularSpectrumAnalysis.h>
#include <Eigen/Dense>

namespace hagen {
namespace {

/// Smooths one series in place.
class Ssa {
 public:
    Ssa(int window_size, int principal_components)
        : window_size_(window_size), principal_components_(principal_components) {}

    void smooth(Eigen::Ref<Eigen::ArrayXf> series) {
        const Eigen::Index columns = series.size() - window_size_ + 1;
        trajectory_.resize(window_size_, columns);
        for (Eigen::Index k = 0; k < columns; ++k) {
            trajectory_.col(k) = series.segment(k, window_size_).matrix().cast<double>();
        }
        covariance_.noalias() = trajectory_ * trajectory_.transpose();
        solver_.compute(covariance_);  // eigenvalues ascending, eigenvectors in columns
        const auto leading = solver_.eigenvectors().rightCols(principal_components_);
        scores_.noalias() = leading.transpose() * trajectory_;
        trajectory_.noalias() = leading * scores_;
        hankelize(series);
    }

 private:
    /// Value n becomes the mean of the n-th antidiagonal, the entries (w, n - w).
    void hankelize(Eigen::Ref<Eigen::ArrayXf> series) const {
        for (Eigen::Index n = 0; n < series.size(); ++n) {
            const Eigen::Index first = std::max<Eigen::Index>(0, n - trajectory_.cols() + 1);
            const Eigen::Index last = std::min<Eigen::Index>(n, window_size_ - 1);
            double sum = 0.0;
            for (Eigen::Index w = first; w <= last; ++w) sum += trajectory_(w, n - w);
            series(n) = static_cast<float>(sum / static_cast<double>(last - first + 1));
        }
    }

    int window_size_, principal_components_;
    Eigen::MatrixXd trajectory_, covariance_, scores_;
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver_;
};

}  // namespace

void smoothColumns(const Image<float>& values, int window_size, int principal_components,
                   Image<float>& smoothed) {
    smoothed = values;
    if (principal_components == window_size) return;
    Ssa ssa(window_size, principal_components);
    const int rows = static_cast<int>(values.rows());
    for (int column = 0; column < values.cols(); ++column) {
        for (int row = 0; row < rows;) {
            int end = row;
            while (end < rows && hasValue(values(end, column))) ++end;
            if (end - row >= window_size) ssa.smooth(smoothed.col(column).segment(row, end - row));
            row = end + 1;
        }
    }
}

}  // namespace hagen
