#pragma once
#include <hagen/live/LiveSession.h>
#include <hagen/settings/Settings.h>
#include "live/autopilot/AutopilotLink.h"

#include <memory>
#include <optional>
#include <string>

#include "base/command_line/CommandLine.h"

namespace hagen {

/// The flags of the autopilot link.
struct AutopilotFlags {
    std::string peer;  ///< empty for no link
    int system = 1, nearest = 5;
    double sensor_yaw_deg = 0;
    std::optional<float> height_m;
    bool has_no_ground = false, is_simulated = false;
};

void declareAutopilot(base::Program& app, AutopilotFlags& flags);
/// Throws UsageError for an invalid peer.
void checkAutopilot(const AutopilotFlags& flags);

/// Opens the link and connects it to a session's listener; returns null without --mavlink. Calls
/// `listener.remark` from its own thread. Throws std::runtime_error naming the peer.
std::unique_ptr<live::AutopilotLink> linkAutopilot(const AutopilotFlags& flags,
                                                   const Settings& settings,
                                                   live::LiveListener& listener);
/// The rotation from the sensor to the level vehicle.
Eigen::Matrix3d bodyFromSensor(const AutopilotFlags& flags, const Settings& settings);

std::string summaryOf(const live::AutopilotLink& link);

}  // namespace hagen
