#pragma once
#include <hagen/sensors/LidarDriver.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodyneModel.h>
#include <hagen/sensors/VelodynePacket.h>
#include "sensors/SweepReader.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace hagen::sensors {

/// Groups the packets of one sensor into turns: one ends where the azimuth wraps.
///
/// Packets up to sixteen late are reordered by the sensor's clock. Later ones are dropped, unless
/// sixteen come in a row or at the end: then the clock was set. A turn also ends at a gap of more
/// than 50 ms (a turn at the highest speed), after 250 ms (a standing sensor never wraps) and after
/// 2000 packets (whatever the clock), which bounds memory.
class VelodyneTurns {
 public:
    /// `late`: reordered.
    struct Counts : PacketCounts {
        std::size_t dual = 0;  ///< packets with two returns per firing
    };

    /// `calibration`: of the sensor; null: that of the model.
    VelodyneTurns(const VelodyneModel& model, std::string label,
                  const VelodyneCalibration* calibration = nullptr);

    void add(const VelodynePacket& packet);
    /// Completes the last turn.
    void finish();

    /// The complete turns, oldest first. The caller takes them out.
    std::deque<LidarSweep>& complete() { return complete_; }
    const Counts& counts() const { return counts_; }
    const VelodyneModel& model() const { return model_; }

 private:
    void setClock();
    void insert(const VelodynePacket& packet);
    void flush();
    void append(const VelodynePacket& packet);
    void checkGap(const VelodynePacket& packet);
    void endTurn();

    const VelodyneModel& model_;
    std::string label_;
    std::shared_ptr<const SensorModel> sensor_;  ///< the limits of its ranges
    VelodyneCalibration calibration_;
    std::deque<VelodynePacket> waiting_;  ///< by the sensor's clock
    std::vector<VelodynePacket> held_;    ///< too late, in a row
    LidarSweep turn_;                     ///< in progress, unless it has no packets
    double turn_start_us_ = 0;
    bool has_last_ = false;
    double last_us_ = 0;     ///< of the last packet appended
    int last_azimuth_ = -1;  ///< likewise
    std::deque<LidarSweep> complete_;
    Counts counts_;
};

/// "293 packets in 5 turns, 2 packets lost".
std::string textOf(const VelodyneTurns::Counts& counts);

}  // namespace hagen::sensors
