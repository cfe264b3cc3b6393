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

/// The nearest obstacle in each direction around the vehicle, computed from labelled sectors. Like
/// autopilot protocols, uses 72 directions of 5 degrees, clockwise in the vehicle's level frame (x
/// forward, y left, z up).
///
/// **Stale is never free.** A direction is unknown if the sensor has not swept it for 0.3 s, or
/// only in part: a lost packet leaves a gap, however narrow (TurnCoverage). "Seen nothing" means
/// that the sensor swept the whole direction at the horizon without RoI returns; a sensor tilted so
/// that no beam points at the horizon never reports it. An obstacle is forgotten once a later turn
/// has passed its degree both around the vehicle and around the sensor; these differ if the sensor
/// is tilted or offset from the vehicle's origin. A sensor without a rotating head is assumed to
/// cover all directions within 0.1 s if few of its packets are lost (FrameCoverage). Its returns
/// are dropped after the next complete period; otherwise the direction is unknown after 0.3 s, for
/// up to 0.7 s more.
///
/// Returns are moved with the vehicle since they were measured. Directions are level: an obstacle
/// on the right stays on the right while the vehicle rolls. Without poses, the vehicle is assumed
/// level and stationary.
///
/// Copies are cheap: they share the immutable returns of sectors.
class SectorDistances {
 public:
    static constexpr int kSectors = 72;

    enum class State { Unknown, SeenNothing, Obstacle };
    struct Sector {
        State state = State::Unknown;
        /// Horizontal distance of the nearest RoI return from the vehicle's origin; NaN unless
        /// there is an obstacle. If the direction is only partly swept, the rest may contain a
        /// nearer obstacle.
        float distance_m = std::numeric_limits<float>::quiet_NaN();
        /// Position of the obstacle in the vehicle's current level frame (with its heading).
        Eigen::Vector3f at_m = Eigen::Vector3f::Zero();
        /// Arrival time of the oldest sector used; -infinity if unknown.
        double time_s = -std::numeric_limits<double>::infinity();
    };
    using Sectors = std::array<Sector, kSectors>;

    struct Settings {
        /// The sensor's mount.
        Eigen::Isometry3d body_from_sensor = Eigen::Isometry3d::Identity();
        /// Obstacles are RoI returns between these heights above the body's origin.
        float low_m = -std::numeric_limits<float>::infinity();
        float high_m = std::numeric_limits<float>::infinity();
        double stale_s = 0.3;
        /// Start of the first direction, clockwise from ahead. The default corresponds to MAVLink's
        /// OBSTACLE_DISTANCE with angle_offset 2.5 degrees.
        double begin_rad = 0;
    };
    /// Returns the vehicle's pose at a time, if known.
    using PoseAt = std::function<std::optional<VehiclePose>(double time_s)>;

    /// `sensor` provides the beam directions.
    explicit SectorDistances(const SensorModel& sensor) : SectorDistances(sensor, Settings()) {}
    SectorDistances(const SensorModel& sensor, const Settings& settings);

    /// If the clock goes back, earlier sectors are dropped because their age is unknown.
    void take(const LabelledSector& sector);
    /// The directions at a time on the packet arrival clock.
    Sectors at(double now_s, const PoseAt& poseAt = {}) const;
    /// Arrival of the latest packet of any sector; -infinity before the first sector.
    double latest_s() const { return latest_s_; }

 private:
    static constexpr int kParts = 5;  ///< parts of 1 degree in each direction
    static constexpr int kBins = kSectors * kParts;
    static constexpr double kNever = -std::numeric_limits<double>::infinity();

    /// The stored part of a sector.
    struct Seen {
        double first_time_s = 0, last_time_s = 0;
        bool turns = false;
        std::vector<TurnCoverage::Swept> swept;  ///< directions swept by its packets
        double ahead_rad = 0;                    ///< beam offset
        /// Without a rotating head, the start of the period that FrameCoverage found complete.
        std::optional<double> all_around_since_s;
        double from_rad = 0, to_rad = 0;     ///< total rotation before and after the sector
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
    static void noteSensor(const Seen& seen, const Frames& frames, Look& look);
    void addObstacles(const Seen& seen, const Frames& frames, Look& look) const;

    Settings settings_;
    double lowest_, highest_;  ///< sines of the lowest and highest beam elevation
    std::deque<std::shared_ptr<const Seen>> seen_;  ///< in order of arrival
    TurnCoverage coverage_;
    FrameCoverage frames_;
    double all_around_since_s_ = kNever;  ///< start of the last complete period, without turns
    double latest_s_ = kNever;
};

/// Returns in which of `number` equal directions, counted clockwise, a point is. The first
/// direction begins at `begin_rad`, clockwise from ahead.
int directionOf(const Eigen::Vector2f& at_m, int number, double begin_rad = 0);

}  // namespace hagen::live
