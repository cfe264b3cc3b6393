#include <hagen/mrpt/LocatedCloud.h>
#include <hagen/recordings/OusterObservation.h>
#include <hagen/recordings/Remarks.h>
#include <hagen/sensors/OusterScan.h>
#include <mrpt/poses/CPose3D.h>

#include <memory>

namespace hagen::recordings {

mrpt::obs::CObservationPointCloud::Ptr observationOf(const sensors::OusterFrame& frame,
                                                     const sensors::OusterSensor& sensor) {
    auto observation = mrpt::obs::CObservationPointCloud::Create();
    observation->sensorLabel = "ouster";
    observation->timestamp = timeOf(frame.time_ns);
    const Eigen::Vector3d up_m = sensor.lidar_to_sensor.translation();
    observation->sensorPose = mrpt::poses::CPose3D(up_m.x(), up_m.y(), up_m.z(), 0, 0, 0);
    observation->pointcloud =
        std::make_shared<observations::LocatedCloud>(scanOf(frame, sensor), sensor.model);
    return observation;
}

std::string textOf(const sensors::OusterFrames::Counts& counts) {
    std::string text = counted(counts.packets, "packet") + " in " + counted(counts.frames, "turn");
    addCount(counts.lost_frames, "turn", "lost", text);
    addCount(counts.uncertain_frames, "turn",
             "left out: it is not certain that they have the columns of the metadata", text);
    addCount(counts.missing_columns, "column", "missing", text);
    addCount(counts.invalid_columns, "column", "that the sensor calls invalid, left out", text);
    addCount(counts.wrong_columns, "column", "with a wrong number, left out", text);
    addCount(counts.repeated_columns, "column", "repeated, left out", text);
    addCount(counts.late_packets, "packet", "more than a turn late, left out", text);
    return text;
}

}  // namespace hagen::recordings
