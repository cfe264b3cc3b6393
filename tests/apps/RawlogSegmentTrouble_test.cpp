// What must cost nothing: odd surroundings of the built program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/ProgramTest.h"

namespace hagen {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;
const fs::path kRecording = fs::path(HAGEN_SOURCE_DIR) / "rawlogs/poles_and_wall.rawlog";

class RawlogSegmentTrouble : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_RAWLOG_SEGMENT, arguments);
    }
};

/// A closed stream's number would be that of the next file: messages would go into the output.
TEST_F(RawlogSegmentTrouble, ClosedStreamsDoNotEndUpInTheOutput) {
    const std::vector<std::string> flags{"-i", kRecording, "-o", path("open.rawlog"), "--preview"};
    ASSERT_EQ(run(flags).exit_code, 0);
    for (const std::string closed : {">&- 2>&-", "<&- >&- 2>&-", "2>&-", "<&-"}) {
        const std::string command = std::string("\"") + HAGEN_RAWLOG_SEGMENT + "\" -i \"" +
                                    kRecording.string() + "\" --preview --overwrite -o \"" +
                                    path("closed.rawlog") + "\" " + closed;
        EXPECT_EQ(test::run("/bin/sh", {"-c", command}).exit_code, 0) << closed;
        EXPECT_TRUE(test::readFile(path("closed.rawlog")) == test::readFile(path("open.rawlog")))
            << closed;
    }
}

TEST_F(RawlogSegmentTrouble, APipeIsRefusedAtOnce) {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    expectFailure({"-i", path("pipe"), "-o", path("out.rawlog")}, 1, "is a pipe or a device");
    expectFailure({"-i", "/dev/zero", "-o", path("out.rawlog")}, 1, "is a pipe or a device");
}

}  // namespace
}  // namespace hagen
