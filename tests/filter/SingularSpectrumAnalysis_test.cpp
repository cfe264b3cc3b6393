#include "filter/paper/SingularSpectrumAnalysis.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>

#include "support/InstructionSets.h"
#include "support/Random.h"

namespace hagen {
namespace {

Image<float> smoothed(const Image<float>& values, int window_size, int principal_components) {
    static SsaWorkspace work;  // shared by all tests, as by all scans in a filter
    Image<float> result;
    smoothColumns(values, window_size, principal_components, result, work);
    return result;
}

/// Textbook singular spectrum analysis: singular value decomposition of the whole trajectory
/// matrix, sum of the leading elementary matrices, mean of every antidiagonal.
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

/// Maximum error of a result, and of results for which the eigenvalues on both sides of the cut
/// differ by at least 1e-3 of the greatest one.
constexpr double kTolerance = 2e-4, kAccuracy = 1e-4 / 3;

/// One run at a time, by the eigenvectors of X X^T: the definition in the header. `gap` is the
/// difference of the eigenvalues on both sides of the cut, relative to the greatest one.
Eigen::ArrayXd plainSmoothed(const Eigen::ArrayXd& series, int window_size,
                             int principal_components, double& gap) {
    const Eigen::Index columns = series.size() - window_size + 1;
    Eigen::MatrixXd trajectory(window_size, columns);
    for (Eigen::Index k = 0; k < columns; ++k) trajectory.col(k) = series.segment(k, window_size);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(trajectory *
                                                                trajectory.transpose());
    const Eigen::VectorXd values = solver.eigenvalues().reverse();
    gap = principal_components >= std::min<Eigen::Index>(window_size, columns)
              ? 1.0
              : (values(principal_components - 1) - values(principal_components)) / values(0);
    const auto kept = solver.eigenvectors().rightCols(principal_components);
    const Eigen::MatrixXd projection = kept * (kept.transpose() * trajectory);
    Eigen::ArrayXd smooth(series.size());
    for (Eigen::Index n = 0; n < series.size(); ++n) {
        const Eigen::Index first = std::max<Eigen::Index>(0, n - columns + 1);
        const Eigen::Index last = std::min<Eigen::Index>(n, window_size - 1);
        double sum = 0;
        for (Eigen::Index w = first; w <= last; ++w) sum += projection(w, n - w);
        smooth(n) = sum / static_cast<double>(last - first + 1);
    }
    return smooth;
}

/// Typical columns: noise, constants, ramps, steps, walls above ground, waves, few distinct values;
/// some with gaps.
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

TEST(Ssa, ManyRunsAtOnceAreSmoothedAsEachByItself) {
    test::Random random(18);
    int clear = 0, unclear = 0;
    for (const int rows : {2, 7, 8, 13, 15, 16, 31, 63, 127}) {
        for (const int window_size : {2, 3, 5, 8, 12, 16}) {
            if (window_size > rows) continue;
            const Image<float> values = realLike(random, rows, 37);
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
                            plainSmoothed(was.cast<double>(), window_size, components, gap);
                        if (!(gap > 1e-9)) return;
                        ++(gap > 1e-3 ? clear : unclear);
                        EXPECT_LT((run.cast<double>() - expected).abs().maxCoeff(),
                                  gap > 1e-3 ? kAccuracy : kTolerance)
                            << count << " values, W " << window_size << ", PC " << components
                            << ", gap " << gap;
                    });
                }
            }
        }
    }
    EXPECT_GT(clear, 4000);
    EXPECT_GT(unclear, 500);
}

TEST(Ssa, ARunDoesNotFeelItsNeighbours) {
    test::Random random(20);
    for (const int rows : {13, 14, 15, 40}) {
        const Image<float> values = realLike(random, rows, 50);
        const Image<float> together = smoothed(values, 8, 5);
        for (int column = 0; column < values.cols(); ++column) {
            ASSERT_TRUE(test::same(smoothed(values.col(column), 8, 5), together.col(column)));
        }
    }
}

TEST(Ssa, IsTheSameOnEveryInstructionSet) {
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

TEST(Ssa, IsFiniteWhateverTheValues) {
    test::Random random(22);
    for (const float scale : {1e-38f, 1e-20f, 1e15f}) {
        const Image<float> values = realLike(random, 31, 60) * scale;
        const Image<float> found = smoothed(values, 8, 5);
        ASSERT_TRUE((found.isNaN() == values.isNaN()).all());
        ASSERT_LE(found.isNaN().select(0.0f, found.abs()).maxCoeff(), 10 * scale);
    }
    // Few values: eigenvalues coincide, matrices decompose into blocks.
    for (int round = 0; round < 50; ++round) {
        Image<float> values = random.image(random.whole(9, 40), 40, 0, 1, 0.02);
        const float least = 0.1f * static_cast<float>(round % 7);
        for (float& value : values.reshaped()) value = value < least ? 0.0f : value;
        if (round % 2) values = values.isNaN().select(values, values.round());
        const Image<float> found = smoothed(values, 8, random.whole(1, 7));
        ASSERT_TRUE((found.isNaN() == values.isNaN()).all());
        ASSERT_LE(found.isNaN().select(0.0f, found.abs()).maxCoeff(), 10);
    }
}

TEST(Ssa, WindowsAsLongAsTheColumnAllows) {
    test::Random random(23);
    const Image<float> values = random.image(127, 9, 0, 1.57f, 0.0);
    for (const int window_size : {64, 126}) {
        double gap = 0;
        const Image<float> found = smoothed(values, window_size, 1);
        const Eigen::ArrayXd expected =
            plainSmoothed(values.col(3).cast<double>(), window_size, 1, gap);
        EXPECT_GT(gap, 1e-3);
        EXPECT_LT((found.col(3).cast<double>() - expected).abs().maxCoeff(), 1e-6);
    }
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
                    ASSERT_NEAR(found(row, column), expected(row), kAccuracy);
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
    // A run of 9 values has an 8 x 2 trajectory matrix: two components contain all of it.
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
                          kTolerance);
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
