#pragma once
#include <hagen/sensors/LidarDriver.h>
#include <hagen/sensors/RecentPackets.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodyneDecoder.h>
#include <hagen/sensors/VelodyneModel.h>
#include <hagen/sensors/VelodynePacket.h>

#include <vector>

namespace hagen::sensors {

/// Reads the packets of one Velodyne. Interruptions are gaps of more than 50 ms, and jumps of the
/// clock.
class VelodyneDriver : public LidarDriver {
 public:
    /// `calibration`: of an HDL-64E; null: that of the model. Throws std::invalid_argument for an
    /// HDL-64E without calibration.
    explicit VelodyneDriver(const VelodyneModel& model,
                            const VelodyneCalibration* calibration = nullptr);

    SensorModel sensor() const override;
    BeamOffsets beamOffsets(double min_range_m) const override;
    bool isDual() const override { return is_dual_; }
    bool isData(const Datagram& datagram) const override;
    Taken add(const Datagram& datagram, double arrival_s, ReturnSink& sink) override;

 private:
    /// Consecutive sound firings of a packet.
    struct Run {
        int first, end;
    };

    struct Held {
        VelodynePacket packet;
        double arrival_s;
    };

    Taken addPacket(const VelodynePacket& packet, double arrival_s, ReturnSink& sink);
    Taken hold(const VelodynePacket& packet, double arrival_s, ReturnSink& sink);
    Taken take(const VelodynePacket& packet, double arrival_s, ReturnSink& sink);
    void findRuns(const VelodynePacket& packet);
    bool readSweep(const VelodynePacket& packet, double elapsed_us, Sweep& sweep);
    void addRuns(const VelodynePacket& packet, const Sweep& sweep, double arrival_s,
                 ReturnSink& sink);

    const VelodyneModel& model_;
    VelodyneCalibration calibration_;
    DecoderWorkspace decoder_;
    Scan returns_, part_;
    std::vector<Run> runs_;  ///< of the latest packet
    RecentPackets recent_;
    std::vector<Held> held_;  ///< too late, in a row
    bool has_last_ = false, is_dual_ = false;
    double last_us_ = 0;  ///< by the sensor's clock, of the latest packet
    Sweep last_sweep_{};  ///< likewise
};

}  // namespace hagen::sensors
