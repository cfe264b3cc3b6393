// ROS messages outside a bag. The first byte selects the type, its highest bit the serialisation.
#include "mrpt/TableCloud.h"

#include <memory>

#include "fuzz/Bags.h"
#include "recordings/bags/Messages.h"

namespace hagen::fuzz {
namespace {

const char* const kTypes[] = {"sensor_msgs/PointCloud2",
                              "velodyne_msgs/VelodyneScan",
                              "nav_msgs/Odometry",
                              "tf2_msgs/TFMessage",
                              "std_msgs/String",
                              "ouster_ros/PacketMsg",
                              "sensor_msgs/Imu",
                              "livox_ros_driver2/CustomMsg",
                              "livox_ros_driver/CustomMsg",
                              "geometry_msgs/PoseStamped",
                              "geometry_msgs/PoseWithCovarianceStamped",
                              "pandar_msgs/PandarScan"};

void readMessage(std::string_view input) {
    Parts parts(input);
    const auto first = parts.number<std::uint8_t>();
    recordings::BagMessage message;
    message.bytes = reinterpret_cast<const std::uint8_t*>(parts.rest().data());
    message.size = parts.rest().size();
    std::vector<std::uint8_t> unpacked;
    mayRefuse([&] {
        recordings::FieldReader fields = fieldsOf(message, first >= 128 ? "cdr" : "ros1", unpacked);
        switch (first % 12) {
            case 0: {
                auto cloud = readPointCloud2(fields);
                check(cloud.table);
                observations::observationOf(
                    std::make_shared<const observations::PointTable>(std::move(cloud.table)), "",
                    {});
                return;
            }
            case 1:
                readVelodyneScan(fields);
                return;
            case 2:
                readOdometry(fields).pose();
                return;
            case 3:
                for (const auto& transform : readTransforms(fields)) transform.pose();
                return;
            case 4:
                readString(fields);
                return;
            case 5:
                readPacket(fields);
                return;
            case 6:
                readImu(fields);
                return;
            case 7:
            case 8:
                readLivox(fields);
                return;
            case 11:
                readPandarScan(fields);
                return;
            default:
                readPoseStamped(fields).pose();
        }
    });
}

Seeds messageSeeds() {
    Seeds seeds;
    for (const auto& message : everyMessage()) {
        for (std::size_t type = 0; type < std::size(kTypes); ++type) {
            if (message.type != kTypes[type]) continue;
            seeds.push_back(static_cast<char>(type) + message.ros1);
            std::size_t cdr = type;
            while (cdr < 128) cdr += 12;
            seeds.push_back(static_cast<char>(cdr) + message.cdr);
        }
    }
    return seeds;
}

const bool kAdded = add({"messages", readMessage, messageSeeds, {"intensity", "ring", "time"}});

}  // namespace
}  // namespace hagen::fuzz
