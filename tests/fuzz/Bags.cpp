#include "fuzz/Bags.h"

#include <hagen/mrpt/ObservationScan.h>
#include "recordings/bags/BagFile.h"
#include "recordings/bags/BagScans.h"
#include "recordings/bags/BagSurvey.h"

#include <string>

#include "support/HesaiPackets.h"
#include "support/OusterPackets.h"
#include "support/SimpleFirings.h"

namespace hagen::fuzz {

void readAnyBag(const std::filesystem::path& file) {
    recordings::isBag(file);
    recordings::BagSurvey survey;
    if (!mayRefuse([&] { survey = recordings::surveyBag(file); })) return;
    recordings::textOfTopics(survey);
    mayRefuse([&] {
        recordings::BagScans scans(file, survey, {});
        mayRefuse([&] {
            while (const auto observation = scans.next()) {
                if (!observations::isLidarScan(*observation)) continue;
                observations::ObservedScan observed;
                mayRefuse([&] { observations::readObservation(*observation, {}, observed); });
            }
        });
        require(scans.fractionRead() >= 0 && scans.fractionRead() <= 1, "a fraction");
        scans.remarks();
    });
}

std::vector<test::SentMessage> everyMessage() {
    constexpr double kTime_s = 1700000000;
    auto scan = test::poleScanFrom(0, "velodyne");
    scan->scan_packets.resize(1);
    const auto imu = test::sentMessage("/imu", "sensor_msgs/Imu", kTime_s, [&](auto& to) {
        to.header(kTime_s, "imu");
        for (const double number : {0.0, 0.0, 0.0, 1.0}) to.number(number);
        for (int i = 0; i < 9; ++i) to.number(0.1);
        for (int of = 0; of < 2; ++of) {
            for (int i = 0; i < 12; ++i) to.number(0.0);
        }
    });
    const auto livox = [&](const std::string& type) {
        return test::sentMessage("/livox", type, kTime_s, [&](auto& to) {
            to.header(kTime_s, "livox").number(std::uint64_t{1000}).number(std::uint32_t{2});
            to.number(std::uint8_t{1}).raw(std::string(3, '\0')).number(std::uint32_t{2});
            for (int i = 0; i < 2; ++i) {
                to.number(std::uint32_t{100}).number(1.0f).number(2.0f).number(3.0f);
                to.number(std::uint8_t{9}).number(std::uint8_t{0}).number(std::uint8_t{1});
            }
        });
    };
    const auto posed = [&](const std::string& type) {
        return test::sentMessage("/pose", type, kTime_s, [&](auto& to) {
            to.header(kTime_s, "map").pose(1, 2, 3, 0.5);
            for (int i = 0; i < 36; ++i) to.number(0.0);
        });
    };
    const auto sensor = sensors::ousterSensorOf(test::ousterJson(), "metadata");
    const std::string packet = test::packetsOf(sensor, test::randomFrame(sensor, 3))[0];
    return {test::cloudMessage("/points", kTime_s, "lidar", {1, 2, 3, 0.5f, 4, 5, 6, 0.25f}),
            test::hesaiMessage("/hesai", kTime_s, "hesai", test::hesaiPackets(32, 1, 2), 4e-4),
            test::velodyneMessage("/velodyne", kTime_s, "velodyne", *scan, 1e-3),
            test::odometryMessage("/odom", kTime_s, "odom", "base_link", 1, 2, 3),
            test::transformMessage("/tf", kTime_s, "odom", "base_link", 1, 2, 3),
            test::transformMessage("/tf_static", kTime_s, "base_link", "lidar", 0, 0, 1),
            test::stringMessage("/ouster/metadata", kTime_s, test::ousterJson()),
            test::sentMessage("/ouster/lidar_packets", "ouster_ros/PacketMsg", kTime_s,
                              [&](auto& to) { to.counted(packet); }),
            imu,
            livox("livox_ros_driver2/CustomMsg"),
            livox("livox_ros_driver/CustomMsg"),
            posed("geometry_msgs/PoseStamped"),
            posed("geometry_msgs/PoseWithCovarianceStamped")};
}

}  // namespace hagen::fuzz
