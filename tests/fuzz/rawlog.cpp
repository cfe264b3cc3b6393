// The objects of a rawlog, read by MRPT, and the conversion of its scans. MRPT trusts sizes in
// files and may exhaust memory (e.g. for a rotating scan's matrix, which LimitedNew.cpp does not
// see) or crash. Therefore, RawlogReader first reads a rawlog in another process with a memory
// limit (RawlogTrial). Errors inside MRPT are not findings; errors in the conversion are.
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>

#include "fuzz/Target.h"
#include "recordings/rawlogs/EntryReader.h"
#include "support/RotatingScans.h"
#include "support/SimpleFirings.h"

namespace hagen::fuzz {
namespace {

void segment(const mrpt::obs::CObservation& observation) {
    mayRefuse([&] {
        observations::ObservationSegmenter segmenter;
        segmenter.setMinLoggingLevel(mrpt::system::LVL_ERROR);
        observations::ObservationSegmenter::Output out;
        segmenter.process(observation, out);
    });
}

/// Ends at an entry with a wrong count.
mrpt::serialization::CSerializable::Ptr nextOf(recordings::EntryReader& reader) {
    try {
        return reader.next();
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

void readEntries(std::string_view input) {
    const InputFile file(input, "input.rawlog");
    mayRefuse([&] {
        recordings::PackedInput stream(file.path());
        recordings::EntryReader reader(file.path(), stream);
        while (const auto object = nextOf(reader)) {
            if (const auto* const one =
                    dynamic_cast<const mrpt::obs::CObservation*>(object.get())) {
                segment(*one);
            }
            const auto* const frame = dynamic_cast<const mrpt::obs::CSensoryFrame*>(object.get());
            if (frame == nullptr) continue;
            for (const auto& each : *frame) {
                if (each) segment(*each);
            }
        }
    });
}

Seeds entries() {
    observations::registerMrptClasses();
    auto scan = test::poleScanFrom(0, "velodyne");
    const std::size_t packets = scan->scan_packets.size();
    scan->scan_packets.erase(scan->scan_packets.begin() + 1,
                             scan->scan_packets.begin() + static_cast<std::ptrdiff_t>(packets - 1));
    Scan points;
    points.x_m = {1, 2, 3};
    points.y_m = {4, 5, -6};
    points.z_m = {0, -1, 1};
    points.intensity = {0, 0.5f, 1};
    using observations::CloudClass;
    const auto cloud = [&](CloudClass kind) {
        return test::bytesOf(*observations::observationOf(points, "cloud", {}, kind));
    };
    mrpt::obs::CObservationRobotPose pose;
    pose.pose.mean = {1, 2, 3, 0.1, 0.2, 0.3};
    mrpt::obs::CObservationIMU imu;
    mrpt::obs::CSensoryFrame frame;
    frame.insert(observations::observationOf(points, "cloud", {}));
    mrpt::obs::CObservationRotatingScan rotating;
    rotating.rowCount = 4;
    rotating.columnCount = 8;
    rotating.rangeImage.resize(4, 8);
    rotating.rangeImage.fill(500);
    rotating.intensityImage.resize(4, 8);
    rotating.intensityImage.fill(9);
    rotating.sensorLabel = "rotating";
    return {test::bytesOf(*scan),
            cloud(CloudClass::Simple),
            cloud(CloudClass::WithIntensity),
            cloud(CloudClass::Generic),
            test::bytesOf(pose) + test::bytesOf(imu) + test::bytesOf(frame),
            test::bytesOf(rotating),
            test::newerBytesOf(rotating),
            test::newerBytesOf(rotating, std::vector<float>(4 * 8 * 3, 1.5f))};
}

const bool kAdded =
    add({"rawlog",
         readEntries,
         entries,
         {"CObservationVelodyneScan", "CObservationPointCloud", "CObservationRotatingScan",
          "CObservation3DRangeScan", "CObservationRobotPose", "CObservationIMU", "CSensoryFrame",
          "CActionCollection", "CGenericPointsMap", "CSimplePointsMap", "CPointsMapXYZI",
          "CPointsMapXYZIRT", "CColouredPointsMap", "CObservation2DRangeScan"},
         8000,
         false});

}  // namespace
}  // namespace hagen::fuzz
