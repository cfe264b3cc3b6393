#include "base/ReadFile.h"
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "support/Program.h"

namespace hagen::base {
namespace {

using testing::HasSubstr;

TEST(ReadFile, ReadsWholeTextAndLines) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file =
        folder.write("a.txt", std::string("one\n\nth\0ree\r\nlast", 17));
    EXPECT_EQ(readText(file).size(), 17u);
    std::ifstream in = openToRead(file);
    std::vector<std::string> lines;
    for (std::string line; nextLine(in, line, file);) lines.push_back(line);
    EXPECT_EQ(lines, (std::vector<std::string>{"one", "", std::string("th\0ree\r", 7), "last"}));
}

TEST(ReadFile, RejectsPipesDevicesAndFolders) {
    const test::TemporaryFolder folder;
    const std::string pipe = (folder / "pipe").string();
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(test::messageOf([&] { openToRead(pipe); }),
                HasSubstr(pipe + ": is a pipe or a device"));
    EXPECT_THAT(test::messageOf([] { readText("/dev/zero"); }), HasSubstr("/dev/zero: is a pipe"));
    EXPECT_THAT(test::messageOf([&] { openToRead(folder.path()); }), HasSubstr("is a folder"));
    EXPECT_THAT(test::messageOf([&] { openToRead(folder / "none"); }),
                HasSubstr("none: cannot be read: No such file"));
    EXPECT_EQ(test::messageOf([&] { checkIsFile(folder / "none"); }), "");
}

TEST(ReadFile, LimitsTextAndLineSizes) {
    const test::TemporaryFolder folder;
    constexpr std::size_t kMiB = 1 << 20;
    const std::filesystem::path file = folder.write("a.txt", std::string(kMiB, 'x'));
    EXPECT_EQ(readText(file, kMiB).size(), kMiB);
    std::ifstream whole = openToRead(file);
    std::string line;
    EXPECT_TRUE(nextLine(whole, line, file));
    EXPECT_EQ(line.size(), kMiB);
    folder.write("a.txt", std::string(kMiB + 1, 'x'));
    EXPECT_THAT(test::messageOf([&] { readText(file, kMiB); }),
                HasSubstr("a.txt: is larger than 1 MiB"));
    std::ifstream longer = openToRead(file);
    EXPECT_THAT(test::messageOf([&] { nextLine(longer, line, file); }),
                HasSubstr("a.txt: has a line"));
}

}  // namespace
}  // namespace hagen::base
