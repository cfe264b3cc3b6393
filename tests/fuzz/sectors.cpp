// A LiDAR labelled sector by sector, with arbitrary packets, sweeps, times, motions, sensors and
// options. Each return is labelled once; near directions are never free.
#include <hagen/live/StreamingSegmenter.h>

#include <cmath>
#include <optional>

#include "fuzz/AnyFilter.h"
#include "fuzz/SectorChecker.h"
#include "fuzz/Target.h"

namespace hagen::fuzz {
namespace {

using live::LabelledSector;
using live::StreamingSegmenter;

/// Returns of a packet: some are arbitrary, the rest show ground and a wall in each row.
Scan anyPacket(Parts& parts, const SensorModel& sensor, const live::Sweep& sweep) {
    Scan scan;
    const auto add = [&](float azimuth_rad, std::uint8_t row, float range_m) {
        const float elevation_rad = sensor.elevations_rad[row % sensor.elevations_rad.size()];
        scan.x_m.push_back(range_m * std::cos(elevation_rad) * std::cos(azimuth_rad));
        scan.y_m.push_back(range_m * std::cos(elevation_rad) * std::sin(azimuth_rad));
        scan.z_m.push_back(range_m * std::sin(elevation_rad));
        scan.range_m.push_back(range_m);
        scan.azimuth_rad.push_back(azimuth_rad);
        scan.row.push_back(row);
    };
    const auto from_rad = static_cast<float>(std::remainder(-sweep.from_rad, 6.283185307179586));
    for (std::size_t returns = parts.below(8); returns > 0; --returns) {
        const bool is_odd = parts.chance();
        add(is_odd ? oddNumber(parts) : from_rad, parts.number<std::uint8_t>(), oddNumber(parts));
        if (parts.chance()) scan.x_m.back() = oddNumber(parts);
        if (parts.chance()) scan.z_m.back() = oddNumber(parts);
    }
    const float height_m = 0.1f * static_cast<float>(parts.number<std::int8_t>());
    const float wall_m = 0.3f * static_cast<float>(parts.number<std::uint8_t>());
    if (wall_m == 0) return scan;
    for (int row = 0; row < sensor.rows(); ++row) {
        const float down = -std::sin(sensor.elevations_rad[static_cast<std::size_t>(row)]);
        const float ground_m = height_m / down;
        const float range_m = ground_m > 0 && ground_m < wall_m ? ground_m : wall_m;
        for (const float part : {0.0f, 0.3f, 0.7f}) {
            const float swept = static_cast<float>(sweep.to_rad - sweep.from_rad);
            add(from_rad - part * swept, static_cast<std::uint8_t>(row), range_m);
        }
    }
    return scan;
}

live::StreamingOptions anyCut(Parts& parts) {
    live::StreamingOptions cut;
    if (!parts.chance()) return cut;
    cut.sector_rad = 0.02 * (1 + parts.number<std::uint8_t>());
    cut.window_rad = 0.02 * parts.number<std::uint8_t>();
    cut.keep_every = static_cast<int>(parts.below(20));
    cut.estimate_motion_from_ground = parts.chance();
    cut.skip_ahead_rad = 0.01 * parts.number<std::uint8_t>();
    cut.skip_ahead_moved_rad = 0.01 * parts.number<std::uint8_t>();
    return cut;
}

void streamAnything(std::string_view input) {
    Parts parts(input);
    Options options;
    options.columns = 64;
    setOptions(parts, options);
    std::optional<SectorChecker> checker;
    std::optional<StreamingSegmenter> segmenter;
    try {
        const SensorModel sensor = anySensor(parts);
        checker.emplace(sensor);
        segmenter.emplace(
            sensor, options, [&](const LabelledSector& sector) { checker->take(sector); },
            anyCut(parts));
    } catch (const std::invalid_argument& e) {
        require(e.what()[0] != '\0', "an error has no message");
        return;
    }
    double head_rad = parts.number<std::int8_t>(), now_s = 100;
    std::size_t added = 0;
    for (int packets = 0; packets < 200 && !parts.isAtEnd(); ++packets) {
        const std::size_t kind = parts.below(16);
        if (kind == 0) segmenter->setAttitude(anyTilt(parts));
        if (kind == 1) segmenter->setPose(anyPose(parts));
        if (kind == 2) segmenter->setMount(anyTilt(parts));
        if (kind == 3) segmenter->flush();
        if (kind == 4) segmenter->restart();
        if (kind < 5) continue;
        live::Sweep sweep{head_rad, head_rad + 0.002 * parts.number<std::uint8_t>()};
        if (kind == 5) sweep.from_rad = static_cast<double>(oddNumber(parts));
        if (kind == 6) sweep.to_rad = static_cast<double>(oddNumber(parts));
        if (kind == 7) now_s = static_cast<double>(oddNumber(parts));
        if (kind == 8) head_rad += 0.01 * parts.number<std::int8_t>();
        const Scan returns = anyPacket(parts, segmenter->sensor(), sweep);
        try {
            if (kind == 9) {
                segmenter->addFrame(returns, now_s);
            } else {
                segmenter->add(returns, sweep, now_s);
                head_rad = sweep.to_rad;
            }
            added += returns.size();
        } catch (const std::invalid_argument& e) {
            require(e.what()[0] != '\0', "an error has no message");
            now_s = std::abs(now_s) <= 1e11 ? now_s : 100;
        }
        now_s += 1e-4 * parts.number<std::uint8_t>();
    }
    segmenter->flush();
    require(checker->returns() == added, "not each return came out once");
}

Seeds sectorSeeds() {
    const std::string defaults(1, '\0'), vlp16("\2\0\0", 3), usual(1, '\0'), head(1, '\0');
    std::string turns, moving;
    for (int packet = 0; packet < 60; ++packet) {
        // No arbitrary returns; the sensor is 2 m above ground and 9 m from a wall.
        const std::string returns = bytesOf(std::uint8_t{0}, std::int8_t{20}, std::uint8_t{30});
        const std::string one = bytesOf(std::uint8_t{10}, std::uint8_t{130}) + returns + "\x40";
        turns += one;
        moving += bytesOf(std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{20},
                          static_cast<std::int16_t>(packet % 7), std::uint8_t{20},
                          static_cast<std::int16_t>(packet % 5)) +
                  one;
    }
    return {defaults + vlp16 + usual + head + turns, defaults + vlp16 + usual + head + moving,
            defaults + vlp16 + "\1\7\7\7\1\7\7" + head + turns};
}

const bool kAdded = add({"sectors", streamAnything, sectorSeeds, {}, 1500});

}  // namespace
}  // namespace hagen::fuzz
