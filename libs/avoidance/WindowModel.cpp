#include "WindowModel.h"

#include <cmath>
#include <nanoflann.hpp>

#include "SeenDirections.h"

namespace hagen {

namespace {

/// Points as nanoflann reads them.
struct Points {
    std::vector<Eigen::Vector3f> at_m;

    std::size_t kdtree_get_point_count() const { return at_m.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return at_m[i][static_cast<Eigen::Index>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3>;
constexpr std::size_t kLeafSize = 32;

/// The least squared distance, of several trees one after the other.
class Nearest {
 public:
    explicit Nearest(float beyond_m2) : least_m2_(beyond_m2) {}

    bool addPoint(float distance_m2, std::uint32_t) {
        least_m2_ = std::min(least_m2_, distance_m2);
        return true;
    }
    float worstDist() const { return least_m2_; }
    std::size_t size() const { return 1; }
    bool full() const { return true; }

 private:
    float least_m2_;
};

}  // namespace

struct WindowModel::PastScan {
    Eigen::Vector3f origin_m;
    Points points;
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
    Nearest nearest(kReach_m * kReach_m);
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
