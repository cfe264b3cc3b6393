#include "WindowModel.h"

#include <cmath>
#include <nanoflann.hpp>

#include "Nearest.h"
#include "SeenDirections.h"

namespace hagen {

namespace {

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, TreePoints>,
                                                 TreePoints, 3>;
constexpr std::size_t kLeafSize = 32;

}  // namespace

struct WindowModel::PastScan {
    Eigen::Vector3f origin_m;
    TreePoints points;
    SeenDirections seen;
    std::unique_ptr<Tree> tree;
};

WindowModel::WindowModel(bool roi_only) : roi_only_(roi_only) {}
WindowModel::~WindowModel() = default;

void WindowModel::update(const MappedScan& scan) {
    auto past = std::make_unique<PastScan>();
    past->origin_m = scan.origin_m;
    for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
        const Eigen::Vector3f ray = scan.points_m[i] - scan.origin_m;
        past->seen.see(ray);
        const bool counts = !roi_only_ || scan.labels[i] == Label::Roi;
        if (counts && ray.squaredNorm() <= kRadius_m * kRadius_m) {
            past->points.at_m.push_back(scan.points_m[i]);
        }
    }
    past->points.at_m.shrink_to_fit();
    past->tree = std::make_unique<Tree>(3, past->points, kLeafSize);
    scans_.push_front(std::move(past));
    if (scans_.size() > kScans) scans_.pop_back();
}

float WindowModel::clearance_m(const Eigen::Vector3f& point_m) const {
    Nearest nearest(kReach_m);
    for (const auto& scan : scans_) scan->tree->findNeighbors(nearest, point_m.data(), {});
    return std::sqrt(nearest.worstDist());
}

bool WindowModel::isKnown(const Eigen::Vector3f& point_m) const {
    for (const auto& scan : scans_) {
        const Eigen::Vector3f ray = point_m - scan->origin_m;
        if (ray.squaredNorm() <= kRadius_m * kRadius_m && scan->seen.isSeen(ray)) return true;
    }
    return false;
}

std::size_t WindowModel::bytes() const {
    std::size_t bytes = sizeof(*this);
    for (const auto& scan : scans_) {
        bytes += sizeof(PastScan) + sizeof(Tree) + scan->seen.bytes() +
                 scan->points.at_m.capacity() * sizeof(Eigen::Vector3f) +
                 scan->tree->usedMemory(*scan->tree);
    }
    return bytes;
}

WorldModel::Obstacles WindowModel::obstacles() const {
    Obstacles obstacles;
    for (const auto& scan : scans_) {
        obstacles.middle_m.insert(obstacles.middle_m.end(), scan->points.at_m.begin(),
                                  scan->points.at_m.end());
    }
    return obstacles;
}

}  // namespace hagen
