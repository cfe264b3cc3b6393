#include <gtest/gtest.h>
#include <hagen/avoidance/OpenLoopFiles.h>

#include <map>
#include <sstream>
#include <string>

#include "support/Program.h"

namespace hagen::avoidance {
namespace {

/// The fields of the only row of a table, by the names in its first line.
std::map<std::string, std::string> rowOf(const std::string& table) {
    std::istringstream lines(table);
    std::string names, values, name, value;
    std::getline(lines, names);
    std::getline(lines, values);
    std::istringstream each_name(names), each_value(values);
    std::map<std::string, std::string> row;
    while (std::getline(each_name, name, ',')) {
        EXPECT_TRUE(std::getline(each_value, value, ',')) << "no " << name;
        row[name] = value;
    }
    EXPECT_FALSE(std::getline(each_value, value, ',')) << value << " has no name";
    EXPECT_FALSE(std::getline(lines, value));
    return row;
}

TEST(OpenLoopFiles, AScansRowHasEveryFigureUnderItsName) {
    const test::TemporaryFolder folder;
    OpenLoopFiles files(folder / "out", false);
    OpenLoopRow row;
    row.scan = 1;
    row.entry = 2;
    row.time_s = 3.5;
    row.model = "W-RoI";
    row.returns = 4;
    row.roi = 5;
    row.obstacles = 6;
    row.bytes = 7;
    row.blocked = 8;
    row.truly_blocked = 9;
    row.all = {10, 11, 12, 13};
    row.level = {14, 15, 16, 17};
    files.add(row, {1, "W-RoI", 18, 19, 20, 21});
    files.commit({}, {});
    const std::map<std::string, std::string> expected{{"scan", "1"},
                                                      {"entry", "2"},
                                                      {"time_s", "3.500000"},
                                                      {"model", "W-RoI"},
                                                      {"returns", "4"},
                                                      {"roi", "5"},
                                                      {"obstacles", "6"},
                                                      {"bytes", "7"},
                                                      {"blocked", "8"},
                                                      {"truly_blocked", "9"},
                                                      {"scored", "10"},
                                                      {"hits", "11"},
                                                      {"false_alarms", "12"},
                                                      {"misses", "13"},
                                                      {"level_scored", "14"},
                                                      {"level_hits", "15"},
                                                      {"level_false_alarms", "16"},
                                                      {"level_misses", "17"}};
    EXPECT_EQ(rowOf(test::readFile(folder / "out/scans.csv")), expected);
    const std::map<std::string, std::string> measured{
        {"scan", "1"},           {"model", "W-RoI"},       {"filter_ms", "18.000"},
        {"update_ms", "19.000"}, {"queries_ms", "20.000"}, {"heap_bytes", "21"}};
    EXPECT_EQ(rowOf(test::readFile(folder / "out/scans_measured.csv")), measured);
}

}  // namespace
}  // namespace hagen::avoidance
