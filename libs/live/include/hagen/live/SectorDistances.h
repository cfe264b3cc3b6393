#pragma once
#include <hagen/live/FrameCoverage.h>
#include <hagen/live/StreamingSegmenter.h>
#include <hagen/live/TurnCoverage.h>
#include <hagen/live/VehiclePose.h>
#include <Eigen/Geometry>
#include <array>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace hagen::live {

/// The nearest obstacle in each direction around the vehicle, from labelled sectors, as in
/// protocols of autopilots: 72 directions of 5 degrees, clockwise in the vehicle's level frame
/// (x forward, y left, z up).
///
/// **Stale is never free.** A direction that was not swept for 0.3 s is unknown, and so is one that
/// was swept in part: a lost packet leaves a gap, however narrow it is (TurnCoverage). "Seen
/// nothing" means that the sensor swept all of it, at the horizon, and that none of the returns is
/// RoI; a sensor that was tilted so far that it had no beam at the horizon there never sees
/// nothing. An obstacle is forgotten when a later turn has passed all of its degree and of the
/// sensor's, which is another if it is tilted or beside the vehicle's origin. A sensor that does
/// not turn is taken to look all around within each tenth of a second, if few of its packets are
/// lost (FrameCoverage). Its returns are dropped once it has looked all around in a tenth of a
/// second that began that much later. Otherwise the direction is unknown after 0.3 s, for up to
/// 0.7 s more.
///
/// Returns of a sector are turned and moved by the vehicle's motion since then. Directions are
/// level: a vehicle that rolls sees an obstacle on its right on its right. Without poses, the
/// vehicle is level and stays.
///
/// A copy is cheap: it shares the immutable returns of sectors.
class SectorDistances {
 public:
    static constexpr int kSectors = 72;

    enum class State { Unknown, SeenNothing, Obstacle };
    struct Sector {
        State state = State::Unknown;
        /// Horizontal distance of the nearest RoI return from the vehicle's origin; NaN unless
        /// there is an obstacle. In a direction that is swept in part, a nearer one may be in the
        /// rest.
        float distance_m = std::numeric_limits<float>::quiet_NaN();
        /// Where the obstacle is, in the vehicle's level frame of now (heading as the vehicle's).
        Eigen::Vector3f at_m = Eigen::Vector3f::Zero();
        /// When the oldest sector that this rests on came; -infinity if it is unknown.
        double time_s = -std::numeric_limits<double>::infinity();
    };
    using Sectors = std::array<Sector, kSectors>;

    struct Settings {
        /// How the sensor is mounted.
        Eigen::Isometry3d body_from_sensor = Eigen::Isometry3d::Identity();
        /// Obstacles are RoI returns between these heights above the body's origin.
        float low_m = -std::numeric_limits<float>::infinity();
        float high_m = std::numeric_limits<float>::infinity();
        double stale_s = 0.3;
        /// Where the first direction begins, clockwise from ahead. 0: as in MAVLink's
        /// OBSTACLE_DISTANCE with angle_offset 2.5 degrees.
        double begin_rad = 0;
    };
    /// The vehicle's pose at a time, if it is known.
    using PoseAt = std::function<std::optional<VehiclePose>(double time_s)>;

    /// `sensor` has the directions of the beams.
    explicit SectorDistances(const SensorModel& sensor) : SectorDistances(sensor, Settings()) {}
    SectorDistances(const SensorModel& sensor, const Settings& settings);

    /// If the clock goes back, the age of earlier sectors is unknown and they are dropped.
    void take(const LabelledSector& sector);
    /// What is known at a time, by the clock of packet arrival.
    Sectors at(double now_s, const PoseAt& poseAt = {}) const;
    /// When the latest packet of a sector came; -infinity: there was no sector.
    double latest_s() const { return latest_s_; }

 private:
    static constexpr int kParts = 5;  ///< of a direction, a degree each
    static constexpr int kBins = kSectors * kParts;
    static constexpr double kNever = -std::numeric_limits<double>::infinity();

    /// The remaining part of a sector.
    struct Seen {
        double first_time_s = 0, last_time_s = 0;
        bool turns = false;
        std::vector<TurnCoverage::Swept> swept;  ///< by its packets
        double ahead_rad = 0;                    ///< of its beams
        /// It does not turn, and FrameCoverage says that it has looked all around since then.
        std::optional<double> all_around_since_s;
        double from_rad = 0, to_rad = 0;     ///< how far the sensor had turned before, and has now
        std::vector<Eigen::Vector3f> roi_m;  ///< in the sensor's frame

        bool isPassed(double at_rad) const { return at_rad - to_rad > kLaterTurn_rad; }
    };
    struct Look;
    struct Frames;
    bool isFresh(const Seen& seen, double now_s) const;
    bool matters(const Seen& seen, double now_s) const;
    Frames framesOf(const Seen& seen, const Look& look) const;
    double azimuthOf(const Eigen::Matrix3d& sensor_from_level, int edge) const;
    double firstLook_s(double rad) const;
    void noteHorizon(const Seen& seen, const Frames& frames, Look& look) const;
    void noteSensor(const Seen& seen, const Frames& frames, Look& look) const;
    void addObstacles(const Seen& seen, const Frames& frames, Look& look) const;

    Settings settings_;
    double lowest_, highest_;                       ///< sines of the elevations of its beams
    std::deque<std::shared_ptr<const Seen>> seen_;  ///< in the order in which they came
    TurnCoverage coverage_;
    FrameCoverage frames_;
    double all_around_since_s_ = kNever;  ///< begin of the last measured period, without turns
    double latest_s_ = kNever;
};

/// In which of `number` equal directions something is, clockwise; the first one begins so far
/// clockwise from ahead.
int directionOf(const Eigen::Vector2f& at_m, int number, double begin_rad = 0);

}  // namespace hagen::live
