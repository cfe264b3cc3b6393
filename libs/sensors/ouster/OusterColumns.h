#pragma once
#include "sensors/ouster/OusterSensor.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hagen::sensors {

/// Checks that a sensor's turns have the number of columns in the metadata. Packets do not contain
/// the mode, and columns of another mode would be decoded with wrong directions.
///
/// The number of columns is the duration of a turn divided by the column interval; in LEGACY
/// packets, it follows from the encoder angle. The metadata are rejected only if the ratio matches
/// another mode (2, 4 or 8 times as many or as few columns), because clocks may be set. The first
/// turn is trusted unless its duration contradicts `lidar_mode`. After a restart of the sensor,
/// which a mode change requires, a turn must confirm the number of columns.
class OusterColumns {
 public:
    explicit OusterColumns(const OusterSensor& sensor) : sensor_(sensor) {}

    /// Adds a packet of packetBytes() bytes. Returns true if the number of columns is certain.
    bool take(const std::uint8_t* packet);
    /// Number of sensor restarts: changes of the initialization ID.
    std::size_t restarts() const { return restarts_; }

 private:
    struct Column {
        std::uint16_t frame = 0, number = 0;
        std::uint64_t time_ns = 0;
        std::uint32_t encoder = 0;  ///< encoder angle, LEGACY only
        double all_ns = 0;          ///< extrapolated duration of a turn
    };
    enum class Evidence { None, Same, Other };

    bool readColumns(const std::uint8_t* packet);
    std::optional<Column> replace(const Column& column);
    static int turnsBetween(const Column& from, const Column& to);
    Evidence evidence();
    static Evidence evidenceOf(double ratio);

    const OusterSensor& sensor_;
    bool is_certain_ = true;
    bool has_compared_ = false;  ///< compared consecutive turns since the sensor started
    std::optional<std::uint32_t> initialization_;
    std::size_t restarts_ = 0;
    std::optional<Column> first_, last_;          ///< first and last valid column of the packet
    std::optional<Column> before_;                ///< last column of the previous packet
    std::vector<std::optional<Column>> of_turn_;  ///< latest column with each number
};

}  // namespace hagen::sensors
