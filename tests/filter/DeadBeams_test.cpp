#include "filter/image/DeadBeams.h"
#include <gtest/gtest.h>
#include <hagen/scan/SensorModel.h>

#include <cmath>

#include "support/Random.h"

namespace hagen {
namespace {

const SensorModel kSensor = sensorModel("VLP-16");
const PixelDirections kDirections = pixelDirections(kSensor, 40);

/// The depth of a plane `height_m` below the sensor; NaN for beams that miss it.
Image<float> planeDepth(float height_m) {
    Image<float> depth_m = Image<float>::Constant(kSensor.rows(), 40, kNoValue);
    for (int row = 0; row < kSensor.rows(); ++row) {
        const float sine = kDirections.row_sine[row];
        if (sine < 0) depth_m.row(row) = -height_m / sine;
    }
    return depth_m;
}

Image<float> bridged(const Image<float>& depth_m) {
    static DeadBeamsWorkspace work;
    Image<float> repaired_m = depth_m;
    bridgeDeadBeams(depth_m, kDirections, repaired_m, work);
    return repaired_m;
}

TEST(DeadBeams, FillsPlaneWhereBeamMeetsIt) {
    const Image<float> whole_m = planeDepth(2);
    for (const int row : {1, 2, 5}) {
        Image<float> depth_m = whole_m;
        depth_m.row(row) = kNoValue;
        EXPECT_LT((bridged(depth_m).row(row) - whole_m.row(row)).abs().maxCoeff(), 1e-4f) << row;
        depth_m.row(row + 1) = kNoValue;
        const Image<float> result_m = bridged(depth_m);
        EXPECT_LT((result_m.row(row) - whole_m.row(row)).abs().maxCoeff(), 1e-4f) << row;
        EXPECT_LT((result_m.row(row + 1) - whole_m.row(row + 1)).abs().maxCoeff(), 1e-4f) << row;
    }
}

TEST(DeadBeams, SingleReturnMakesRowLive) {
    Image<float> depth_m = planeDepth(2);
    depth_m.row(3) = kNoValue;
    depth_m(3, 17) = 9;
    const Image<float> result_m = bridged(depth_m);
    EXPECT_EQ(result_m(3, 17), 9);
    EXPECT_EQ(result_m.row(3).isNaN().count(), 39);
}

TEST(DeadBeams, LeavesEdgesAndWideGapsEmpty) {
    Image<float> depth_m = planeDepth(2);
    depth_m.row(0) = kNoValue;
    for (const int row : {3, 4, 5}) depth_m.row(row) = kNoValue;
    const Image<float> result_m = bridged(depth_m);
    for (const int row : {0, 3, 4, 5, 12}) EXPECT_TRUE(result_m.row(row).isNaN().all()) << row;
}

TEST(DeadBeams, NeedsBothNeighbours) {
    Image<float> depth_m = planeDepth(2);
    depth_m.row(3) = kNoValue;
    depth_m(2, 5) = depth_m(4, 6) = kNoValue;
    const Image<float> result_m = bridged(depth_m);
    EXPECT_TRUE(std::isnan(result_m(3, 5)) && std::isnan(result_m(3, 6)));
    EXPECT_EQ(result_m.row(3).isNaN().count(), 2);
}

}  // namespace
}  // namespace hagen
