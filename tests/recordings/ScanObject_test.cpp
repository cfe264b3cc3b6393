#include "recordings/ScanObject.h"
#include <gtest/gtest.h>
#include <hagen/mrpt/MrptCompat.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <new>

namespace hagen::recordings {
namespace {

using mrpt::obs::CObservationPointCloud;
using observations::CloudClass;

CObservationPointCloud::Ptr cloudOf(std::size_t points) {
    auto cloud = CObservationPointCloud::Create();
    auto with_intensity = std::make_shared<observations::IntensityCloud>();
    with_intensity->setSize(points);
    for (std::size_t i = 0; i < points; ++i) {
        const auto x_m = static_cast<float>(i);
        with_intensity->setPointFast(i, x_m, x_m + 0.25f, -x_m);
    }
    cloud->pointcloud = with_intensity;
    return cloud;
}

TEST(ScanObject, CopiesPointsToSimpleCloud) {
    const auto cloud = cloudOf(3);
    const auto object = objectOf(cloud, CloudClass::Simple);
    const auto simple = std::dynamic_pointer_cast<CObservationPointCloud>(object);
    ASSERT_TRUE(simple);
    EXPECT_STREQ(simple->pointcloud->GetRuntimeClass()->className, "mrpt::maps::CSimplePointsMap");
    ASSERT_EQ(simple->pointcloud->size(), 3u);
    float x_m, y_m, z_m;
    simple->pointcloud->getPoint(2, x_m, y_m, z_m);
    EXPECT_EQ(x_m, 2);
    EXPECT_EQ(y_m, 2.25f);
    EXPECT_EQ(z_m, -2);
    EXPECT_NE(simple->pointcloud, cloud->pointcloud);
    EXPECT_EQ(objectOf(cloud, std::nullopt), nullptr);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they reserve all memory
/// Without memory, MRPT's clouds would crash.
TEST(ScanObjectDeathTest, ThrowsWithoutMemory) {
    const auto cloud = cloudOf(1 << 20);
    const auto copyWithLittleMemory = [&] {
        std::size_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        const rlim_t limit = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (1 << 20);
        const rlimit memory{limit, limit};
        if (setrlimit(RLIMIT_AS, &memory) != 0) std::_Exit(2);
        try {
            objectOf(cloud, CloudClass::Simple);
        } catch (const std::bad_alloc&) {
            std::_Exit(0);
        }
        std::_Exit(3);
    };
    EXPECT_EXIT(copyWithLittleMemory(), testing::ExitedWithCode(0), "");
}
#endif

}  // namespace
}  // namespace hagen::recordings
