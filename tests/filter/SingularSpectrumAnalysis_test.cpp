#include "filter/paper/SingularSpectrumAnalysis.h"
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "support/InstructionSets.h"
#include "support/Random.h"

namespace hagen {
namespace {

Image<float> smoothed(const Image<float>& values, int window_size, int principal_components) {
    static SsaWorkspace work;  // reused, as in a filter
    Image<float> result;
    smoothColumns(values, window_size, principal_components, result, work);
    return result;
}

/// Textbook singular spectrum analysis: singular value decomposition of the whole trajectory
/// matrix, sum of the leading elementary matrices, mean of each antidiagonal. `gap` is the relative
/// difference (to the largest) of the eigenvalues on both sides of the cut.
Eigen::ArrayXd oracle(const Eigen::VectorXd& series, int window_size, int principal_components,
                      double& gap) {
    const int n = static_cast<int>(series.size()), k = n - window_size + 1;
    Eigen::MatrixXd trajectory(window_size, k);
    for (int i = 0; i < window_size; ++i) {
        for (int j = 0; j < k; ++j) trajectory(i, j) = series(i + j);
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(trajectory,
                                                Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::VectorXd values = svd.singularValues().cwiseAbs2();
    gap = principal_components >= values.size()
              ? 1.0
              : (values(principal_components - 1) - values(principal_components)) / values(0);
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

/// Maximum error of a result, and of a result whose eigenvalues on both sides of the cut differ by
/// at least 1e-3 of the largest.
constexpr double kSsaTolerance = 2e-4, kAccuracy = 1e-4 / 3;

/// Typical columns: noise, constants, ramps, steps, walls above ground, waves or few distinct
/// values; some have gaps.
Image<float> realLike(test::Random& random, int rows, int columns) {
    Image<float> image(rows, columns);
    for (int column = 0; column < columns; ++column) {
        const int kind = random.whole(0, 6), edge = random.whole(0, rows);
        const float level = random.real(0, 1.5f), noise = random.chance(0.5) ? 0.01f : 0.0f;
        for (int row = 0; row < rows; ++row) {
            const float at = static_cast<float>(row) / static_cast<float>(rows);
            const float shape[] = {random.real(0, 1.57f),
                                   level,
                                   level * at,
                                   row < edge ? 0.1f : level,
                                   row < edge ? 0.02f : 1.57f,
                                   0.7f + 0.5f * std::sin(level * static_cast<float>(row)),
                                   0.4f * static_cast<float>(random.whole(0, 3))};
            image(row, column) = shape[kind] + noise * random.real(-1, 1);
        }
        if (random.chance(0.3)) image(random.whole(0, rows - 1), column) = kNoValue;
    }
    return image;
}

/// Visits the runs of values of a column: visit(first row, values).
template <class Column, class Visit>
void forEachRun(const Column& column, Visit visit) {
    for (int row = 0, end; row < column.size(); row = end + 1) {
        for (end = row; end < column.size() && hasValue(column(end));) ++end;
        if (end > row) visit(row, end - row);
    }
}

TEST(Ssa, MatchesDenseSvd) {
    test::Random random(18);
    int clear = 0, unclear = 0;
    for (const int rows : {2, 7, 8, 13, 15, 16, 31, 63}) {
        for (const int window_size : {2, 3, 5, 8, 12, 16}) {
            if (window_size > rows) continue;
            const Image<float> values = realLike(random, rows, 21);
            for (const int components :
                 {1, window_size / 2, window_size * 5 / 8, window_size - 1}) {
                if (components < 1) continue;
                const Image<float> found = smoothed(values, window_size, components);
                ASSERT_TRUE((found.isNaN() == values.isNaN()).all());
                for (int column = 0; column < values.cols(); ++column) {
                    forEachRun(values.col(column), [&](int first, int count) {
                        const auto run = found.col(column).segment(first, count);
                        const auto was = values.col(column).segment(first, count);
                        if (count < window_size) {
                            EXPECT_TRUE((run == was).all());
                            return;
                        }
                        double gap = 0;
                        const Eigen::ArrayXd expected =
                            oracle(was.cast<double>(), window_size, components, gap);
                        if (!(gap > 1e-9)) return;
                        ++(gap > 1e-3 ? clear : unclear);
                        EXPECT_LT((run.cast<double>() - expected).abs().maxCoeff(),
                                  gap > 1e-3 ? kAccuracy : kSsaTolerance)
                            << count << " values, W " << window_size << ", PC " << components
                            << ", gap " << gap;
                    });
                }
            }
        }
    }
    EXPECT_GT(clear, 1500);
    EXPECT_GT(unclear, 150);
}

TEST(Ssa, SmoothsRunsIndependently) {
    test::Random random(20);
    for (const int rows : {13, 14, 15, 40}) {
        const Image<float> values = realLike(random, rows, 50);
        const Image<float> together = smoothed(values, 8, 5);
        for (int column = 0; column < values.cols(); ++column) {
            ASSERT_TRUE(test::same(smoothed(values.col(column), 8, 5), together.col(column)));
        }
    }
}

TEST(Ssa, IsSameOnEveryInstructionSet) {
    test::Random random(21);
    for (const auto& [rows, window_size, components] :
         {std::tuple{15, 8, 5}, {14, 8, 5}, {31, 8, 2}, {63, 16, 10}, {40, 20, 3}}) {
        const Image<float> values = realLike(random, rows, 45);
        const Image<float> expected = smoothed(values, window_size, components);
        forEachInstructionSet([&, w = window_size, c = components](const std::string& name) {
            EXPECT_TRUE(test::same(smoothed(values, w, c), expected)) << name;
        });
    }
}

TEST(Ssa, StaysFiniteForExtremeValues) {
    test::Random random(22);
    for (const float scale : {1e-38f, 1e-20f, 1e15f}) {
        const Image<float> values = realLike(random, 31, 60) * scale;
        const Image<float> found = smoothed(values, 8, 5);
        ASSERT_TRUE((found.isNaN() == values.isNaN()).all());
        ASSERT_LE(found.isNaN().select(0.0f, found.abs()).maxCoeff(), 10 * scale);
    }
    // If values repeat, eigenvalues coincide and matrices decompose into blocks.
    for (int round = 0; round < 50; ++round) {
        Image<float> values = random.image(random.whole(9, 40), 40, 0, 1, 0.02);
        const float min = 0.1f * static_cast<float>(round % 7);
        for (float& value : values.reshaped()) value = value < min ? 0.0f : value;
        if (round % 2) values = values.isNaN().select(values, values.round());
        const Image<float> found = smoothed(values, 8, random.whole(1, 7));
        ASSERT_TRUE((found.isNaN() == values.isNaN()).all());
        ASSERT_LE(found.isNaN().select(0.0f, found.abs()).maxCoeff(), 10);
    }
}

TEST(Ssa, AcceptsLongWindows) {
    test::Random random(23);
    const Image<float> values = random.image(127, 9, 0, 1.57f, 0.0);
    for (const int window_size : {64, 126}) {
        double gap = 0;
        const Image<float> found = smoothed(values, window_size, 1);
        const Eigen::ArrayXd expected = oracle(values.col(3).cast<double>(), window_size, 1, gap);
        EXPECT_GT(gap, 1e-3);
        EXPECT_LT((found.col(3).cast<double>() - expected).abs().maxCoeff(), 1e-6);
    }
}

TEST(Ssa, AllComponentsYieldIdentity) {
    test::Random random(14);
    const Image<float> values = random.image(15, 30, 0.0f, 1.6f, 0.1);
    EXPECT_TRUE(test::same(smoothed(values, 8, 8), values));
}

TEST(Ssa, KeepsZerosAndEmptyPixels) {
    EXPECT_TRUE((smoothed(Image<float>::Zero(15, 4), 8, 5) == 0.0f).all());
    EXPECT_TRUE(smoothed(Image<float>::Constant(15, 4, kNoValue), 8, 5).isNaN().all());
}

TEST(Ssa, LeadingElementarySeriesSumToSmoothed) {
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
                          kSsaTolerance);
            }
            for (int c = 1; c < window_size; ++c) {
                EXPECT_GE(found.eigenvalues(c - 1), found.eigenvalues(c));
            }
        }
    }
}

TEST(Ssa, ConstantSeriesIsFirstComponent) {
    const SeriesComponents found = decomposeSeries(Eigen::ArrayXf::Constant(15, 1.5f), 8);
    EXPECT_NEAR(found.eigenvalues(0) / found.eigenvalues.sum(), 1.0, 1e-9);
    EXPECT_LT((found.elementary.col(0).array() - 1.5).abs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace hagen
