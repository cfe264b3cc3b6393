#include "WindowModel.h"

#include <cmath>
#include <nanoflann.hpp>

#include "Nearest.h"
#include "SeenDirections.h"
#include "Thinning.h"

namespace hagen::avoidance {

namespace {

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, TreePoints>,
                                                 TreePoints, 3>;
constexpr std::size_t kLeafSize = 32;
constexpr std::size_t kScansPerTree = 3;

/// The origin of a scan, its farthest returns by direction, and its number of points.
struct View {
    Eigen::Vector3f origin_m;
    SeenDirections seen;
    std::size_t points = 0;
};

}  // namespace

struct WindowModel::PastScans {
    std::vector<View> views;  ///< newest first
    TreePoints points;        ///< in the order of the views; includes dropped scans
    std::size_t in_window = 0;
    std::unique_ptr<Tree> tree;

    void add(const PastScans& older) {
        views.insert(views.end(), older.views.begin(), older.views.end());
        points.at_m.insert(points.at_m.end(), older.points.at_m.begin(), older.points.at_m.end());
    }
    void build() {
        points.at_m.shrink_to_fit();
        in_window = points.at_m.size();
        tree = std::make_unique<Tree>(3, points, kLeafSize);
    }
};

WindowModel::WindowModel(bool roi_only, WindowSize size) : roi_only_(roi_only), size_(size) {}
WindowModel::~WindowModel() = default;

void WindowModel::update(const mapping::MappedScan& scan) {
    auto past = std::make_unique<PastScans>();
    View view;
    view.origin_m = scan.origin_m;
    for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
        const Eigen::Vector3f ray = scan.points_m[i] - scan.origin_m;
        view.seen.see(ray);
        const bool counts = !roi_only_ || scan.labels[i] == Label::Roi;
        if (counts && ray.squaredNorm() <= size_.radius_m * size_.radius_m) {
            past->points.at_m.push_back(scan.points_m[i]);
        }
    }
    past->points.at_m = thinned(past->points.at_m, scan.origin_m, kThinning_m);
    view.points = past->points.at_m.size();
    past->views.push_back(std::move(view));
    if (!past_.empty() && past_.front()->views.size() < kScansPerTree) {
        past->add(*past_.front());
        past_.pop_front();
    }
    past->build();
    past_.push_front(std::move(past));
    if (++scans_ > size_.scans) forgetOldest();
}

/// Its points stay in the shared tree, but no longer count.
void WindowModel::forgetOldest() {
    PastScans& oldest = *past_.back();
    oldest.in_window -= oldest.views.back().points;
    oldest.views.pop_back();
    if (oldest.views.empty()) past_.pop_back();
    --scans_;
}

float WindowModel::clearance_m(const Eigen::Vector3f& point_m) const {
    return clearanceWithin_m(point_m, kReach_m);
}

float WindowModel::clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const {
    Nearest nearest(std::min(limit_m, kReach_m));
    for (const auto& past : past_) {
        nearest.consider(past->in_window);
        past->tree->findNeighbors(nearest, point_m.data(), {});
    }
    return std::sqrt(nearest.worstDist());
}

bool WindowModel::isKnown(const Eigen::Vector3f& point_m) const {
    for (const auto& past : past_) {
        for (const View& view : past->views) {
            const Eigen::Vector3f ray = point_m - view.origin_m;
            if (ray.squaredNorm() <= size_.radius_m * size_.radius_m && view.seen.isSeen(ray)) {
                return true;
            }
        }
    }
    return false;
}

std::size_t WindowModel::bytes() const {
    std::size_t bytes = sizeof(*this);
    for (const auto& past : past_) {
        bytes += sizeof(PastScans) + sizeof(Tree) +
                 past->points.at_m.capacity() * sizeof(Eigen::Vector3f) +
                 past->tree->usedMemory(*past->tree);
        for (const View& view : past->views) bytes += sizeof(View) + view.seen.bytes();
    }
    return bytes;
}

WorldModel::Obstacles WindowModel::obstacles() const {
    Obstacles obstacles;
    for (const auto& past : past_) {
        const auto first = past->points.at_m.begin();
        obstacles.centre_m.insert(obstacles.centre_m.end(), first,
                                  first + static_cast<std::ptrdiff_t>(past->in_window));
    }
    return obstacles;
}

}  // namespace hagen::avoidance
