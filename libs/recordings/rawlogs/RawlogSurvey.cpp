#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/recordings/RawlogSurvey.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <array>
#include <utility>

#include "recordings/ScanObject.h"

namespace hagen::recordings {
namespace {

using mrpt::obs::CActionCollection;
using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CActionRobotMovement3D;
using mrpt::obs::CObservation;
using mrpt::poses::CPose3D;

/// Integrates the pose increments of actions into a trajectory.
class SummedMovement {
 public:
    void move(mrpt::Clock::time_point time, const CPose3D& increment) {
        if (!observations::isFinite(increment)) {
            ++trajectory_.not_finite;
            return;
        }
        pose_ = pose_ + increment;
        is_placed_ = time != INVALID_TIMESTAMP;
        has_moved_ = true;
        if (is_placed_) trajectory_.add(time, pose_);
    }
    /// Adds the pose after the previous actions, with the time of a sensory frame.
    void arrive(mrpt::Clock::time_point time) {
        if (!is_placed_) trajectory_.add(time, pose_);
        is_placed_ = true;
    }
    /// The integrated trajectory; empty without movement.
    observations::Trajectory trajectory() const {
        if (has_moved_) return trajectory_;
        observations::Trajectory none;
        none.not_finite = trajectory_.not_finite;
        return none;
    }

 private:
    CPose3D pose_;
    bool is_placed_ = false;  ///< pose_ is already in the trajectory
    bool has_moved_ = false;
    observations::Trajectory trajectory_;
};

class RawlogSurveyor {
 public:
    void see(const CActionCollection& actions) {
        if (const auto movement = actions.getActionByClass<CActionRobotMovement3D>()) {
            summed_3d_.move(movement->timestamp, movement->poseChange.mean);
        }
        if (const auto movement = actions.getActionByClass<CActionRobotMovement2D>()) {
            summed_2d_.move(movement->timestamp, CPose3D(movement->poseChange->getMeanVal()));
        }
    }

    /// Processes the observations of a sensory frame.
    void see(const std::vector<CObservation::Ptr>& frame) {
        if (!frame.empty()) {
            summed_3d_.arrive(frame.front()->timestamp);
            summed_2d_.arrive(frame.front()->timestamp);
        }
        for (const auto& observation : frame) see(*observation);
    }

    void see(const CObservation& observation) {
        const std::string& label = observation.sensorLabel;
        if (const auto* pose =
                dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation)) {
            // Corrects for a pose sensor that is offset from the vehicle's origin.
            robot_poses_[label].add(pose->timestamp, pose->pose.mean + (-pose->sensorPose));
        } else if (const auto* odometry =
                       dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
            odometry_[label].add(odometry->timestamp, CPose3D(odometry->odometry));
        } else if (observations::isLidarScan(observation)) {
            scans_[label].push_back({observation.timestamp, CPose3D(observation.sensorPose())});
        }
    }

    RawlogSurvey survey() && {
        RawlogSurvey survey;
        survey.scans = std::move(scans_);
        const std::map<std::string, observations::Trajectory> summed_3d{
            {"", summed_3d_.trajectory()}};
        const std::map<std::string, observations::Trajectory> summed_2d{
            {"", summed_2d_.trajectory()}};
        using BySensor = std::map<std::string, observations::Trajectory>;
        const std::array<std::pair<std::string, const BySensor*>, 4> sources{
            {{"CObservationRobotPose", &robot_poses_},
             {"CActionRobotMovement3D", &summed_3d},
             {"CObservationOdometry", &odometry_},
             {"CActionRobotMovement2D", &summed_2d}}};
        for (const auto& [kind, trajectories] : sources) {
            for (const auto& [label, one] : *trajectories) survey.not_finite += one.not_finite;
        }
        for (const auto& [kind, trajectories] : sources) {
            for (const auto& [label, trajectory] : *trajectories) {
                if (trajectory.size() <= survey.trajectory.size()) continue;
                survey.trajectory = trajectory;
                survey.trajectory.has_horizon = trajectories == &robot_poses_;
                survey.source = kind + (label.empty() ? "" : " '" + label + "'");
            }
            if (!survey.source.empty()) break;
        }
        return survey;
    }

 private:
    std::map<std::string, observations::Trajectory> robot_poses_, odometry_;  ///< by sensor label
    SummedMovement summed_3d_, summed_2d_;
    std::map<std::string, std::vector<RawlogSurvey::ScanPlace>> scans_;
};

}  // namespace

RawlogSurvey surveyRawlog(const std::filesystem::path& rawlog,
                          const std::function<bool()>& keep_going) {
    RawlogSurveyor surveyor;
    RawlogReader reader(rawlog);
    bool is_whole = true;
    std::string why;
    try {
        while (const auto entry = (is_whole = keep_going()) ? reader.next() : nullptr) {
            if (const auto one = std::dynamic_pointer_cast<CObservation>(entry)) {
                surveyor.see(*one);
            } else if (const auto frame =
                           std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry)) {
                surveyor.see(observationsOf(frame));
            } else if (const auto actions = std::dynamic_pointer_cast<CActionCollection>(entry)) {
                surveyor.see(*actions);
            }
        }
    } catch (const BrokenRecording& e) {
        // The conversion reports the error. Entries before it are valid.
        is_whole = false;
        why = e.what();
    }
    RawlogSurvey survey = std::move(surveyor).survey();
    survey.entries = reader.entries();
    survey.break_found = why;
    survey.is_whole = is_whole;
    return survey;
}

std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimesOf(
    const RawlogSurvey& survey) {
    std::map<std::string, std::vector<mrpt::Clock::time_point>> times;
    for (const auto& [label, places] : survey.scans) {
        for (const RawlogSurvey::ScanPlace& place : places) times[label].push_back(place.time);
    }
    return times;
}

RawlogSurvey withScansOf(RawlogSurvey survey,
                         const std::function<bool(const std::string&)>& isKept) {
    for (auto scans = survey.scans.begin(); scans != survey.scans.end();) {
        scans = isKept(scans->first) ? std::next(scans) : survey.scans.erase(scans);
    }
    return survey;
}

}  // namespace hagen::recordings
