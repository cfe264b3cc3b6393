#pragma once
#include "sensors/ouster/OusterSensor.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hagen::sensors {

/// Checks that a sensor's turns have as many columns as its metadata. Packets do not contain the
/// mode, and in another one, columns would be placed in wrong directions.
///
/// The time from a column to the same one of the next turn is as many times that from column to
/// column as the turn has columns. Those of LEGACY packets have the head's angle. Only what fits
/// another mode (2, 4 or 8 times as many columns, or as few) counts against the metadata: clocks
/// may be set. The first turn is trusted unless its time contradicts `lidar_mode`. After a restart
/// of the sensor, which a change of the mode requires, a turn must confirm the columns.
class OusterColumns {
 public:
    explicit OusterColumns(const OusterSensor& sensor) : sensor_(sensor) {}

    /// Takes a packet of OusterSensor::packetBytes(). Returns whether its columns are certain.
    bool take(const std::uint8_t* packet);
    /// Restarts of the sensor: changes of the initialization number.
    std::size_t restarts() const { return restarts_; }

 private:
    struct Column {
        std::uint16_t frame = 0, number = 0;
        std::uint64_t time_ns = 0;
        std::uint32_t encoder = 0;  ///< of LEGACY: how far the head has turned
        double all_ns = 0;          ///< so long all columns of a turn would take
    };
    enum class Evidence { None, Same, Other };

    bool readColumns(const std::uint8_t* packet);
    std::optional<Column> replace(const Column& column);
    static int turnsBetween(const Column& from, const Column& to);
    Evidence evidence();
    static Evidence evidenceOf(double ratio);

    const OusterSensor& sensor_;
    bool is_certain_ = true;
    bool has_compared_ = false;  ///< two turns, since the sensor was started
    std::optional<std::uint32_t> initialization_;
    std::size_t restarts_ = 0;
    std::optional<Column> first_, last_;          ///< valid ones, of the packet
    std::optional<Column> before_;                ///< the last one of the packet before
    std::vector<std::optional<Column>> of_turn_;  ///< by number: the latest
};

}  // namespace hagen::sensors
