#include "avoidance/openloop/OpenLoopFiles.h"
#include <gtest/gtest.h>

#include "support/Program.h"

namespace hagen::avoidance {
namespace {

TEST(OpenLoopFiles, RowsMatchHeaders) {
    const test::TemporaryFolder folder;
    OpenLoopFiles files(folder / "out", false);
    const OpenLoopRow row{1, 2, 3.5, "W-RoI", 4, 5, 6, 7, 8, 9, {10, 11, 12, 13}, {14, 15, 16, 17}};
    files.add(row, {18, 19, 20, 21});
    files.commit({}, {});
    EXPECT_EQ(test::readFile(folder / "out/scans.csv"),
              "scan,entry,time_s,model,returns,roi,obstacles,bytes,blocked,truly_blocked,scored,"
              "hits,false_alarms,misses,level_scored,level_hits,level_false_alarms,level_misses\n"
              "1,2,3.500000,W-RoI,4,5,6,7,8,9,10,11,12,13,14,15,16,17\n");
    EXPECT_EQ(test::readFile(folder / "out/scans_measured.csv"),
              "scan,model,filter_ms,update_ms,queries_ms,heap_bytes\n"
              "1,W-RoI,18.000,19.000,20.000,21\n");
}

}  // namespace
}  // namespace hagen::avoidance
