#include "base/Json.h"
#include <gmock/gmock.h>

#include "support/Program.h"

namespace hagen::base {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string errorOf(const std::string& text) {
    return test::messageOf([&] { parseJson(text); });
}

TEST(Json, ReplacesInvalidUtf8) {
    EXPECT_EQ(dumpJson("a\"\n"), R"("a\"\n")");
    EXPECT_EQ(dumpJson("\xff"), "\"\xEF\xBF\xBD\"");
}

TEST(Json, ReportsSyntaxErrorLocation) {
    EXPECT_THAT(errorOf("{\n \"a\": 1,\n  b: 2}"),
                StartsWith("is not valid JSON: parse error at line 3, column 3: "));
    EXPECT_THAT(errorOf("{\"a\": 1}\n}"), HasSubstr("line 2, column 1"));
    EXPECT_THAT(errorOf("[1e999]"), HasSubstr("1e999"));
    for (const std::string cut : {"{", "[1,", "{\"a\""}) {
        EXPECT_THAT(errorOf(cut), HasSubstr("unexpected end of input")) << cut;
    }
    EXPECT_NE(errorOf(""), "");
    EXPECT_LT(errorOf("[\"" + std::string(5000, 'x')).size(), 400u);
}

TEST(Json, RejectsDeepNesting) {
    const auto nested = [](std::size_t levels) {
        return std::string(levels, '[') + std::string(levels, ']');
    };
    EXPECT_EQ(parseJson(nested(64)).dump(), nested(64));
    EXPECT_THAT(errorOf(nested(65)), StartsWith("is nested too deeply: more than 64 levels"));
    EXPECT_THAT(errorOf(std::string(300000, '[')), StartsWith("is nested too deeply"));
}

}  // namespace
}  // namespace hagen::base
