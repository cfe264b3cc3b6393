#include <mrpt/maps/COccupancyGridMap3D.h>

#include <stdexcept>
#include <string>

#include "avoidance/world_models/Maps.h"
#include "avoidance/world_models/VoxelTree.h"

namespace hagen::avoidance {
namespace {

constexpr float kMaxPlaceInCells = 1e6F;  // floats still resolve 1/16 of a cell

mrpt::math::TPoint3D pointOf(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

/// MRPT marks the end of every ray as occupied, even without a return. This restores the end cell
/// of such a ray.
void insertRay(mrpt::maps::COccupancyGridMap3D& map, const mrpt::math::TPoint3D& from,
               const mrpt::math::TPoint3D& to, bool is_hit) {
    auto& grid = map.m_grid;
    auto* end = grid.cellByIndex(grid.x2idx(to.x), grid.y2idx(to.y), grid.z2idx(to.z));
    if (is_hit || end == nullptr) {
        map.insertRay(from, to, is_hit);
        return;
    }
    const auto was = *end;
    map.insertRay(from, to, is_hit);
    *end = was;
}

/// MRPT's COccupancyGridMap3D of all points within the bounds, with a k-d tree of its occupied
/// cells.
class GridModel : public WorldModel {
 public:
    /// Returns beyond `max_range_m` only clear cells, up to this range.
    GridModel(float edge_m, const Eigen::AlignedBox3f& bounds_m, float max_range_m)
        : edge_m_(edge_m),
          max_range_m_(max_range_m),
          map_(std::make_unique<mrpt::maps::COccupancyGridMap3D>()),
          obstacles_(edge_m) {
        // Corners are on whole cells, because MRPT rounds other values. There is one more cell on
        // each side, because MRPT assigns points less than a cell outside to the first cell.
        const Eigen::Array3f min = ((bounds_m.min().array() - kMapMargin_m) / edge_m).floor() - 1;
        const Eigen::Array3f max = ((bounds_m.max().array() + kMapMargin_m) / edge_m).ceil() + 1;
        corner_m_ = min * edge_m;
        const float farthest_m = corner_m_.abs().max((max * edge_m).abs()).maxCoeff();
        if (!(farthest_m <= kMaxPlaceInCells * edge_m)) {
            throw std::runtime_error("a grid with cells of " + std::to_string(edge_m) +
                                     " m cannot cover positions up to " +
                                     std::to_string(farthest_m) +
                                     " m; shift the origin of the coordinates towards the path");
        }
        map_->setSize(pointOf(corner_m_), pointOf(max * edge_m), edge_m);
        const auto& grid = map_->m_grid;  // rounded by MRPT
        size_ = {static_cast<int>(grid.getSizeX()), static_cast<int>(grid.getSizeY()),
                 static_cast<int>(grid.getSizeZ())};
    }

    void update(const observations::MappedScan& scan) override {
        const mrpt::math::TPoint3D origin = pointOf(scan.origin_m);
        for (const Eigen::Vector3f& point_m : scan.points_m) {
            const Eigen::Vector3f ray = point_m - scan.origin_m;
            const float range_m = ray.norm();
            const bool is_hit = range_m <= max_range_m_;
            const Eigen::Vector3f end_m =
                is_hit ? point_m : scan.origin_m + ray * (max_range_m_ / range_m);
            insertRay(*map_, origin, pointOf(end_m), is_hit);
        }
        for (const Eigen::Vector3f& to_m : scan.passed_to_m) {
            const Eigen::Vector3f ray = to_m - scan.origin_m;
            const float share = std::min(1.0f, max_range_m_ / ray.norm());
            insertRay(*map_, origin, pointOf(scan.origin_m + ray * share), false);
        }
        obstacles_.rebuild(occupied_m());
    }
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override {
        return obstacles_.distance_m(point_m, std::min(limit_m, kReach_m));
    }
    bool isKnown(const Eigen::Vector3f& point_m) const override {
        const Eigen::Array3f cell = ((point_m.array() - corner_m_) / edge_m_).floor();
        if ((cell < 0).any() || (cell >= size_.cast<float>()).any()) return false;
        const Eigen::Array3i at = cell.cast<int>();
        const auto i = static_cast<std::size_t>((at.z() * size_.y() + at.y()) * size_.x() + at.x());
        return map_->m_grid.data()[i] != 0;
    }
    std::size_t bytes() const override {
        return sizeof(*this) + sizeof(*map_) + map_->m_grid.getVoxelCount() + obstacles_.bytes();
    }
    Obstacles obstacles() const override { return {obstacles_.centres_m(), edge_m_}; }

 private:
    std::vector<Eigen::Vector3f> occupied_m() const {
        std::vector<Eigen::Vector3f> centres_m;
        const auto& cells = map_->m_grid.data();  // log odds of being free
        std::size_t i = 0;
        for (int z = 0; z < size_.z(); ++z) {
            for (int y = 0; y < size_.y(); ++y) {
                for (int x = 0; x < size_.x(); ++x, ++i) {
                    if (cells[i] >= 0) continue;
                    const Eigen::Array3f cell(static_cast<float>(x), static_cast<float>(y),
                                              static_cast<float>(z));
                    centres_m.push_back(corner_m_ + (cell + 0.5f) * edge_m_);
                }
            }
        }
        return centres_m;
    }

    float edge_m_, max_range_m_;
    Eigen::Array3f corner_m_;  ///< minimum corner
    Eigen::Array3i size_;      ///< size in cells
    std::unique_ptr<mrpt::maps::COccupancyGridMap3D> map_;
    VoxelTree obstacles_;
};

}  // namespace

std::unique_ptr<WorldModel> makeGridModel(float edge_m, const Eigen::AlignedBox3f& bounds_m,
                                          float max_range_m) {
    return std::make_unique<GridModel>(edge_m, bounds_m, max_range_m);
}

}  // namespace hagen::avoidance
