#include "support/PolesAndWall.h"

#include "support/SimpleFirings.h"

namespace hagen::test {
namespace {

constexpr double kAltitude_m = 1.2, kStep_m = 0.3, kPeriod_s = 0.1;
constexpr double kStart_s = 1767225600;  // 2026-01-01

SimpleScene polesAndWall() {
    SimpleScene scene;
    for (int i = -3; i <= 4; ++i) {
        scene.poles.push_back({5.0 * i, 6.0, 0.10, 3.0});
        scene.poles.push_back({5.0 * i + 2.5, -7.0, 0.15, 5.0});
    }
    scene.boxes.push_back({{16, -2, 0}, {16.5, 3, 4}});
    return scene;
}

mrpt::Clock::time_point timeOf(int scan) {
    return mrpt::Clock::fromDouble(kStart_s + kPeriod_s * scan);
}

}  // namespace

mrpt::obs::CObservationRobotPose::Ptr polesAndWallPose(int scan) {
    auto pose = mrpt::obs::CObservationRobotPose::Create();
    pose->sensorLabel = "pose";
    pose->timestamp = timeOf(scan);
    pose->pose.mean = mrpt::poses::CPose3D(kStep_m * scan, 0, kAltitude_m, 0, 0, 0);
    return pose;
}

mrpt::obs::CObservationVelodyneScan::Ptr polesAndWallScan(int scan) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
    auto observation = observations::encodeScan(
        model, fireAt(polesAndWall(), model, {kStep_m * scan, 0, kAltitude_m},
                      {kStep_m / kPeriod_s, 0, 0}));
    observation->sensorLabel = "lidar";
    observation->timestamp = timeOf(scan);
    return observation;
}

}  // namespace hagen::test
