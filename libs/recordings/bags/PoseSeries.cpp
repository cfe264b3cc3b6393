#include "recordings/bags/PoseSeries.h"

#include <hagen/mrpt/Trajectory.h>
#include <mrpt/math/CQuaternion.h>
#include "recordings/Remarks.h"

#include <algorithm>

namespace hagen::recordings {
namespace {

using mrpt::poses::CPose3D;

constexpr double kFarApart_s = 0.5;
constexpr double kMaxGap_s = 0.2;  // maximum gap of Trajectory

}  // namespace

CPose3D poseOf(const RecordedPose& pose) {
    return CPose3D(mrpt::math::CQuaternionDouble(pose.qw, pose.qx, pose.qy, pose.qz), pose.x_m,
                   pose.y_m, pose.z_m);
}

bool isDense(const PoseSeries& series) {
    if (series.poses.size() < 2) return false;
    const double seconds = 1e-9 * (static_cast<double>(series.poses.back().time_ns) -
                                   static_cast<double>(series.poses.front().time_ns));
    return seconds <= kFarApart_s * static_cast<double>(series.poses.size() - 1);
}

bool isStill(const PoseSeries& series) {
    const RecordedPose& first = series.poses.front();
    return std::all_of(series.poses.begin(), series.poses.end(), [&](const RecordedPose& pose) {
        return pose.x_m == first.x_m && pose.y_m == first.y_m && pose.z_m == first.z_m &&
               pose.qw == first.qw && pose.qx == first.qx && pose.qy == first.qy &&
               pose.qz == first.qz;
    });
}

double covered_s(const PoseSeries& series) {
    double all_s = 0;
    for (std::size_t i = 1; i < series.poses.size(); ++i) {
        const double gap_s = 1e-9 * (static_cast<double>(series.poses[i].time_ns) -
                                     static_cast<double>(series.poses[i - 1].time_ns));
        if (gap_s > 0 && gap_s <= kMaxGap_s) all_s += gap_s;
    }
    return all_s;
}

PoseSeries composed(const std::vector<MovingStep>& steps, const std::string& top,
                    const CPose3D& in_top) {
    PoseSeries whole;
    whole.parent = top;
    whole.child = steps.front().series->child;
    whole.source = "transforms from " + whole.parent + " to " + whole.child;
    std::vector<observations::Trajectory> trajectories(steps.size());
    std::vector<std::int64_t> times_ns;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        for (const RecordedPose& pose : steps[i].series->poses) {
            trajectories[i].add(timeOf(pose.time_ns), poseOf(pose));
            times_ns.push_back(pose.time_ns);
        }
    }
    std::sort(times_ns.begin(), times_ns.end());
    // The series with the fewest poses is the most likely to lack a pose.
    const auto isSparser = [](const MovingStep& a, const MovingStep& b) {
        return a.series->poses.size() < b.series->poses.size();
    };
    const observations::Trajectory& sparsest = trajectories[static_cast<std::size_t>(
        std::min_element(steps.begin(), steps.end(), isSparser) - steps.begin())];
    for (const std::int64_t time_ns : times_ns) {
        // Uses doubles, because times in a broken file may overflow integers.
        if (!whole.poses.empty() &&
            static_cast<double>(time_ns) - static_cast<double>(whole.poses.back().time_ns) <
                kMinApart_ns) {
            continue;
        }
        if (!sparsest.at(timeOf(time_ns))) continue;
        std::optional<CPose3D> pose = CPose3D();
        for (std::size_t i = 0; i < steps.size() && pose; ++i) {
            const auto of_step = trajectories[i].at(timeOf(time_ns));
            pose = of_step ? std::optional(*of_step + (steps[i].in_child + *pose)) : std::nullopt;
        }
        if (!pose) continue;
        *pose = in_top + *pose;
        mrpt::math::CQuaternionDouble q;
        pose->getAsQuaternion(q);
        whole.poses.push_back(
            {time_ns, pose->x(), pose->y(), pose->z(), q.r(), q.x(), q.y(), q.z()});
    }
    return whole;
}

}  // namespace hagen::recordings
