// ROS 1 bags.
#include "fuzz/Bags.h"

namespace hagen::fuzz {
namespace {

void readBag(std::string_view input) { readAnyBag(InputFile(input, "input.bag").path()); }

Seeds bagSeeds() {
    Seeds seeds;
    for (const auto& message : everyMessage()) {
        if (message.type == "velodyne_msgs/VelodyneScan") {
            seeds.push_back(test::ros1BagOf({message}, {"lz4"}));
        } else {
            seeds.push_back(test::ros1BagOf({message}));
        }
    }
    const auto all = everyMessage();
    seeds.push_back(test::ros1BagOf({all[0], all[4]}, {"bz2"}));
    seeds.push_back(test::ros1BagOf({all[0], all[3]}, {"none", 4, false}));
    return seeds;
}

const bool kAdded =
    add({"ros1_bag",
         readBag,
         bagSeeds,
         {"#ROSBAG V2.0\n", "op=\x02", "op=\x03", "op=\x05", "op=\x07",
          "conn=", "compression=", "none", "bz2", "lz4", "size=", "topic=", "type=", "md5sum=",
          "time=", "index_pos=", "sensor_msgs/PointCloud2", "tf2_msgs/TFMessage"},
         16000});

}  // namespace
}  // namespace hagen::fuzz
