#pragma once
#include "support/ProgramTest.h"

namespace hagen::test {

class SegmentTest : public ProgramTest {
 protected:
    Outcome run(const Arguments& arguments) const override {
        return test::run(HAGEN_RAWLOG_SEGMENT, arguments);
    }
    /// Runs rawlog-segment in a shell after a command such as "ulimit -n 9; ".
    static Outcome runAfter(const std::string& command, const Arguments& arguments) {
        return test::run(
            "/bin/bash",
            with({"-c", command + "exec \"$0\" \"$@\"", HAGEN_RAWLOG_SEGMENT}, arguments));
    }
    /// Ten VLP-16 scans with poses.
    static std::string recording() { return HAGEN_SOURCE_DIR "/rawlogs/poles_and_wall.rawlog"; }
    static std::string config(const std::string& name) {
        return HAGEN_SOURCE_DIR "/config/" + name + ".yaml";
    }
    /// The contents of all label files in a scan folder.
    std::string labelsOf(const std::string& folder) const {
        std::string all;
        for (const auto& file : std::set<std::filesystem::path>{
                 std::filesystem::directory_iterator(folder_ / folder / "labels"), {}}) {
            all += file.filename().string() + ":" + readFile(file);
        }
        return all;
    }
};

}  // namespace hagen::test
