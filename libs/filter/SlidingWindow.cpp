#include <hagen/filter/SlidingWindow.h>
#include <hagen/scan/Image.h>
#include <algorithm>
#include <cmath>
#include <utility>
#include "scan/AppendReturn.h"
#include "scan/MoveReturns.h"

namespace hagen {

SlidingWindow::SlidingWindow(HagenFilter filter)
    : filter_(std::move(filter)),
      older_(static_cast<std::size_t>(filter_.options().window_scans - 1)) {}

void SlidingWindow::forget() { seen_ = 0; }

SlidingWindow::Place SlidingWindow::placeOf(
    const Scan& scan, const std::optional<Attitude>& attitude,
    const std::optional<Eigen::Isometry3d>& map_from_sensor) {
    if (map_from_sensor) return {Reference::Map, *map_from_sensor};
    const Ground& ground = filter_.segment(scan, attitude).ground;
    if (!ground.is_seen) return {};
    return {Reference::Ground, ground.from_sensor.cast<double>()};
}

/// Appends an older scan to the window.
void SlidingWindow::append(const Older& older, const Place& now) {
    const bool is_known = now.to != Reference::None && older.place.to == now.to;
    if (!is_known) ++without_motion_;
    if (!is_known && filter_.options().window_fills_gaps) return;
    ++older_scans_;
    if (!is_known) return appendReturns(older.scan, window_);
    moved_ = older.scan;
    moveReturns(now.from_sensor.inverse() * older.place.from_sensor, 0, moved_);
    locateInView(filter_.sensor(), moved_);
    for (std::size_t i = 0; i < moved_.size(); ++i) {  // such as the airframe
        if (!std::isfinite(older.scan.range_m[i])) moved_.range_m[i] = kNoValue;
    }
    appendReturns(moved_, window_);
}

const SegmentationResult& SlidingWindow::segment(
    const Scan& newest, const std::optional<Attitude>& attitude,
    const std::optional<Eigen::Isometry3d>& map_from_sensor) {
    older_scans_ = without_motion_ = 0;
    newest_ = &newest;
    if (older_.empty()) return filter_.segment(newest, attitude);

    checkLocated(newest, filter_.sensor());
    const Place now = placeOf(newest, attitude, map_from_sensor);
    window_ = newest;
    window_.intensity.resize(newest.size());
    window_.time_s.clear();
    for (std::size_t age = 1; age <= std::min(seen_, older_.size()); ++age) {
        append(older_[(seen_ - age) % older_.size()], now);
    }
    Older& oldest = older_[seen_ % older_.size()];
    oldest.scan = newest;
    oldest.scan.intensity.resize(newest.size());
    oldest.place = now;
    ++seen_;
    return filter_.segment(window_, attitude, newest);
}

}  // namespace hagen
