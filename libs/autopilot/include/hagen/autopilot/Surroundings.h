#pragma once
#include <hagen/autopilot/VehicleMotion.h>
#include <hagen/range_image/SensorModel.h>
#include <hagen/streaming/FrameCoverage.h>
#include <hagen/streaming/StreamingSegmenter.h>
#include <hagen/streaming/TurnCoverage.h>
#include <Eigen/Geometry>

#include <array>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace hagen::autopilot {

/// What is known of a direction around the vehicle.
struct Direction {
    enum class State { Unknown, SeenNothing, Obstacle };
    State state = State::Unknown;
    /// Of the nearest RoI return: horizontal, from the sensor; NaN unless there is an obstacle.
    float distance_m = std::numeric_limits<float>::quiet_NaN();
    /// Where it is now, in the vehicle's level frame (heading as the vehicle's, z up).
    Eigen::Vector3f at_m = Eigen::Vector3f::Zero();
};

/// 72 directions of 5 degrees, clockwise; the middle of the first is straight ahead.
using Directions = std::array<Direction, 72>;

/// The obstacles around a vehicle that turns, tilts and moves, from labelled sectors.
///
/// What a sector saw is turned and moved by the vehicle's motion since. Directions are level: a
/// vehicle that rolls sees an obstacle on its right on its right. **Stale is never free**: what was
/// not swept within 0.3 s is unknown, and so is a direction in which the sensor, as it was tilted
/// then, has no beam at the horizon. An obstacle is forgotten when a later turn has passed all of
/// its degree and of the sensor's, which is another if it is tilted, or a sensor without turns has
/// looked all around since. Where neither happened, its direction is unknown after 0.3 s, and for
/// as long as 0.7 s more.
/// (streaming::SectorDistances is the same for a sensor that stays.)
///
/// A copy is cheap: it shares what sectors saw, which does not change.
class Surroundings {
 public:
    struct Settings {
        /// How the sensor is mounted.
        Eigen::Matrix3d vehicle_from_sensor = Eigen::Matrix3d::Identity();
        /// RoI returns farther above or below the sensor than this are no obstacles.
        float height_m = std::numeric_limits<float>::infinity();
        double stale_s = 0.3;
    };
    Surroundings(const SensorModel& sensor, const Settings& settings);

    /// A clock that goes back does not tell how old the earlier sectors are: they are forgotten.
    void take(const streaming::LabelledSector& sector);
    /// What is known at a time of the clock by which packets came.
    Directions at(double now_s, const VehicleMotion& motion) const;
    /// When the latest packet of a sector came; -infinity: there was no sector.
    double latest_s() const { return latest_s_; }

 private:
    static constexpr int kParts = 5;  ///< of a direction, a degree each
    static constexpr int kBins = 72 * kParts;

    /// What remains of a sector.
    struct Seen {
        double first_time_s = 0, last_time_s = 0;
        bool turns = false;
        std::vector<streaming::TurnCoverage::Swept> swept;  ///< by its packets
        double ahead_rad = 0;                               ///< of its beams
        /// It does not turn, and FrameCoverage says that it has looked all around since then.
        std::optional<double> all_around_since_s;
        double from_rad = 0, to_rad = 0;     ///< how far the sensor had turned before, and has now
        std::vector<Eigen::Vector3f> roi_m;  ///< in the sensor's frame
    };
    bool isFresh(const Seen& seen, double now_s) const;
    bool matters(const Seen& seen, double now_s) const;
    double azimuthOf(const Eigen::Matrix3d& sensor_from_level, int edge) const;
    static std::optional<double> passedAt(const Seen& seen, const streaming::TurnCoverage::Arc& arc,
                                          double since_rad);
    static void notePassed(const Seen& seen, double yawed_rad, double since_rad,
                           std::array<double, kBins>& passed_rad);

    Settings settings_;
    double lowest_, highest_;                       ///< sines of the elevations of its beams
    std::deque<std::shared_ptr<const Seen>> seen_;  ///< in the order in which they came
    streaming::TurnCoverage coverage_;
    streaming::FrameCoverage frames_;
    /// When the last period of a sensor without turns that was measured began.
    double all_around_since_s_ = -std::numeric_limits<double>::infinity();
    double latest_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace hagen::autopilot
