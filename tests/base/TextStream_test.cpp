#include "base/TextStream.h"
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <new>
#include <string>

namespace hagen::base {
namespace {

/// Runs in a separate process with little memory.
TEST(TextStream, ThrowsIfMemoryRunsOut) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer ends the program if memory runs out";
#endif
    const auto write = [] {
        const std::string part(1 << 20, 'x');
        const rlimit limit{64 << 20, 64 << 20};
        setrlimit(RLIMIT_DATA, &limit);
        TextStream text;
        try {
            for (int i = 0; i < 256; ++i) text << part;
        } catch (const std::bad_alloc&) {
            std::_Exit(7);
        }
        std::_Exit(1);
    };
    EXPECT_EXIT(write(), testing::ExitedWithCode(7), "");
}

TEST(TextStream, IgnoresGlobalLocale) {
    struct Commas : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
    };
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Commas));
    TextStream text;
    text << 1.5;
    std::locale::global(before);
    EXPECT_EQ(text.str(), "1.5");
}

}  // namespace
}  // namespace hagen::base
