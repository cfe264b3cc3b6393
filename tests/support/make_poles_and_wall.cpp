// Creates rawlogs/poles_and_wall.rawlog: a vehicle flies at 3 m/s along x, 1.2 m above flat ground,
// between two rows of poles towards a wall; its level VLP-16 turns at 10 Hz. The vehicle's pose
// precedes each scan and also follows the last. Usage: make-poles-and-wall OUT.rawlog
#include <mrpt/obs/CObservationRobotPose.h>
#include "convert/RawlogWriter.h"

#include <cstdio>
#include <exception>

#include "support/SimpleFirings.h"

namespace hagen::test {
namespace {

constexpr double kAltitude_m = 1.2, kStep_m = 0.3, kPeriod_s = 0.1;
constexpr int kScans = 10;
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

}  // namespace
}  // namespace hagen::test

int main(int argc, char** argv) {
    using namespace hagen;
    if (argc != 2 || argv[1][0] == '-') {  // --help is not a file name
        std::fprintf(stderr, "usage: make-poles-and-wall OUT.rawlog\n");
        return 2;
    }
    try {
        convert::RawlogWriter writer(argv[1], true);
        for (int scan = 0; scan < test::kScans; ++scan) {
            writer.write(*test::polesAndWallPose(scan));
            writer.write(*test::polesAndWallScan(scan));
        }
        writer.write(*test::polesAndWallPose(test::kScans));
        writer.commit();
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "make-poles-and-wall: %s\n", e.what());
        return 1;
    }
}
