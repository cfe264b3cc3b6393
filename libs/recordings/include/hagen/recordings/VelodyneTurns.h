#pragma once
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodyneModel.h>
#include <hagen/sensors/VelodynePacket.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace hagen::recordings {

/// Groups the packets of one sensor into turns: one ends where the azimuth wraps.
///
/// Packets that come up to sixteen late are put back in order by the sensor's clock. Later ones are
/// left out, unless sixteen come in a row, or are the last: then the clock was set. A turn also
/// ends where more than 50 ms are missing (a whole turn at the highest speed), after 250 ms (a
/// sensor that stands still never wraps) and after 2000 packets (whatever its clock says), so
/// memory is bounded.
class VelodyneTurns {
 public:
    using Turn = mrpt::obs::CObservationVelodyneScan::Ptr;

    struct Counts {
        std::size_t packets = 0;  ///< taken, without those repeated or too late
        std::size_t turns = 0;
        std::size_t dual = 0;           ///< packets with two returns per firing
        std::size_t out_of_order = 0;   ///< packets put back in their place
        std::size_t too_late = 0;       ///< packets too late for their place, left out
        std::size_t repeated = 0;       ///< packets that came again, left out
        std::size_t lost = 0;           ///< packets missing, by the sensor's clock
        std::size_t interruptions = 0;  ///< gaps of more than a second, and jumps of that clock
    };

    /// `calibration`: of the sensor; null: that of the model.
    VelodyneTurns(const sensors::VelodyneModel& model, std::string label,
                  const sensors::VelodyneCalibration* calibration = nullptr);

    void add(const sensors::VelodynePacket& packet);
    /// Ends the last turn: no packets follow.
    void finish();

    /// The turns that are complete, oldest first. The caller takes them out.
    std::deque<Turn>& complete() { return complete_; }
    const Counts& counts() const { return counts_; }

 private:
    void setClock();
    void insert(const sensors::VelodynePacket& packet);
    void flush();
    void append(const sensors::VelodynePacket& packet);
    void checkGap(const sensors::VelodynePacket& packet);
    void endTurn();

    const sensors::VelodyneModel& model_;
    std::string label_;
    mrpt::obs::VelodyneCalibration calibration_;
    std::deque<sensors::VelodynePacket> waiting_;  ///< by the sensor's clock
    std::vector<sensors::VelodynePacket> held_;    ///< too late, in a row
    Turn turn_;                                    ///< in progress; null: none
    double turn_start_us_ = 0;
    bool has_last_ = false;
    double last_us_ = 0;     ///< of the last packet appended
    int last_azimuth_ = -1;  ///< likewise
    std::deque<Turn> complete_;
    Counts counts_;
};

/// "293 packets in 5 turns, 2 packets lost": for remarks().
std::string textOf(const VelodyneTurns::Counts& counts);

}  // namespace hagen::recordings
