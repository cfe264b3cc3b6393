#pragma once
#include "sensors/ouster/OusterColumns.h"
#include "sensors/ouster/OusterSensor.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace hagen::sensors {

/// The pixels of a turn as measured: one row per pixel, one column per measurement ID. Pixels in a
/// column may differ in azimuth ("staggered").
struct OusterFrame {
    enum class Column : std::uint8_t {
        Missing,
        Valid,
        Invalid
    };  ///< invalid: flagged by the sensor

    std::uint16_t id = 0;
    std::int64_t time_ns = 0;  ///< capture time of the first packet
    std::size_t columns = 0;
    bool is_uncertain = false;  ///< dropped, because its number of columns is uncertain
    std::vector<Column> state;  ///< by column
    std::vector<std::uint64_t> column_time_ns;  ///< by column, sensor time
    std::vector<std::uint32_t> range;        ///< at pixel * columns + column, in the profile's unit
    std::vector<std::uint8_t> reflectivity;  ///< like `range`
    std::vector<std::uint32_t> second_range;  ///< like `range`; empty in single-return mode
    std::vector<std::uint8_t> second_reflectivity;

    std::size_t at(std::size_t pixel, std::size_t column) const { return pixel * columns + column; }
};

/// Assembles the packets of one sensor into frames. Two frames are open at a time, so that packets
/// may be up to a turn late. 16 later packets in a row mean that the sensor restarted with smaller
/// IDs. Drops turns whose number of columns may differ from the metadata (OusterColumns).
class OusterFrames {
 public:
    struct Counts {
        std::size_t packets = 0;
        std::size_t frames = 0;
        std::size_t missing_columns = 0;  ///< columns missing within the sensor's window
        std::size_t invalid_columns = 0;
        std::size_t wrong_columns = 0;  ///< columns with an invalid measurement ID
        std::size_t repeated_columns = 0;
        std::size_t late_packets = 0;  ///< dropped packets of frames that are already complete
        std::size_t lost_frames = 0;
        std::size_t uncertain_frames = 0;  ///< dropped frames whose number of columns is uncertain
    };

    explicit OusterFrames(const OusterSensor& sensor) : sensor_(sensor), columns_(sensor) {}

    /// Adds a packet of OusterSensor::packetBytes(). Returns its frame, valid until the next call,
    /// or null if that frame is already complete. Appends the packet's new columns to `taken`, in
    /// packet order, unless the frame is uncertain.
    const OusterFrame* add(const std::uint8_t* packet, std::int64_t time_ns,
                           std::vector<std::size_t>* taken = nullptr);
    /// Completes the frames in progress.
    void finish();

    /// Complete frames, oldest first. The caller removes them.
    std::deque<OusterFrame>& complete() { return complete_; }
    const Counts& counts() const { return counts_; }
    /// Number of sensor restarts detected in packets.
    std::size_t restarts() const { return columns_.restarts(); }

    /// The signed difference of two frame IDs, which wrap.
    static int stepOf(std::uint16_t from, std::uint16_t to) {
        return static_cast<std::int16_t>(static_cast<std::uint16_t>(to - from));
    }

 private:
    void restart();
    OusterFrame* frameOf(std::uint16_t id, std::int64_t time_ns);
    bool readColumn(const std::uint8_t* column, std::size_t& number, OusterFrame& frame);
    void completeFirst();

    const OusterSensor& sensor_;
    OusterColumns columns_;
    std::deque<OusterFrame> open_;  ///< sorted by ID
    std::size_t late_in_a_row_ = 0;
    bool has_last_ = false;
    std::uint16_t last_id_ = 0;  ///< ID of the last complete frame
    std::deque<OusterFrame> complete_;
    Counts counts_;
};

}  // namespace hagen::sensors
