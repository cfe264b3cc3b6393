#include "fuzz/AnyFilter.h"

#include "filter/OptionKeys.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace hagen::fuzz {

float oddNumber(Parts& parts) {
    using Limits = std::numeric_limits<float>;
    const float odd[] = {0.0f,
                         -0.0f,
                         Limits::max(),
                         Limits::lowest(),
                         Limits::min(),
                         Limits::denorm_min(),
                         1e-20f,
                         1e20f,
                         1.0f,
                         Limits::epsilon(),
                         Limits::quiet_NaN(),
                         Limits::infinity(),
                         -Limits::infinity()};
    const std::size_t kind = parts.below(32);
    if (kind < std::size(odd)) return odd[kind];
    if (kind < 24) return 0.01f * static_cast<float>(parts.number<std::int16_t>());
    return parts.number<float>();
}

void setOptions(Parts& parts, Options& options) {
    for (std::size_t changes = parts.below(8); changes > 0; --changes) {
        const auto& keys = optionKeys();
        const OptionKey& key = keys[parts.below(keys.size())];
        const double share = parts.number<std::uint8_t>() / 255.0;
        const double value = key.min + share * share * (key.max - key.min);
        std::visit(
            [&](auto field) {
                using Field = std::decay_t<decltype(options.*field)>;
                if constexpr (std::is_same_v<Field, bool>) {
                    options.*field = share > 0.5;
                } else if constexpr (std::is_enum_v<Field>) {
                    options.*field = static_cast<Field>(static_cast<int>(2.99 * share));
                } else {
                    options.*field = static_cast<Field>(value);
                }
            },
            key.field);
    }
    options.columns = std::min(options.columns, 256);
}

SensorModel anySensor(Parts& parts) {
    const auto names = knownSensorModels();
    const std::size_t kind = parts.below(2 * names.size());
    SensorModel sensor;
    if (kind < names.size()) {
        sensor = sensorModel(names[kind]);
    } else {
        std::vector<double> elevations_deg;
        double elevation_deg = -90 + static_cast<double>(parts.below(90));
        const std::size_t beams = 2 + parts.below(40);
        for (std::size_t i = 0; i < beams && elevation_deg <= 90; ++i) {
            elevations_deg.push_back(elevation_deg);
            elevation_deg += 1e-4 + 0.02 * parts.number<std::uint8_t>();
        }
        sensor = customSensorModel(elevations_deg);
    }
    if (parts.chance()) sensor.min_range_m = std::abs(oddNumber(parts));
    if (parts.chance()) sensor.max_range_m = std::abs(oddNumber(parts));
    return sensor;
}

std::optional<Eigen::Isometry3d> anyPose(Parts& parts) {
    if (!parts.chance()) return std::nullopt;
    const Eigen::Vector3d axis(oddNumber(parts), oddNumber(parts), oddNumber(parts));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(axis.norm(), axis.stableNormalized()).toRotationMatrix();
    pose.translation() = Eigen::Vector3d(oddNumber(parts), oddNumber(parts), oddNumber(parts));
    return pose;
}

std::optional<Attitude> anyTilt(Parts& parts) {
    if (!parts.chance()) return std::nullopt;
    return Attitude{oddNumber(parts), oddNumber(parts)};
}

}  // namespace hagen::fuzz
