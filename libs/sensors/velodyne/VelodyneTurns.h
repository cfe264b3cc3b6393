#pragma once
#include <hagen/sensors/LidarDriver.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodyneModel.h>
#include <hagen/sensors/VelodynePacket.h>
#include "sensors/SweepReader.h"
#include "sensors/velodyne/AzimuthView.h"

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace hagen::sensors {

/// Groups the packets of one sensor into turns. A turn ends where the azimuth wraps or, with a
/// limited field of view, in the silent sector, which does not count as lost.
///
/// Packets up to 16 packets late are reordered by sensor time. Older packets are dropped, unless 16
/// arrive in a row or at the end, which means that the clock was set. A turn also ends at a gap of
/// more than 50 ms (a turn at maximum speed), after 250 ms (a stationary sensor never wraps) and,
/// to limit memory, after 4000 packets.
class VelodyneTurns {
 public:
    /// `late`: reordered packets.
    struct Counts : PacketCounts {
        std::size_t dual = 0;  ///< packets with two returns per firing
    };

    /// `calibration`: null selects the model's default.
    VelodyneTurns(const VelodyneModel& model, std::string label,
                  const VelodyneCalibration* calibration = nullptr, SilentSector silence = {});

    void add(const VelodynePacket& packet);
    /// Ends the last turn.
    void finish();

    /// Complete turns, oldest first. The caller removes them.
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
    std::shared_ptr<const SensorModel> sensor_;  ///< contains the range limits
    VelodyneCalibration calibration_;
    SilentSector silence_;
    std::deque<VelodynePacket> waiting_;  ///< sorted by sensor time
    std::vector<VelodynePacket> held_;    ///< consecutive late packets
    LidarSweep turn_;                     ///< turn in progress, if it has packets
    double turn_start_us_ = 0;
    bool has_last_ = false;
    double last_us_ = 0;  ///< sensor time of the last appended packet
    int last_azimuth_ = -1;
    int turned_ = -1;  ///< azimuth of the turn's last packet relative to the cut
    std::deque<LidarSweep> complete_;
    Counts counts_;
};

/// Such as "293 packets in 5 turns, 2 packets lost".
std::string textOf(const VelodyneTurns::Counts& counts);

}  // namespace hagen::sensors
