#include "OctoMapModel.h"

// dynamicEDT3D's headers come with warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#include <dynamicEDT3D/dynamicEDTOctomap.h>
#pragma GCC diagnostic pop

#include <cmath>

#include "VoxelCube.h"

namespace hagen {

namespace {

octomap::point3d pointOf(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

constexpr std::size_t kBytesOfCell = 6 * 4;  // dynamicEDT3D's own, which it hides

}  // namespace

struct OctoMapModel::Distances {
    Distances(octomap::OcTree& tree, const Eigen::Vector3f& least_m, const Eigen::Vector3f& most_m)
        : transform(kReach_m, &tree, pointOf(least_m), pointOf(most_m), kUnknownIsFree) {
        const octomap::OcTreeKey least = tree.coordToKey(pointOf(least_m));
        const octomap::OcTreeKey most = tree.coordToKey(pointOf(most_m));
        for (unsigned i = 0; i < 3; ++i) cells *= static_cast<std::size_t>(most[i] - least[i] + 1);
    }

    static constexpr bool kUnknownIsFree = false;
    DynamicEDTOctomap transform;
    std::size_t cells = 1;
};

OctoMapModel::OctoMapModel(MapContent content, double resolution_m,
                           const Eigen::AlignedBox3f& bounds_m)
    : map_({content, resolution_m}) {
    const Eigen::Vector3f margin = Eigen::Vector3f::Constant(kMapMargin_m);
    distances_ =
        std::make_unique<Distances>(map_.tree(), bounds_m.min() - margin, bounds_m.max() + margin);
}
OctoMapModel::~OctoMapModel() = default;

void OctoMapModel::update(const MappedScan& scan) {
    map_.insert(scan);
    distances_->transform.update();
}

float OctoMapModel::clearance_m(const Eigen::Vector3f& point_m) const {
    float distance_m = 0;
    octomap::point3d nearest(NAN, NAN, NAN);
    distances_->transform.getDistanceAndClosestObstacle(pointOf(point_m), distance_m, nearest);
    if (std::isnan(nearest.x())) return kReach_m;  // none, or outside
    return std::min(kReach_m, distanceToCube_m(point_m, {nearest.x(), nearest.y(), nearest.z()},
                                               static_cast<float>(map_.tree().getResolution())));
}

bool OctoMapModel::isKnown(const Eigen::Vector3f& point_m) const {
    octomap::OcTreeKey key;
    return map_.tree().coordToKeyChecked(pointOf(point_m), key) && map_.tree().search(key);
}

std::size_t OctoMapModel::bytes() const {
    return sizeof(*this) + sizeof(Distances) + map_.tree().memoryUsage() +
           distances_->cells * kBytesOfCell;
}

WorldModel::Obstacles OctoMapModel::obstacles() const {
    Obstacles obstacles;
    const octomap::OcTree& tree = map_.tree();
    obstacles.edge_m = static_cast<float>(tree.getResolution());
    for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
        if (!tree.isNodeOccupied(*leaf)) continue;
        const octomap::point3d middle = leaf.getCoordinate();
        obstacles.middle_m.emplace_back(middle.x(), middle.y(), middle.z());
    }
    return obstacles;
}

}  // namespace hagen
