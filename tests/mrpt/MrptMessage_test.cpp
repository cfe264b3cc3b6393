#include <gtest/gtest.h>
#include <hagen/mrpt/MrptMessage.h>
#include <stdexcept>

namespace hagen::observations {
namespace {

std::string messageOfText(const std::string& what) { return messageOf(std::runtime_error(what)); }

TEST(MrptMessage, KeepsInnermostReason) {
    EXPECT_EQ(messageOfText("==== Exception\nMessage:  outer\nMessage: the inner one\nCallstack"),
              "the inner one");
    EXPECT_EQ(messageOfText("no mark"), "no mark");
}

TEST(MrptMessage, KeepsUtf8) {
    EXPECT_EQ(messageOfText("/home/j\xc3\xb6rg/a.bin: no such file"),
              "/home/j\xc3\xb6rg/a.bin: no such file");
}

TEST(MrptMessage, RejectsBinaryText) {
    EXPECT_EQ(messageOfText("class '\xff\x01' is not registered"), "");
    EXPECT_EQ(messageOfText("\x1b[2J"), "");
}

}  // namespace
}  // namespace hagen::observations
