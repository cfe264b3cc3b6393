#pragma once
#include <hagen/sensors/LidarDriver.h>
#include <hagen/sensors/OusterFrames.h>
#include <hagen/sensors/OusterSensor.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen::sensors {

/// Reads the packets of one Ouster. Returns are relative to the origin of its beams (its lidar
/// frame, with the axes of the sensor). Lost packets are those missing in complete turns, but for
/// the first; interruptions are jumps by more than two turns.
class OusterDriver : public LidarDriver {
 public:
    explicit OusterDriver(const OusterSensor& sensor);
    OusterDriver(const OusterDriver&) = delete;
    OusterDriver& operator=(const OusterDriver&) = delete;

    SensorModel sensor() const override { return *sensor_.model; }
    BeamOffsets beamOffsets(double min_range_m) const override;
    bool isData(const Datagram& datagram) const override;
    bool hasSerial() const override { return sensor_.hasSerial(); }
    Taken add(const Datagram& datagram, double arrival_s, ReturnSink& sink) override;
    void finish() override;

 private:
    Taken takeColumns(const OusterFrame& frame, bool is_duplicate, double arrival_s,
                      ReturnSink& sink);
    void countLosses();
    void addRuns(const OusterFrame& frame, long long turn, double arrival_s, ReturnSink& sink);

    const OusterSensor sensor_;
    OusterFrames frames_{sensor_};
    double ahead_rad_;  ///< clockwise from the sensor's x axis to column 0
    bool has_last_ = false, is_uncertain_ = false;
    std::uint16_t last_id_ = 0;  ///< of the latest packet
    long long turn_ = 0;         ///< likewise, accumulated
    long long last_at_ = 0;      ///< its first column, accumulated
    std::size_t missing_of_first_ = 0;
    std::vector<std::size_t> columns_, run_;
    Scan returns_;
};

}  // namespace hagen::sensors
