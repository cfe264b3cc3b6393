#pragma once
#include <hagen/sensors/OusterColumns.h>
#include <hagen/sensors/OusterSensor.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace hagen::sensors {

/// The pixels of a turn, as measured: one row per pixel of the sensor, one column per measurement
/// id, so that a row's neighbours need not be neighbours in azimuth ("staggered").
struct OusterFrame {
    enum class Column : std::uint8_t { Missing, Valid, Invalid };  ///< invalid: so says the sensor

    std::uint16_t id = 0;
    std::int64_t time_ns = 0;  ///< of the capture, at its first packet
    std::size_t columns = 0;
    bool is_uncertain = false;  ///< it may have another number of columns: it will be left out
    std::vector<Column> state;  ///< by column
    std::vector<std::uint64_t> column_time_ns;  ///< by column, by the sensor's clock
    std::vector<std::uint32_t> range;           ///< pixel * columns + column; in the profile's unit
    std::vector<std::uint8_t> reflectivity;     ///< likewise
    std::vector<std::uint32_t> second_range;    ///< likewise; empty: one return only
    std::vector<std::uint8_t> second_reflectivity;

    std::size_t at(std::size_t pixel, std::size_t column) const { return pixel * columns + column; }
};

/// Puts the packets of one sensor together into frames. Two are open at a time, so that packets may
/// be late by up to a turn. Where sixteen in a row are late by more, the sensor was started again:
/// its ids are less than before. Turns whose number of columns is not certain to be that of the
/// metadata are left out (OusterColumns).
class OusterFrames {
 public:
    struct Counts {
        std::size_t packets = 0;
        std::size_t frames = 0;
        std::size_t missing_columns = 0;  ///< of the frames, within the sensor's window
        std::size_t invalid_columns = 0;
        std::size_t wrong_columns = 0;  ///< with a measurement id that there is not
        std::size_t repeated_columns = 0;
        std::size_t late_packets = 0;      ///< of a frame that is complete, left out
        std::size_t lost_frames = 0;       ///< of which no packet came
        std::size_t uncertain_frames = 0;  ///< left out: perhaps with another number of columns
    };

    explicit OusterFrames(const OusterSensor& sensor) : sensor_(sensor), columns_(sensor) {}

    /// Takes a packet of OusterSensor::packetBytes(). Returns the frame that it is of, until the
    /// next call, or null if that is complete already; `taken` gets those of the packet's columns
    /// that it had not yet, in the packet's order; none of an uncertain frame.
    const OusterFrame* add(const std::uint8_t* packet, std::int64_t time_ns,
                           std::vector<std::size_t>* taken = nullptr);
    /// Ends the frames in progress.
    void finish();

    /// The frames that are complete, oldest first. The caller takes them out.
    std::deque<OusterFrame>& complete() { return complete_; }
    const Counts& counts() const { return counts_; }
    /// How often the sensor was started again, by its packets.
    std::size_t restarts() const { return columns_.restarts(); }

    /// From one frame id to another; ids wrap.
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
