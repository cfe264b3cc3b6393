#include <hagen/live/TurnMotion.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/RangeImage.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hagen::live {
namespace {

constexpr int kEvery = 4;                                   // compares every n-th column
constexpr double kMemory_rad = 0.8;                         // decay angle of weights
constexpr double kMisfit_m = 0.3;                           // misfit of a return with weight 1/2
constexpr double kUsualRise_m = 0.1, kUsualTilt_rad = 0.1;  // prior motion per turn
constexpr double kMinWeight = 10;    // minimum total weight; an exact return has weight 1
constexpr double kSteepest = 0.6;    // maximum slope between rings
constexpr float kMinApart_m = 0.2F;  // minimum distance of rings that define a slope
constexpr double kTurnBefore_rad[] = {kPi, 3 * kPi};  // range of the previous turn's age

}  // namespace

TurnMotion::TurnMotion(int rows, int columns, float zone_m)
    : rows_(rows),
      columns_((columns + kEvery - 1) / kEvery),
      zone_m_(zone_m),
      ground_(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_)) {}

void TurnMotion::forget() {
    ground_.assign(ground_.size(), {});
    normal_.setZero();
    right_.setZero();
    per_turn_.setZero();
    weight_ = 0;
}

const TurnMotion::Ground& TurnMotion::groundOf(int row, int column) const {
    return ground_[static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_) +
                   static_cast<std::size_t>(row)];
}

bool TurnMotion::isOfTurnBefore(const Ground& ground) const {
    const double ago_rad = head_rad_ - ground.head_rad;
    return ground.radius_m > 0 && ago_rad > kTurnBefore_rad[0] && ago_rad < kTurnBefore_rad[1];
}

/// Outward slope of the previous turn's ground: towards the adjacent ring on the return's side if
/// known, otherwise towards the other ring.
std::optional<double> TurnMotion::slopeAt(const Pixel& now) const {
    const Ground& then = groundOf(now.row, now.column);
    const int side = now.ground.radius_m >= then.radius_m ? 1 : -1;
    for (const int row : {now.row + side, now.row - side}) {
        if (row < 0 || row >= rows_) continue;
        const Ground& ring = groundOf(row, now.column);
        const float apart_m = ring.radius_m - then.radius_m;
        if (!isOfTurnBefore(ring) || std::abs(apart_m) < kMinApart_m) continue;
        const double slope = (ring.point_m.z() - then.point_m.z()) / apart_m;
        return std::abs(slope) < kSteepest ? std::optional(slope) : std::nullopt;
    }
    return std::nullopt;
}

void TurnMotion::compare(const Pixel& now) {
    const Ground& then = groundOf(now.row, now.column);
    if (!isOfTurnBefore(then)) return;
    const std::optional<double> slope = slopeAt(now);
    if (!slope) return;
    const Eigen::Vector3d point_m = now.ground.point_m.cast<double>();
    const Eigen::Vector3d outwards = point_m / now.ground.radius_m;
    const Eigen::Vector3d normal =
        Eigen::Vector3d(-*slope * outwards.x(), -*slope * outwards.y(), 1).normalized();
    // A small rotation r moves a point by r x point, along the normal by r . (point x normal).
    const Eigen::Vector3d lever_m = point_m.cross(normal);
    const Eigen::Vector3d row = Eigen::Vector3d(normal.z(), lever_m.x(), lever_m.y()) / kMisfit_m;
    const double misfit = normal.dot(then.point_m.cast<double>() - point_m) / kMisfit_m;
    const double left = misfit - row.dot(per_turn_);
    const double weight = 1 / (1 + left * left);
    normal_ += weight * row * row.transpose();
    right_ += weight * misfit * row;
    weight_ += weight;
}

void TurnMotion::add(const Scan& sector, const std::vector<Label>& label, double head_rad) {
    const double kept = std::exp(-std::max(0.0, head_rad - head_rad_) / kMemory_rad);
    head_rad_ = head_rad;
    normal_ *= kept;
    right_ *= kept;
    weight_ *= kept;
    sector_.clear();
    for (std::size_t i = 0; i < sector.size(); ++i) {
        const int column = nearestColumn(sector.azimuth_rad[i], columns_ * kEvery);
        if (column % kEvery != 0) continue;
        Ground ground;
        if (label[i] == Label::Rou && sector.range_m[i] <= zone_m_) {
            ground.point_m = {sector.x_m[i], sector.y_m[i], sector.z_m[i]};
            ground.radius_m = ground.point_m.head<2>().norm();
            ground.head_rad = head_rad;
        }
        sector_.push_back({sector.row[i], column / kEvery, ground});
    }
    for (const Pixel& pixel : sector_) {
        if (pixel.ground.radius_m > 0) compare(pixel);
    }
    for (const Pixel& pixel : sector_) {
        Ground& ground =
            ground_[static_cast<std::size_t>(pixel.column) * static_cast<std::size_t>(rows_) +
                    static_cast<std::size_t>(pixel.row)];
        // If a pixel has several returns, the ground return is kept.
        if (pixel.ground.radius_m > 0 || ground.head_rad < head_rad) ground = pixel.ground;
    }
    const Eigen::Vector3d usual(kUsualRise_m, kUsualTilt_rad, kUsualTilt_rad);
    const Eigen::Matrix3d prior = usual.cwiseAbs2().cwiseInverse().asDiagonal();
    per_turn_ = (normal_ + prior).llt().solve(right_);
}

std::optional<Eigen::Isometry3d> TurnMotion::since(double turns) const {
    if (weight_ < kMinWeight) return std::nullopt;
    const Eigen::Vector3d turn = -turns * Eigen::Vector3d(per_turn_[1], per_turn_[2], 0);
    Eigen::Isometry3d motion(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()));
    motion.translation().z() = -turns * per_turn_[0];
    return motion;
}

}  // namespace hagen::live
