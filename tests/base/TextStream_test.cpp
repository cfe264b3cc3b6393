#include <gtest/gtest.h>
#include <hagen/base/TextStream.h>

#include <sys/resource.h>
#include <new>
#include <string>

namespace hagen::base {
namespace {

/// Data that the process may take.
class DataLimit {
 public:
    explicit DataLimit(rlim_t bytes) {
        getrlimit(RLIMIT_DATA, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_DATA, &limit);
    }
    ~DataLimit() { setrlimit(RLIMIT_DATA, &before_); }
    DataLimit(const DataLimit&) = delete;
    DataLimit& operator=(const DataLimit&) = delete;

 private:
    rlimit before_{};
};

TEST(TextStream, ThrowsWhereMemoryRunsOut) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer ends the program where memory runs out";
#endif
    const std::string part(1 << 20, 'x');
    TextStream text;
    std::ostringstream plain;
    const DataLimit limit(64 << 20);
    const auto write = [&](std::ostream& to) {
        for (int i = 0; i < 256; ++i) to << part;
    };
    EXPECT_THROW(write(text), std::bad_alloc);
    EXPECT_NO_THROW(write(plain));
    EXPECT_TRUE(plain.bad());
}

TEST(TextStream, NumbersAreThoseOfTheClassicLocale) {
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
