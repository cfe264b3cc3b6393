#pragma once
#include "sensors/ouster/OusterColumns.h"
#include "sensors/ouster/OusterSensor.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace hagen::sensors {

/// The pixels of a turn as measured: one row per pixel of the sensor, one column per measurement
/// id, so that neighbours in a column may differ in azimuth ("staggered").
struct OusterFrame {
    enum class Column : std::uint8_t {
        Missing,
        Valid,
        Invalid
    };  ///< invalid: flagged by the sensor

    std::uint16_t id = 0;
    std::int64_t time_ns = 0;  ///< capture time of its first packet
    std::size_t columns = 0;
    bool is_uncertain = false;                  ///< dropped: it may have another number of columns
    std::vector<Column> state;                  ///< by column
    std::vector<std::uint64_t> column_time_ns;  ///< by column, sensor time
    std::vector<std::uint32_t> range;        ///< by pixel * columns + column, in the profile's unit
    std::vector<std::uint8_t> reflectivity;  ///< likewise
    std::vector<std::uint32_t> second_range;  ///< likewise; empty: single return
    std::vector<std::uint8_t> second_reflectivity;

    std::size_t at(std::size_t pixel, std::size_t column) const { return pixel * columns + column; }
};

/// Assembles the packets of one sensor into frames. Two frames are open at a time, so that packets
/// may be up to a turn late. If 16 packets in a row are later, the sensor has restarted with
/// smaller ids. Drops turns whose number of columns may differ from the metadata (OusterColumns).
class OusterFrames {
 public:
    struct Counts {
        std::size_t packets = 0;
        std::size_t frames = 0;
        std::size_t missing_columns = 0;  ///< missing from frames, within the sensor's window
        std::size_t invalid_columns = 0;
        std::size_t wrong_columns = 0;  ///< with an invalid measurement id
        std::size_t repeated_columns = 0;
        std::size_t late_packets = 0;      ///< dropped, because their frame is complete
        std::size_t lost_frames = 0;       ///< without any packet
        std::size_t uncertain_frames = 0;  ///< dropped: number of columns uncertain
    };

    explicit OusterFrames(const OusterSensor& sensor) : sensor_(sensor), columns_(sensor) {}

    /// Adds a packet of OusterSensor::packetBytes(). Returns its frame, valid until the next call,
    /// or null if the frame is already complete. Adds the packet's new columns to `taken`, in
    /// packet order, unless the frame is uncertain.
    const OusterFrame* add(const std::uint8_t* packet, std::int64_t time_ns,
                           std::vector<std::size_t>* taken = nullptr);
    /// Completes the frames in progress.
    void finish();

    /// The complete frames, oldest first. The caller removes them.
    std::deque<OusterFrame>& complete() { return complete_; }
    const Counts& counts() const { return counts_; }
    /// Number of sensor restarts detected in packets.
    std::size_t restarts() const { return columns_.restarts(); }

    /// The difference of two frame ids, which wrap.
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
    std::deque<OusterFrame> open_;  ///< by their ids
    std::size_t late_in_a_row_ = 0;
    bool has_last_ = false;
    std::uint16_t last_id_ = 0;  ///< of the last frame completed
    std::deque<OusterFrame> complete_;
    Counts counts_;
};

}  // namespace hagen::sensors
