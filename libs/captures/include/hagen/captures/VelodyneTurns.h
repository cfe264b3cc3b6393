#pragma once
#include <hagen/observations/VelodyneModel.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace hagen::captures {

/// A data packet of a Velodyne and when it came.
struct VelodynePacket {
    using Raw = mrpt::obs::CObservationVelodyneScan::TVelodyneRawPacket;

    Raw raw;
    std::int64_t time_ns = 0;  ///< of the capture

    /// Microseconds since the full hour, by the sensor's clock.
    double sensorTimeUs() const;
    /// Whether it says so; those of an HDL-64E do not.
    bool isDual() const;
    /// Azimuth of its first block that has one, 0.01 degrees; -1: none has.
    int azimuth() const;
};

/// Groups the packets of one sensor into turns: one ends where the azimuth wraps.
///
/// Packets that come up to sixteen late are put back in order by the sensor's clock. A turn also
/// ends where more than 50 ms are missing (a whole turn at the highest speed), after 250 ms (a
/// sensor that stands still never wraps) and after 2000 packets (whatever its clock says), so
/// memory is bounded.
class VelodyneTurns {
 public:
    using Turn = mrpt::obs::CObservationVelodyneScan::Ptr;

    struct Counts {
        std::size_t packets = 0;  ///< taken, without those repeated
        std::size_t turns = 0;
        std::size_t dual = 0;           ///< packets with two returns per firing
        std::size_t out_of_order = 0;   ///< packets put back in their place
        std::size_t repeated = 0;       ///< packets that came again, left out
        std::size_t lost = 0;           ///< packets missing, by the sensor's clock
        std::size_t interruptions = 0;  ///< gaps of more than a second, and jumps of that clock
    };

    /// `calibration`: of the sensor; null: that of the model.
    VelodyneTurns(const observations::VelodyneModel& model, std::string label,
                  std::shared_ptr<const mrpt::obs::VelodyneCalibration> calibration = nullptr);

    void add(const VelodynePacket& packet);
    /// Ends the last turn: no packets follow.
    void finish();

    /// The turns that are complete, oldest first. The caller takes them out.
    std::deque<Turn>& complete() { return complete_; }
    const Counts& counts() const { return counts_; }

 private:
    void flush();
    void append(const VelodynePacket& packet);
    void checkGap(const VelodynePacket& packet);
    void endTurn();

    const observations::VelodyneModel& model_;
    std::string label_;
    std::shared_ptr<const mrpt::obs::VelodyneCalibration> calibration_;
    std::deque<VelodynePacket> waiting_;  ///< by the sensor's clock
    Turn turn_;                           ///< in progress; null: none
    double turn_start_us_ = 0;
    bool has_last_ = false;
    double last_us_ = 0;     ///< of the last packet appended
    int last_azimuth_ = -1;  ///< likewise
    std::deque<Turn> complete_;
    Counts counts_;
};

/// "293 packets in 5 turns, 2 packets lost": for remarks().
std::string textOf(const VelodyneTurns::Counts& counts);

/// Whether these bytes are a data packet: of the right size, and any of its blocks has a header.
bool isVelodyneData(const std::uint8_t* bytes, std::size_t size);
/// Whether such a packet is of an HDL-64E, the only one to send blocks of lower lasers.
bool isOfHdl64(const std::uint8_t* packet);
/// Byte of the packet that holds the id of the model.
constexpr std::size_t kVelodyneModelAt = 1205;

}  // namespace hagen::captures
