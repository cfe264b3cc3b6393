#include "avoidance/world_models/WindowModel.h"

#include <algorithm>
#include <cmath>

#include "avoidance/world_models/Nearest.h"
#include "avoidance/world_models/Thinning.h"

namespace hagen::avoidance {

namespace {

constexpr std::size_t kWindowLeafSize = 32;
constexpr double kTurnsPerTree = 3;
constexpr double kRounding_turns = 1e-6;

// Isolated points.
constexpr float kNeighbourhood = 0.05f;  // fraction of the range: 1.5 rows of a VLP-16
constexpr float kMinNeighbourhood_m = 0.15f;

struct PastView {
    std::shared_ptr<const View> view;
    std::size_t points;  ///< points of the scan
    double turns;        ///< turns of the sensor
};

}  // namespace

struct WindowModel::PastScans {
    std::vector<PastView> views;            ///< newest first
    TreePoints points;                      ///< in the order of the views; includes dropped scans
    std::vector<std::uint32_t> track;       ///< per point; 0: none
    std::vector<std::uint8_t> is_isolated;  ///< per point
    std::vector<std::uint8_t> is_hidden;    ///< per point: whether it is ignored
    std::size_t in_window = 0;
    double turns = 0;  ///< including dropped scans
    std::unique_ptr<PointTree> tree;

    void add(const PastScans& older) {
        turns += older.turns;
        views.insert(views.end(), older.views.begin(), older.views.end());
        points.at_m.insert(points.at_m.end(), older.points.at_m.begin(), older.points.at_m.end());
        track.insert(track.end(), older.track.begin(), older.track.end());
        is_isolated.insert(is_isolated.end(), older.is_isolated.begin(), older.is_isolated.end());
    }
    void build() {
        points.at_m.shrink_to_fit();
        in_window = points.at_m.size();
        tree = std::make_unique<PointTree>(3, points, kWindowLeafSize);
    }
    bool hasAny(const Eigen::Vector3f& near_m, AnyWithin any) const {
        tree->findNeighbors(any, near_m.data(), {});
        return any.found();
    }
};

WindowModel::WindowModel(bool roi_only, WindowSize size) : roi_only_(roi_only), size_(size) {}
WindowModel::~WindowModel() = default;

void WindowModel::update(const observations::MappedScan& scan) {
    update(scan, std::make_shared<const View>(viewOf(scan)), {});
}

void WindowModel::update(const observations::MappedScan& scan, std::shared_ptr<const View> view,
                         const std::vector<std::uint32_t>& track_of_obstacle) {
    auto past = std::make_unique<PastScans>();
    std::vector<Eigen::Vector3f> points_m;
    std::vector<std::uint32_t> tracks;
    const auto trackOf = [&](std::size_t i) {
        const auto obstacle =
            scan.obstacles.empty() ? 0 : static_cast<std::size_t>(scan.obstacles[i]);
        return obstacle < track_of_obstacle.size() ? track_of_obstacle[obstacle] : 0;
    };
    for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
        const Eigen::Vector3f ray = scan.points_m[i] - scan.origin_m;
        const bool counts = !roi_only_ || scan.labels[i] == Label::Roi;
        if (counts && ray.squaredNorm() <= size_.radius_m * size_.radius_m) {
            points_m.push_back(scan.points_m[i]);
            tracks.push_back(trackOf(i));
        }
    }
    for (const ThinnedPoint& kept : thinnedPoints(points_m, scan.origin_m, kThinning_m)) {
        past->points.at_m.push_back(points_m[kept.index]);
        past->track.push_back(tracks[kept.index]);
        past->is_isolated.push_back(kept.of_points == 1);
    }
    past->views.push_back({std::move(view), past->points.at_m.size(), scan.turns});
    past->turns = scan.turns;
    gather(std::move(past));
    turns_ += scan.turns;
    // Keeps one update more than fits, so that sectors never cover less than whole scans.
    while (turns_ - past_.back()->views.back().turns >
           static_cast<double>(size_.scans) - kRounding_turns) {
        forgetOldest();
    }
    confirmIsolated();
    hide({});
}

/// Adds the newest points to a tree: a whole scan to a tree of three scans, sectors to a tree of
/// one turn, which is merged with two others when full.
void WindowModel::gather(std::unique_ptr<PastScans> newest) {
    const auto fits = [](const PastScans& older, double turns, double max) {
        return older.turns + turns <= max + kRounding_turns;
    };
    const bool is_sector = newest->turns < 1 - kRounding_turns;
    if (!past_.empty() && fits(*past_.front(), newest->turns, is_sector ? 1 : kTurnsPerTree)) {
        newest->add(*past_.front());
        past_.pop_front();
    } else if (is_sector && past_.size() > 1 &&
               fits(*past_[1], past_.front()->turns, kTurnsPerTree)) {
        const std::unique_ptr<PastScans> older = std::move(past_[1]);
        past_.erase(past_.begin() + 1);
        past_.front()->add(*older);
        past_.front()->build();
    }
    newest->build();
    past_.push_front(std::move(newest));
}

/// Isolated points of the newest scan are confirmed by any other point near them; older unconfirmed
/// points by the newest scan.
void WindowModel::confirmIsolated() {
    const PastScans& newest = *past_.front();
    const PastView& last = newest.views.front();
    const auto hasNeighbour = [&](const PastScans& past, std::size_t i, bool is_of_newest) {
        const Eigen::Vector3f point_m = past.points.at_m[i];
        const float radius_m =
            std::max(kMinNeighbourhood_m, kNeighbourhood * (point_m - last.view->origin_m).norm());
        if (!is_of_newest) return newest.hasAny(point_m, {radius_m, last.points});
        return std::any_of(past_.begin(), past_.end(), [&](const auto& other) {
            const bool is_own = other.get() == &past;
            return other->hasAny(point_m,
                                 {radius_m, other->in_window,
                                  is_own ? static_cast<std::uint32_t>(i) : AnyWithin::kNone});
        });
    };
    for (const auto& past : past_) {
        for (std::size_t i = 0; i < past->in_window; ++i) {
            if (!past->is_isolated[i]) continue;
            const bool is_of_newest = past == past_.front() && i < last.points;
            past->is_isolated[i] = !hasNeighbour(*past, i, is_of_newest);
        }
    }
}

void WindowModel::hide(const std::vector<std::uint32_t>& tracks) {
    for (const auto& past : past_) {
        past->is_hidden = past->is_isolated;
        if (tracks.empty()) continue;
        for (std::size_t i = 0; i < past->is_hidden.size(); ++i) {
            past->is_hidden[i] |=
                std::find(tracks.begin(), tracks.end(), past->track[i]) != tracks.end();
        }
    }
}

/// The oldest scan's points stay in the shared tree, but are ignored.
void WindowModel::forgetOldest() {
    PastScans& oldest = *past_.back();
    oldest.in_window -= oldest.views.back().points;
    turns_ -= oldest.views.back().turns;
    oldest.views.pop_back();
    if (oldest.views.empty()) past_.pop_back();
}

float WindowModel::clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const {
    Nearest nearest(std::min(limit_m, kReach_m));
    for (const auto& past : past_) {
        nearest.consider(past->in_window, past->is_hidden.data());
        past->tree->findNeighbors(nearest, point_m.data(), {});
    }
    return std::sqrt(nearest.worstDist());
}

bool WindowModel::isKnown(const Eigen::Vector3f& point_m) const {
    for (const auto& past : past_) {
        for (const PastView& at : past->views) {
            const Eigen::Vector3f ray = point_m - at.view->origin_m;
            if (ray.squaredNorm() <= size_.radius_m * size_.radius_m && at.view->seen.isSeen(ray)) {
                return true;
            }
        }
    }
    return false;
}

std::size_t WindowModel::bytes() const {
    std::size_t bytes = sizeof(*this);
    for (const auto& past : past_) {
        bytes += sizeof(PastScans) + sizeof(PointTree) +
                 past->points.at_m.capacity() * sizeof(Eigen::Vector3f) +
                 past->track.capacity() * sizeof(std::uint32_t) + past->is_isolated.capacity() +
                 past->is_hidden.capacity() + past->tree->usedMemory(*past->tree);
        for (const PastView& at : past->views) {
            bytes += sizeof(at) + sizeof(View) + at.view->seen.bytes();
        }
    }
    return bytes;
}

WorldModel::Obstacles WindowModel::obstacles() const {
    Obstacles obstacles;
    for (const auto& past : past_) {
        for (std::size_t i = 0; i < past->in_window; ++i) {
            if (past->is_hidden[i]) continue;
            obstacles.centre_m.push_back(past->points.at_m[i]);
        }
    }
    return obstacles;
}

}  // namespace hagen::avoidance
