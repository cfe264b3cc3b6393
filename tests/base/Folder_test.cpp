#include "base/Folder.h"
#include <gmock/gmock.h>

#include "support/Program.h"

namespace hagen::base {
namespace {

namespace fs = std::filesystem;

TEST(Folder, ListsEntriesByName) {
    const test::TemporaryFolder folder;
    for (const char* name : {"c.txt", "a", "b/deeper"}) folder.write(name, "");
    EXPECT_THAT(entriesOf(folder.path()),
                testing::ElementsAre(folder / "a", folder / "b", folder / "c.txt"));
}

TEST(Folder, ReportsUnreadableFolder) {
    const test::TemporaryFolder folder;
    try {
        entriesOf(folder / "none");
        FAIL() << "does not throw";
    } catch (const fs::filesystem_error& e) {
        EXPECT_EQ(e.path1(), folder / "none");
        EXPECT_EQ(e.code(), std::errc::no_such_file_or_directory);
    }
    std::error_code error;
    EXPECT_THAT(entriesOf(folder.write("a", ""), error), testing::IsEmpty());
    EXPECT_EQ(error, std::errc::not_a_directory);
    entriesOf(folder.path(), error);
    EXPECT_FALSE(error);
}

}  // namespace
}  // namespace hagen::base
