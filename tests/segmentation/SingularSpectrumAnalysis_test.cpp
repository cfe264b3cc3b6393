#include <gtest/gtest.h>
#include <hagen/range_image/Angle.h>
#include <hagen/segmentation/SingularSpectrumAnalysis.h>

#include <Eigen/SVD>
#include <cmath>

#include "support/Random.h"

namespace hagen {
namespace {

Image<float> smoothed(const Image<float>& values, int window_size, int principal_components) {
    Image<float> result;
    smoothColumns(values, window_size, principal_components, result);
    return result;
}

/// Singular spectrum analysis by the book: singular value decomposition of the whole trajectory
/// matrix, the sum of the leading elementary matrices, the mean of every antidiagonal.
Eigen::VectorXd oracle(const Eigen::VectorXd& series, int window_size, int principal_components) {
    const int n = static_cast<int>(series.size()), k = n - window_size + 1;
    Eigen::MatrixXd trajectory(window_size, k);
    for (int i = 0; i < window_size; ++i) {
        for (int j = 0; j < k; ++j) trajectory(i, j) = series(i + j);
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(trajectory,
                                                Eigen::ComputeThinU | Eigen::ComputeThinV);
    Eigen::MatrixXd leading = Eigen::MatrixXd::Zero(window_size, k);
    const int components =
        std::min(principal_components, static_cast<int>(svd.singularValues().size()));
    for (int c = 0; c < components; ++c) {
        leading +=
            svd.singularValues()(c) * svd.matrixU().col(c) * svd.matrixV().col(c).transpose();
    }
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(n), counts = Eigen::VectorXd::Zero(n);
    for (int i = 0; i < window_size; ++i) {
        for (int j = 0; j < k; ++j) {
            sums(i + j) += leading(i, j);
            counts(i + j) += 1;
        }
    }
    return sums.cwiseQuotient(counts);
}

/// Whether the eigenvalues on both sides of the cut differ enough for the result to be defined.
bool isDefined(const Eigen::VectorXd& series, int window_size, int principal_components) {
    const int k = static_cast<int>(series.size()) - window_size + 1;
    Eigen::MatrixXd trajectory(window_size, k);
    for (int i = 0; i < window_size; ++i) {
        for (int j = 0; j < k; ++j) trajectory(i, j) = series(i + j);
    }
    const Eigen::VectorXd values =
        Eigen::JacobiSVD<Eigen::MatrixXd>(trajectory).singularValues().cwiseAbs2();
    if (principal_components >= values.size()) return true;
    return values(principal_components - 1) - values(principal_components) > 1e-3 * values(0);
}

TEST(Ssa, AgreesWithADenseSingularValueDecomposition) {
    test::Random random(13);
    int compared = 0;
    for (const auto& [rows, window_size] : {std::pair{15, 8}, {31, 8}, {63, 8}, {63, 16}, {8, 8}}) {
        const Image<float> values = random.image(rows, 40, 0.0f, 1.6f, 0.0);
        for (const int components : {1, 2, 4, 5, window_size - 1}) {
            const Image<float> found = smoothed(values, window_size, components);
            for (int column = 0; column < values.cols(); ++column) {
                const Eigen::VectorXd series = values.col(column).cast<double>();
                if (!isDefined(series, window_size, components)) continue;
                const Eigen::VectorXd expected = oracle(series, window_size, components);
                for (int row = 0; row < rows; ++row) {
                    ASSERT_NEAR(found(row, column), expected(row), 1e-5);
                }
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 500);
}

TEST(Ssa, AsManyComponentsAsTheWindowIsTheIdentity) {
    test::Random random(14);
    const Image<float> values = random.image(15, 30, 0.0f, 1.6f, 0.1);
    EXPECT_TRUE(test::same(smoothed(values, 8, 8), values));
}

TEST(Ssa, WithoutTheShortCutAllComponentsAreTheIdentityToo) {
    // A run of 9 values has a trajectory matrix of 8 x 2: two components hold all of it.
    test::Random random(15);
    const Image<float> values = random.image(9, 30, 0.0f, 1.6f, 0.0);
    EXPECT_LT((smoothed(values, 8, 2) - values).abs().maxCoeff(), 1e-6f);
}

TEST(Ssa, ASteadySlopeAndAConstantPassThrough) {
    Image<float> values(15, 2);
    for (int row = 0; row < 15; ++row) values.row(row) << 0.7f, 0.05f * static_cast<float>(row);
    EXPECT_LT((smoothed(values, 8, 2) - values).abs().maxCoeff(), 1e-6f);
}

TEST(Ssa, TakesNoiseOutOfASine) {
    test::Random random(16);
    double before = 0, after = 0;
    for (int round = 0; round < 20; ++round) {
        Image<float> clean(63, 1);
        for (int row = 0; row < 63; ++row) clean(row, 0) = std::sin(0.3f * static_cast<float>(row));
        const Image<float> noisy = clean + random.image(63, 1, -0.2f, 0.2f, 0.0);
        before += (noisy - clean).matrix().squaredNorm();
        after += (smoothed(noisy, 16, 2) - clean).matrix().squaredNorm();
    }
    EXPECT_LT(after, 0.35 * before);
}

TEST(Ssa, EachRunBetweenGapsIsASeriesOfItsOwn) {
    test::Random random(17);
    Image<float> values = random.image(63, 1, 0.0f, 1.6f, 0.0);
    values(0, 0) = values(20, 0) = values(28, 0) = kNoValue;  // runs of 19, 7 and 34
    const Image<float> found = smoothed(values, 8, 3);
    const Eigen::VectorXd low = oracle(values.col(0).segment(1, 19).cast<double>(), 8, 3);
    const Eigen::VectorXd high = oracle(values.col(0).segment(29, 34).cast<double>(), 8, 3);
    for (int i = 0; i < 19; ++i) EXPECT_NEAR(found(1 + i, 0), low(i), 1e-5);
    for (int i = 0; i < 34; ++i) EXPECT_NEAR(found(29 + i, 0), high(i), 1e-5);
    for (int row = 21; row < 28; ++row) EXPECT_EQ(found(row, 0), values(row, 0));  // shorter than W
    for (const int row : {0, 20, 28}) EXPECT_FALSE(hasValue(found(row, 0)));
}

TEST(Ssa, AllZerosAndAllEmptyStaySo) {
    EXPECT_TRUE((smoothed(Image<float>::Zero(15, 4), 8, 5) == 0.0f).all());
    EXPECT_TRUE(smoothed(Image<float>::Constant(15, 4, kNoValue), 8, 5).isNaN().all());
}

TEST(Ssa, TheLeadingElementarySeriesAddUpToWhatSmoothingGives) {
    test::Random random(19);
    for (const auto& [rows, window_size] : {std::pair{15, 8}, {31, 8}, {8, 8}, {20, 3}}) {
        const Image<float> values = random.image(rows, 10, 0.0f, 1.6f, 0.0);
        for (int column = 0; column < values.cols(); ++column) {
            const SeriesComponents found = decomposeSeries(values.col(column), window_size);
            const Eigen::VectorXd all = found.elementary.rowwise().sum();
            EXPECT_LT((all.array() - values.col(column).cast<double>()).abs().maxCoeff(), 1e-6);
            for (int components = 1; components < window_size; ++components) {
                const Eigen::VectorXd sum = found.elementary.leftCols(components).rowwise().sum();
                const Image<float> expected = smoothed(values, window_size, components);
                EXPECT_LT((sum.array() - expected.col(column).cast<double>()).abs().maxCoeff(),
                          1e-6);
            }
            for (int c = 1; c < window_size; ++c) {
                EXPECT_GE(found.eigenvalues(c - 1), found.eigenvalues(c));
            }
        }
    }
}

TEST(Ssa, AConstantSeriesIsItsFirstComponent) {
    const SeriesComponents found = decomposeSeries(Eigen::ArrayXf::Constant(15, 1.5f), 8);
    EXPECT_NEAR(found.eigenvalues(0) / found.eigenvalues.sum(), 1.0, 1e-9);
    EXPECT_LT((found.elementary.col(0).array() - 1.5).abs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace hagen
