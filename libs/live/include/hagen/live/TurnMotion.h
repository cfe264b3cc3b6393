#pragma once
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace hagen::live {

/// Estimates how a rotating sensor tilts and rises: compares each ROU return of the zone with the
/// return of the same pixel a turn before. (Beyond the zone, ROU is not only ground.)
///
/// Point-to-plane registration (Chen and Medioni 1992) with three unknowns: height, roll and pitch.
/// Heading and place do not show on level ground. The plane at a return goes through the next ring
/// of its column, and is level across. Returns that do not fit weigh less (Cauchy weights), and so
/// do older ones.
class TurnMotion {
 public:
    /// Rows of the sensor, columns of the image, and the zone of the filter.
    TurnMotion(int rows, int columns, float zone_m);

    /// Compares a sector with the turn before, and keeps it for the next. One label per return;
    /// `head_rad`: how far the sensor has turned in total, over all turns.
    void add(const Scan& sector, const std::vector<Label>& label, double head_rad);
    void forget();

    /// Transforms a point measured this many turns ago (up to about one) to the sensor frame of
    /// now, if the sensor moves as in the latest turn. None: too little ground was compared.
    std::optional<Eigen::Isometry3d> since(double turns) const;

 private:
    struct Ground {
        Eigen::Vector3f point_m;
        float radius_m = 0;   ///< its distance from the sensor's axis; 0: there is none
        double head_rad = 0;  ///< how far the sensor had turned
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
    std::vector<Ground> ground_;  ///< the latest of each pixel, in the columns that are compared
    std::vector<Pixel> sector_;   ///< reused
    double head_rad_ = 0;
    /// Least squares of height, roll and pitch of the frame of then against that of now: normal
    /// equations, in units of the variance of a return.
    Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right_ = Eigen::Vector3d::Zero(), per_turn_ = Eigen::Vector3d::Zero();
    double weight_ = 0;  ///< of all returns in it
};

}  // namespace hagen::live
