#include <hagen/base/Folder.h>

#include <gmock/gmock.h>

#include <fstream>

namespace hagen::base {
namespace {

namespace fs = std::filesystem;

class FolderTest : public testing::Test {
 protected:
    void SetUp() override {
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "b" / "deeper");
        std::ofstream(folder_ / "c.txt") << "c";
        std::ofstream(folder_ / "a") << "a";
        std::ofstream(folder_ / "b" / "deeper" / "d") << "d";
    }
    void TearDown() override { fs::remove_all(folder_); }

    const fs::path folder_ =
        fs::path(testing::TempDir()) /
        (std::string("folder_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(FolderTest, ListsEntriesByNameOneLevelDeep) {
    EXPECT_THAT(entriesOf(folder_),
                testing::ElementsAre(folder_ / "a", folder_ / "b", folder_ / "c.txt"));
    EXPECT_THAT(entriesOf(folder_ / "b" / "deeper"), testing::ElementsAre(folder_ / "b/deeper/d"));
}

TEST_F(FolderTest, NamesAFolderThatCannotBeListed) {
    try {
        entriesOf(folder_ / "none");
        FAIL() << "does not throw";
    } catch (const fs::filesystem_error& e) {
        EXPECT_EQ(e.path1(), folder_ / "none");
        EXPECT_EQ(e.code(), std::errc::no_such_file_or_directory);
    }
    std::error_code error;
    EXPECT_THAT(entriesOf(folder_ / "a", error), testing::IsEmpty());
    EXPECT_EQ(error, std::errc::not_a_directory);
    entriesOf(folder_, error);
    EXPECT_FALSE(error);
}

TEST_F(FolderTest, RemovesAllBelowButWhatLinksLeadTo) {
    fs::create_directories(folder_ / "kept");
    std::ofstream(folder_ / "kept" / "file") << "x";
    fs::create_directory_symlink(folder_ / "kept", folder_ / "b" / "link");
    EXPECT_FALSE(removeAll(folder_ / "b"));
    EXPECT_FALSE(fs::exists(folder_ / "b"));
    EXPECT_TRUE(fs::exists(folder_ / "kept" / "file"));
    EXPECT_FALSE(removeAll(folder_ / "a"));
    EXPECT_FALSE(fs::exists(folder_ / "a"));
    EXPECT_FALSE(removeAll(folder_ / "none"));
}

TEST_F(FolderTest, SaysWhyAFolderCannotBeRemoved) {
    EXPECT_TRUE(removeAll("/proc/self/fd"));
    EXPECT_TRUE(fs::exists("/proc/self/fd"));
}

}  // namespace
}  // namespace hagen::base
