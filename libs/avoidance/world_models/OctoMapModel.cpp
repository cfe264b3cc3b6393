#include <hagen/mrpt/ScanMap.h>

#include <array>
#include <cstdint>
#include <set>

#include "avoidance/world_models/Maps.h"
#include "avoidance/world_models/VoxelTree.h"

namespace hagen::avoidance {
namespace {

octomap::point3d octomapPoint(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

/// An OctoMap within the bounds, and a k-d tree of its occupied voxels, updated by the map's change
/// detection.
class OctoMapModel : public WorldModel {
 public:
    OctoMapModel(const observations::ScanMapOptions& options, const Eigen::AlignedBox3f& bounds_m)
        : map_(options), obstacles_(static_cast<float>(options.resolution_m)) {
        const Eigen::Vector3f margin = Eigen::Vector3f::Constant(kMapMargin_m);
        octomap::point3d min = octomapPoint(bounds_m.min() - margin);
        octomap::point3d max = octomapPoint(bounds_m.max() + margin);
        map_.tree().setBBXMin(min);
        map_.tree().setBBXMax(max);
        map_.tree().useBBXLimit(true);
        map_.tree().enableChangeDetection(true);
    }

    void update(const observations::MappedScan& scan) override {
        map_.insert(scan);
        noteChanges();
        std::vector<Eigen::Vector3f> centres_m;
        centres_m.reserve(occupied_.size());
        for (const Key& key : occupied_) {
            const octomap::point3d middle =
                map_.tree().keyToCoord(octomap::OcTreeKey(key[0], key[1], key[2]));
            centres_m.emplace_back(middle.x(), middle.y(), middle.z());
        }
        obstacles_.rebuild(std::move(centres_m));
    }
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override {
        return obstacles_.distance_m(point_m, std::min(limit_m, kReach_m));
    }
    bool isKnown(const Eigen::Vector3f& point_m) const override {
        octomap::OcTreeKey key;
        return map_.tree().coordToKeyChecked(octomapPoint(point_m), key) && map_.tree().search(key);
    }
    std::size_t bytes() const override {
        constexpr std::size_t kBytesOfSetNode = 32 + sizeof(Key);
        return sizeof(*this) + map_.bytes() + obstacles_.bytes() +
               occupied_.size() * kBytesOfSetNode;
    }
    Obstacles obstacles() const override {
        return {obstacles_.centres_m(), static_cast<float>(map_.options().resolution_m)};
    }

 private:
    using Key = std::array<std::uint16_t, 3>;
    void noteChanges() {
        octomap::OcTree& tree = map_.tree();
        for (auto change = tree.changedKeysBegin(); change != tree.changedKeysEnd(); ++change) {
            const octomap::OcTreeKey& key = change->first;
            if (tree.isNodeOccupied(tree.search(key))) {
                occupied_.insert({key[0], key[1], key[2]});
            } else {
                occupied_.erase({key[0], key[1], key[2]});
            }
        }
        tree.resetChangeDetection();
    }

    observations::ScanMap map_;
    std::set<Key> occupied_;  ///< ordered, so that results do not depend on a hash
    VoxelTree obstacles_;
};

}  // namespace

std::unique_ptr<WorldModel> makeOctoMap(const observations::ScanMapOptions& options,
                                        const Eigen::AlignedBox3f& bounds_m) {
    return std::make_unique<OctoMapModel>(options, bounds_m);
}

}  // namespace hagen::avoidance
