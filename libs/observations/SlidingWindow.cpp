#include <hagen/observations/SlidingWindow.h>
#include <stdexcept>
#include <string>

namespace hagen::observations {
namespace {

template <class T>
void append(const std::vector<T>& from, std::vector<T>& to) {
    to.insert(to.end(), from.begin(), from.end());
}

/// Appends the returns of `past`, transformed into the frame of `here`.
void appendTransformed(const Scan& past, const mrpt::poses::CPose3D& from,
                       const mrpt::poses::CPose3D& here, Scan& window) {
    const mrpt::poses::CPose3D seen_from_here = from - here;
    for (std::size_t i = 0; i < past.size(); ++i) {
        const mrpt::math::TPoint3D point =
            seen_from_here.composePoint({past.x_m[i], past.y_m[i], past.z_m[i]});
        window.x_m.push_back(static_cast<float>(point.x));
        window.y_m.push_back(static_cast<float>(point.y));
        window.z_m.push_back(static_cast<float>(point.z));
    }
    append(past.intensity, window.intensity);
}

}  // namespace

SlidingWindow::SlidingWindow(int scans) : scans_(static_cast<std::size_t>(scans)) {
    if (scans < 1)
        throw std::invalid_argument("a window contains at least 1 scan, not " +
                                    std::to_string(scans));
}

const Scan& SlidingWindow::add(const Scan& newest, const mrpt::poses::CPose3D& sensor_pose,
                               const SensorModel& sensor) {
    window_.clear();
    for (const PastScan& past : past_) {
        appendTransformed(past.scan, past.sensor_pose, sensor_pose, window_);
    }
    locateBeams(sensor, window_);

    // The newest scan keeps the sensor's own values; it comes first.
    const auto prepend = [](const auto& from, auto& to) {
        to.insert(to.begin(), from.begin(), from.end());
    };
    prepend(newest.x_m, window_.x_m);
    prepend(newest.y_m, window_.y_m);
    prepend(newest.z_m, window_.z_m);
    prepend(newest.intensity, window_.intensity);
    prepend(newest.range_m, window_.range_m);
    prepend(newest.azimuth_rad, window_.azimuth_rad);
    prepend(newest.row, window_.row);

    past_.push_front({newest, sensor_pose});
    if (past_.size() >= scans_) past_.pop_back();
    return window_;
}

}  // namespace hagen::observations
