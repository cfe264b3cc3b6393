#include <hagen/scan/Angle.h>
#include <hagen/simulation/Path.h>
#include <algorithm>
#include <cmath>

namespace hagen::simulation {
namespace {

/// A position on the path: the segment and the distance along it.
struct Part {
    bool is_turn;
    bool is_back;  ///< on the second straight or the following turn
    double way_m;
};

Part partAt(const Path& path, double way_m) {
    const double straight_m = 2 * path.half_straight_m, turn_m = kPi * path.radius_m;
    double way = std::fmod(way_m + path.half_straight_m, path.length_m());
    if (way < 0) way += path.length_m();
    const bool is_back = way >= straight_m + turn_m;
    if (is_back) way -= straight_m + turn_m;
    const bool is_turn = way >= straight_m;
    return {is_turn, is_back, is_turn ? way - straight_m : way};
}

}  // namespace

double Path::length_m() const { return 4 * half_straight_m + 2 * kPi * radius_m; }

Eigen::Vector2d Path::at(double way_m) const {
    const Part part = partAt(*this, way_m);
    Eigen::Vector2d place(part.way_m - half_straight_m, -radius_m);
    if (part.is_turn) {
        const double angle = part.way_m / radius_m;
        place = {half_straight_m + radius_m * std::sin(angle), -radius_m * std::cos(angle)};
    }
    if (part.is_back) place = -place;
    return place;
}

double Path::heading_rad(double way_m) const {
    const Part part = partAt(*this, way_m);
    return (part.is_turn ? part.way_m / radius_m : 0.0) + (part.is_back ? kPi : 0.0);
}

double Path::curvature_per_m(double way_m) const {
    return partAt(*this, way_m).is_turn ? 1.0 / radius_m : 0.0;
}

double Path::distance_m(double x_m, double y_m) const {
    const double beyond_m = std::max(std::abs(x_m) - half_straight_m, 0.0);
    if (beyond_m == 0) return std::abs(std::abs(y_m) - radius_m);
    return std::abs(std::hypot(beyond_m, y_m) - radius_m);
}

}  // namespace hagen::simulation
