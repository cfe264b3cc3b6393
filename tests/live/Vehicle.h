#pragma once
// A simulated vehicle and its messages, computed with the formulas of the aeronautical convention
// (rotations about down, right and forward) instead of the tested code.
#include <Eigen/Geometry>
#include "live/autopilot/Messages.h"
#include "live/mavlink/Frame.h"

#include <cmath>

namespace hagen::live {

/// A vehicle in MAVLink's frames: north, east, down and forward, right, down.
struct Vehicle {
    double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;
    Eigen::Vector3d rates_rad_s = Eigen::Vector3d::Zero();  ///< about the vehicle's axes
    Eigen::Vector3d ned_m = Eigen::Vector3d::Zero(), speed_m_s = Eigen::Vector3d::Zero();

    Eigen::Matrix3d nedFromFrd() const {
        const double cr = std::cos(roll_rad), sr = std::sin(roll_rad);
        const double cp = std::cos(pitch_rad), sp = std::sin(pitch_rad);
        const double cy = std::cos(yaw_rad), sy = std::sin(yaw_rad);
        Eigen::Matrix3d m;
        m << cp * cy, sr * sp * cy - cr * sy, cr * sp * cy + sr * sy,  //
            cp * sy, sr * sp * sy + cr * cy, cr * sp * sy - sr * cy,   //
            -sp, sr * cp, cr * cp;
        return m;
    }
    /// A point in the frame of the vehicle's sensor: x forward, y left, z up.
    Eigen::Vector3d seen(const Eigen::Vector3d& place_ned_m) const {
        const Eigen::Vector3d frd = nedFromFrd().transpose() * (place_ned_m - ned_m);
        return {frd.x(), -frd.y(), -frd.z()};
    }
    /// Bearing clockwise from the vehicle's heading, in degrees from 0 to 360.
    double bearing_deg(const Eigen::Vector3d& place_ned_m) const {
        const Eigen::Vector3d way = place_ned_m - ned_m;
        const double bearing = (std::atan2(way.y(), way.x()) - yaw_rad) * 180 / M_PI;
        return bearing - 360 * std::floor(bearing / 360);
    }

    mavlink::Frame attitude(double boot_s) const {
        mavlink::Attitude m;
        m.time_boot_ms = static_cast<std::uint32_t>(std::lround(1e3 * boot_s));
        m.roll = static_cast<float>(roll_rad);
        m.pitch = static_cast<float>(pitch_rad);
        m.yaw = static_cast<float>(std::remainder(yaw_rad, 2 * M_PI));
        m.rollspeed = static_cast<float>(rates_rad_s.x());
        m.pitchspeed = static_cast<float>(rates_rad_s.y());
        m.yawspeed = static_cast<float>(rates_rad_s.z());
        return mavlink::frameOf(m);
    }
    mavlink::Frame quaternion(double boot_s) const {
        // Half angles of the rotations about down, right and forward.
        const double cr = std::cos(roll_rad / 2), sr = std::sin(roll_rad / 2);
        const double cp = std::cos(pitch_rad / 2), sp = std::sin(pitch_rad / 2);
        const double cy = std::cos(yaw_rad / 2), sy = std::sin(yaw_rad / 2);
        mavlink::AttitudeQuaternion m;
        m.time_boot_ms = static_cast<std::uint32_t>(std::lround(1e3 * boot_s));
        m.q1 = static_cast<float>(cr * cp * cy + sr * sp * sy);
        m.q2 = static_cast<float>(sr * cp * cy - cr * sp * sy);
        m.q3 = static_cast<float>(cr * sp * cy + sr * cp * sy);
        m.q4 = static_cast<float>(cr * cp * sy - sr * sp * cy);
        m.rollspeed = static_cast<float>(rates_rad_s.x());
        m.pitchspeed = static_cast<float>(rates_rad_s.y());
        m.yawspeed = static_cast<float>(rates_rad_s.z());
        return mavlink::frameOf(m);
    }
    mavlink::Frame place(double boot_s) const {
        mavlink::LocalPositionNed m;
        m.time_boot_ms = static_cast<std::uint32_t>(std::lround(1e3 * boot_s));
        m.x = static_cast<float>(ned_m.x());
        m.y = static_cast<float>(ned_m.y());
        m.z = static_cast<float>(ned_m.z());
        m.vx = static_cast<float>(speed_m_s.x());
        m.vy = static_cast<float>(speed_m_s.y());
        m.vz = static_cast<float>(speed_m_s.z());
        return mavlink::frameOf(m);
    }
};

}  // namespace hagen::live
