// Text files of numbers: poses in all formats, and times in file names.
#include "recordings/NumberTable.h"
#include "recordings/PoseFile.h"

#include <algorithm>
#include <cmath>

#include "fuzz/Target.h"
#include "recordings/CloudTimes.h"

namespace hagen::fuzz {
namespace {

void readTables(std::string_view input) {
    const InputFile file(input, "input.txt");
    mayRefuse([&] {
        for (const auto& line : recordings::readNumberTable(file.path())) {
            for (const double number : line.numbers) require(std::isfinite(number), "no number");
        }
        // Each byte belongs to a number, a comment or a separator.
        const bool has_nul = input.find('\0') != std::string_view::npos;
        require(!has_nul || input.find('#') != std::string_view::npos, "bytes that are no numbers");
    });
    mayRefuse([&] { recordings::kindOfPoseFile(file.path()); });
    mayRefuse([&] {
        const auto poses = recordings::readTumPoses(file.path());
        // The written file round-trips.
        if (poses.empty()) return;
        const auto copy = scratch() / "copy.tum";
        recordings::writeTumPoses(copy, poses);
        require(recordings::readTumPoses(copy).size() == poses.size(), "a pose is lost");
    });
    mayRefuse([&] { recordings::readKittiPoses(file.path()); });
    mayRefuse([&] { recordings::readKittiCalibration(file.path()); });

    std::vector<std::string> names;
    for (Parts parts(input); !parts.isAtEnd();) names.emplace_back(parts.until('\n'));
    const auto times = recordings::timesOfNames(names);
    require(times.times_s.size() == names.size(), "a name has no time");
    for (const double time_s : times.times_s) require(std::isfinite(time_s), "no time");
    std::vector<std::size_t> order = recordings::orderOfNames(names);
    std::sort(order.begin(), order.end());
    require(order.size() == names.size(), "a name has no place");
    for (std::size_t i = 0; i < order.size(); ++i) require(order[i] == i, "a name has two places");
}

Seeds tables() {
    return {"# time x y z qx qy qz qw\n1.5 1 2 3 0 0 0 1\n1.6 1 2 3 0 0 0.6 0.8\n",
            "1 0 0 1.5 0 1 0 2 0 0 1 3e1\n0 -1 0 0 1 0 0 0 0 0 1 0\n",
            "P0: 1 2 3\nTr: 0 -1 0 1 0 0 -1 2 1 0 0 3\n",
            "1317617735.25\n1317617735.5\n",
            "cloud_1317617735_250000000\ncloud_1317617735_350000000\n",
            "1317617735000\n1317617735100\n",
            "000001\n000003\n"};
}

const bool kAdded = add({"number_tables",
                         readTables,
                         tables,
                         {"nan", "inf", "1e308", "1e-320", "0x1p3", "Tr:", "#", "4294967296",
                          "9223372036854775808", "1e400"},
                         1024});

}  // namespace
}  // namespace hagen::fuzz
