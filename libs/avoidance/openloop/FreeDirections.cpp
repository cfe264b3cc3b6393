#include <hagen/avoidance/FreeDirections.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace hagen::avoidance {
namespace {

constexpr float kMinStep_m = 0.05f;

std::array<Eigen::Vector3f, kDirections> makeDirections() {
    std::array<Eigen::Vector3f, kDirections> directions;
    for (std::size_t n = 0; n < kDirections; ++n) {
        const double azimuth =
            2 * M_PI * static_cast<double>(n % kDirectionAzimuths) / kDirectionAzimuths;
        const double elevation = elevationOfDirection(n);
        directions[n] =
            Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                            std::cos(elevation) * std::sin(azimuth), std::sin(elevation))
                .cast<float>();
    }
    return directions;
}

bool isBlocked(const std::function<float(const Eigen::Vector3f&)>& clearance_m,
               const Eigen::Vector3f& start_m, const Eigen::Vector3f& direction,
               const FreeDirectionOptions& options) {
    for (float distance_m = 0;;) {
        const float spare_m =
            clearance_m(start_m + distance_m * direction) - options.clearance_radius_m;
        if (spare_m < 0) return true;
        if (distance_m >= options.length_m) return false;
        distance_m = std::min(distance_m + std::max(spare_m, kMinStep_m), options.length_m);
    }
}

double share(std::size_t part, std::size_t whole) {
    return whole == 0 ? NAN : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

double elevationOfDirection(std::size_t number) {
    const std::size_t row = number / kDirectionAzimuths;
    const auto step = static_cast<double>(row);
    return kMaxElevation_rad * (2 * step / (kDirectionElevations - 1) - 1);
}

Eigen::Vector3f directionOf(std::size_t number) {
    static const auto directions = makeDirections();
    return directions[number];
}

bool pointsDown(std::size_t number) {
    return number / kDirectionAzimuths < kDirectionElevations / 2;
}

DirectionSet blockedDirections(const std::function<float(const Eigen::Vector3f&)>& clearance_m,
                               const Eigen::Vector3f& position_m,
                               const FreeDirectionOptions& options) {
    DirectionSet blocked;
    for (std::size_t n = 0; n < kDirections; ++n) {
        blocked[n] = isBlocked(clearance_m, position_m, directionOf(n), options);
    }
    return blocked;
}

double freeAgreement(const DirectionSet& blocked_a, const DirectionSet& blocked_b) {
    const std::size_t either = (~blocked_a | ~blocked_b).count();
    return either == 0 ? 1 : share((~blocked_a & ~blocked_b).count(), either);
}

double DirectionCounts::precision() const { return share(hits, hits + false_alarms); }
double DirectionCounts::recall() const { return share(hits, hits + misses); }

DirectionCounts& DirectionCounts::operator+=(const DirectionCounts& other) {
    scored += other.scored;
    hits += other.hits;
    false_alarms += other.false_alarms;
    misses += other.misses;
    return *this;
}

DirectionCounts countBlocked(const DirectionSet& predicted_blocked,
                             const DirectionSet& truly_blocked, const DirectionSet& scored) {
    return {scored.count(), (predicted_blocked & truly_blocked & scored).count(),
            (predicted_blocked & ~truly_blocked & scored).count(),
            (~predicted_blocked & truly_blocked & scored).count()};
}

}  // namespace hagen::avoidance
