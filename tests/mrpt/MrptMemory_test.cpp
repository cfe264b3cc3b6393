#include <gtest/gtest.h>
#include <hagen/mrpt/MrptCompat.h>
#include <mrpt/core/aligned_allocator.h>

#include <cstdint>
#include <new>

namespace hagen::observations {
namespace {

TEST(MrptMemory, ThrowsWhenExhausted) {
    constexpr std::size_t kPoints = std::size_t{1} << 45;
    EXPECT_THROW(PortableCloud().setSize(kPoints), std::bad_alloc);
    EXPECT_THROW(IntensityCloud().setSize(kPoints), std::bad_alloc);
}

TEST(MrptMemory, AlignsAndClearsBlocks) {
    for (const std::size_t alignment : {1, 16, 32, 64}) {
        for (const std::size_t size : {0, 1, 33, 4096}) {
            auto* const bytes = static_cast<unsigned char*>(mrpt::aligned_calloc(size, alignment));
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(bytes) % alignment, 0u);
            for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(bytes[i], 0);
            mrpt::aligned_free(bytes);
        }
    }
}

}  // namespace
}  // namespace hagen::observations
