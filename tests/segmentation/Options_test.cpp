#include <gtest/gtest.h>
#include <hagen/segmentation/Options.h>

#include <stdexcept>

namespace hagen {
namespace {

TEST(Options, DefaultsFitEverySensorOfSixteenBeamsAndMore) {
    EXPECT_NO_THROW(checkOptions(Options(), 16));
    EXPECT_NO_THROW(checkOptions(Options(), 64));
}

TEST(Options, MoreComponentsThanTheWindowAreRefused) {
    Options options;
    options.principal_components = options.window_size + 1;
    EXPECT_THROW(checkOptions(options, 16), std::invalid_argument);
}

TEST(Options, AWindowLongerThanAColumnIsRefused) {
    Options options;
    options.window_size = 15;
    EXPECT_NO_THROW(checkOptions(options, 16));
    options.window_size = 16;
    EXPECT_THROW(checkOptions(options, 16), std::invalid_argument);
}

}  // namespace
}  // namespace hagen
