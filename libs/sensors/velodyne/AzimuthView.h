#pragma once
#include <hagen/sensors/VelodynePacket.h>

#include <array>
#include <bitset>
#include <cstddef>
#include <optional>

namespace hagen::sensors {

/// The part of each turn, clockwise in 0.01 degrees, in which a sensor with a limited field of view
/// sends nothing. The width is 0 if there is none.
struct SilentSector {
    int from = 0, width = 0, cut = 0;  ///< turns end at `cut`

    /// The share of the rotation between two azimuths, 0 ... 1, that lies in the sector; 0 if an
    /// azimuth is negative.
    double shareOf(int from_azimuth, int to_azimuth) const;
};

/// Finds the silent sector of a sensor: the only part of the turn of at least 8 degrees that no
/// block covers, if it was skipped twice, or once between two blocks of the same packet. Lost
/// packets leave other gaps in the next turn. Turns end in the middle of the sector, or at 0 if the
/// first packet starts there, because a program has then cut the recording into turns.
class AzimuthView {
 public:
    void add(const VelodynePacket& packet);
    /// nullopt: unknown. The width is 0 if all azimuths were seen.
    std::optional<SilentSector> silence() const;
    /// Number of steps of at least 8 degrees, at most 64.
    std::size_t skips() const { return skips_used_; }

 private:
    static constexpr std::size_t kBins = 3600;
    struct Skip {
        int from, width;
        bool is_in_packet;
    };

    void add(int azimuth, bool is_in_packet);

    std::bitset<kBins> seen_;
    std::array<Skip, 64> skips_;
    std::size_t skips_used_ = 0;
    int first_ = -1, last_ = -1;
};

}  // namespace hagen::sensors
