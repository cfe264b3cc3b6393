#include "base/FileKind.h"
#include <gmock/gmock.h>

#include "support/Program.h"

namespace hagen::base {
namespace {

using testing::HasSubstr;

/// Non-text bytes after a magic number.
const std::string kRest = std::string("\0\1\2\x80", 4) + std::string(600, '\x91');

TEST(FileKind, RecognisesMagicNumbers) {
    EXPECT_EQ(kindOfBytes("\xff\xd8\xff\xe0" + kRest).what, "a JPEG picture");
    EXPECT_EQ(kindOfBytes("%PDF-1.7\n").what, "a PDF document");
    EXPECT_EQ(kindOfBytes("PK\3\4" + kRest).text(),
              "it seems to be a ZIP archive: unpack it first (an .npz holds .npy files)");
    EXPECT_EQ(kindOfBytes(std::string(257, '\0') + "ustar" + kRest).what, "a tar archive");
    EXPECT_EQ(kindOfBytes("\xd4\xc3\xb2\xa1" + kRest).what, "a network capture");
}

TEST(FileKind, RecognisesTexts) {
    EXPECT_EQ(kindOfBytes("hello\r\nworld").what, "text");
    EXPECT_EQ(kindOfBytes("cut within a letter: \xc3").what, "text");
    EXPECT_EQ(kindOfBytes("no letter: \xc3\x20").what, "");
    EXPECT_EQ(kindOfBytes(std::string(100, ' ')).what, "text");
    EXPECT_THAT(kindOfBytes("{\"a\": 1}").text(), HasSubstr("--sensor-json"));
    EXPECT_THAT(kindOfBytes("<!DOCTYPE html>").text(), HasSubstr("did its download fail?"));
}

TEST(FileKind, IsEmptyIfUnknown) {
    for (const std::string& bytes : {std::string(), kRest, std::string("\xff\xd8")}) {
        EXPECT_EQ(kindOfBytes(bytes).text(), "");
    }
    const test::TemporaryFolder folder;
    EXPECT_EQ(kindOfFile("no such file").text(), "");
    EXPECT_EQ(kindOfFile(folder.path()).what, "");
    EXPECT_EQ(kindOfFile(folder.write("a.pcd", "%PDF-1.4" + kRest)).what, "a PDF document");
}

}  // namespace
}  // namespace hagen::base
