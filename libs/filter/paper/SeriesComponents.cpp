#include <hagen/filter/SingularSpectrumAnalysis.h>
#include <Eigen/Dense>

namespace hagen {
namespace {

/// Analyses one series after another in the same memory.
class Ssa {
 public:
    explicit Ssa(int window_size) : window_size_(window_size) {}

    void decompose(const Eigen::Ref<const Eigen::ArrayXf>& series) {
        const Eigen::Index columns = series.size() - window_size_ + 1;
        trajectory_.resize(window_size_, columns);
        for (Eigen::Index k = 0; k < columns; ++k) {
            trajectory_.col(k) = series.segment(k, window_size_).matrix().cast<double>();
        }
        covariance_.noalias() = trajectory_ * trajectory_.transpose();
        solver_.compute(covariance_);  // eigenvalues ascending, eigenvectors in columns
    }

    /// The series of `count` components from `first` on (0: the leading one).
    template <class Series>
    void reconstruct(int first, int count, Series series) {
        const auto kept = solver_.eigenvectors().middleCols(window_size_ - first - count, count);
        scores_.noalias() = kept.transpose() * trajectory_;
        projection_.noalias() = kept * scores_;
        hankelize(series);
    }

    auto eigenvalues() const { return solver_.eigenvalues().reverse(); }

 private:
    /// Value n is the mean of the n-th antidiagonal, the entries (w, n - w).
    template <class Series>
    void hankelize(Series& series) const {
        for (Eigen::Index n = 0; n < series.size(); ++n) {
            const Eigen::Index first = std::max<Eigen::Index>(0, n - projection_.cols() + 1);
            const Eigen::Index last = std::min<Eigen::Index>(n, window_size_ - 1);
            double sum = 0.0;
            for (Eigen::Index w = first; w <= last; ++w) sum += projection_(w, n - w);
            series(n) =
                static_cast<typename Series::Scalar>(sum / static_cast<double>(last - first + 1));
        }
    }

    int window_size_;
    Eigen::MatrixXd trajectory_, covariance_, scores_, projection_;
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver_;
};

}  // namespace

SeriesComponents decomposeSeries(const Eigen::ArrayXf& series, int window_size) {
    Ssa ssa(window_size);
    ssa.decompose(series);
    SeriesComponents components;
    components.eigenvalues = ssa.eigenvalues();
    components.elementary.resize(series.size(), window_size);
    for (int c = 0; c < window_size; ++c) ssa.reconstruct(c, 1, components.elementary.col(c));
    return components;
}

}  // namespace hagen
