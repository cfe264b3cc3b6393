// MCAP files.
#include "fuzz/Bags.h"

namespace hagen::fuzz {
namespace {

void readMcap(std::string_view input) { readAnyBag(InputFile(input, "input.mcap").path()); }

Seeds mcapSeeds() {
    Seeds seeds;
    for (const auto& message : everyMessage()) {
        seeds.push_back(test::mcapOf({message}, {"none", 0}));
    }
    const auto all = everyMessage();
    seeds.push_back(test::mcapOf({all[0], all[4]}, {"zstd"}));
    seeds.push_back(test::mcapOf({all[0], all[4]}, {"lz4"}));
    seeds.push_back(test::mcapOf({all[0], all[4]}, {"none"}));
    seeds.push_back(test::mcapOf({all[0], all[3]}, {"none", 0}, true));
    return seeds;
}

const bool kAdded = add({"mcap",
                         readMcap,
                         mcapSeeds,
                         {"\x89MCAP0\r\n", "zstd", "lz4", "cdr", "ros1", "ros2msg", "profile",
                          "sensor_msgs/msg/PointCloud2", "tf2_msgs/msg/TFMessage"},
                         16000});

}  // namespace
}  // namespace hagen::fuzz
