#pragma once
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace hagen::live {

/// Estimates tilt and climb of a rotating sensor: each ROU return in the zone is compared with the
/// return of the same pixel one turn before. (Beyond the zone, ROU is not only ground.)
///
/// Point-to-plane registration (Chen and Medioni 1992) with three unknowns: height, roll and pitch;
/// level ground does not determine heading and position. The plane at a return has the slope from
/// there to the next ring in its column, and is level across the column. Outliers (Cauchy weights)
/// and older returns have lower weights.
class TurnMotion {
 public:
    /// `rows` of the sensor, `columns` of the image, and zone of the filter.
    TurnMotion(int rows, int columns, float zone_m);

    /// Compares a sector with the turn before, and stores the sector for the next turn. `label` has
    /// one entry per return; `head_rad` is the total rotation of the sensor over all turns.
    void add(const Scan& sector, const std::vector<Label>& label, double head_rad);
    void forget();

    /// Transforms a point measured this many turns ago (up to about one) to the current sensor
    /// frame, assuming motion as in the latest turn. Returns nullopt if too little ground was
    /// compared.
    std::optional<Eigen::Isometry3d> since(double turns) const;

 private:
    struct Ground {
        Eigen::Vector3f point_m = Eigen::Vector3f::Zero();
        float radius_m = 0;   ///< distance from the sensor's axis; 0 without ground
        double head_rad = 0;  ///< rotation of the sensor
    };
    struct Pixel {
        int row, column;
        Ground ground;
    };
    bool isOfTurnBefore(const Ground& ground) const;
    std::optional<double> slopeAt(const Pixel& now) const;
    void compare(const Pixel& now);
    const Ground& groundOf(int row, int column) const;

    int rows_, columns_;
    float zone_m_;
    std::vector<Ground> ground_;  ///< latest ground of each pixel in the compared columns
    std::vector<Pixel> sector_;   ///< pixels of a sector; reused
    double head_rad_ = 0;
    /// Normal equations of the least-squares fit of height, roll and pitch of the previous frame
    /// relative to the current frame, in units of a return's variance.
    Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right_ = Eigen::Vector3d::Zero(), per_turn_ = Eigen::Vector3d::Zero();
    double weight_ = 0;  ///< total weight of all returns
};

}  // namespace hagen::live
