#include "GridModel.h"

#include <mrpt/maps/COccupancyGridMap3D.h>

// dynamicEDT3D's headers come with warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#include <dynamicEDT3D/dynamicEDT3D.h>
#pragma GCC diagnostic pop

#include <cmath>

#include "VoxelCube.h"

namespace hagen {

namespace {

constexpr float kMaxRange_m = 20;
constexpr std::size_t kBytesOfCell = 6 * 4;  // dynamicEDT3D's own, which it hides

mrpt::math::TPoint3D pointOf(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

using Cells = Eigen::Array3i;

}  // namespace

/// The least corner lies on whole cells, so that positions and cells agree everywhere.
struct GridModel::Grid {
    Grid(double resolution_m, const Eigen::AlignedBox3f& bounds_m)
        : edge_m(static_cast<float>(resolution_m)), distances(squaredReach(edge_m)) {
        const Eigen::Array3f least = ((bounds_m.min().array() - kMapMargin_m) / edge_m).floor();
        const Eigen::Array3f most = ((bounds_m.max().array() + kMapMargin_m) / edge_m).ceil();
        size = (most - least).cast<int>();
        corner_m = least * edge_m;
        map.setSize(pointOf(corner_m), pointOf(most * edge_m), resolution_m);
        distances.initializeEmpty(size.x(), size.y(), size.z());
        is_occupied.assign(map.m_grid.getVoxelCount(), false);
    }

    static int squaredReach(float edge_m) {
        const int cells = static_cast<int>(kReach_m / edge_m) + 1;
        return cells * cells;
    }

    Cells cellOf(const Eigen::Vector3f& point_m) const {
        return ((point_m.array() - corner_m) / edge_m).floor().cast<int>();
    }
    bool isIn(const Cells& cell) const { return (cell >= 0).all() && (cell < size).all(); }
    Eigen::Vector3f middleOf(int x, int y, int z) const {
        return corner_m + (Eigen::Array3i(x, y, z).cast<float>() + 0.5f) * edge_m;
    }

    float edge_m;
    Eigen::Array3f corner_m;
    Cells size;
    mrpt::maps::COccupancyGridMap3D map;
    DynamicEDT3D distances;
    std::vector<char> is_occupied;  ///< as the distances know it
};

GridModel::GridModel(double resolution_m, const Eigen::AlignedBox3f& bounds_m)
    : grid_(std::make_unique<Grid>(resolution_m, bounds_m)) {}
GridModel::~GridModel() = default;

void GridModel::update(const MappedScan& scan) {
    const mrpt::math::TPoint3D origin = pointOf(scan.origin_m);
    for (const Eigen::Vector3f& point_m : scan.points_m) {
        const Eigen::Vector3f ray = point_m - scan.origin_m;
        const float range_m = ray.norm();
        const bool is_hit = range_m <= kMaxRange_m;
        const Eigen::Vector3f end_m =
            is_hit ? point_m : scan.origin_m + ray * (kMaxRange_m / range_m);
        grid_->map.insertRay(origin, pointOf(end_m), is_hit);
    }
    std::size_t i = 0;
    const auto& cells = grid_->map.m_grid.data();
    for (int z = 0; z < grid_->size.z(); ++z) {
        for (int y = 0; y < grid_->size.y(); ++y) {
            for (int x = 0; x < grid_->size.x(); ++x, ++i) {
                const char is_occupied = cells[i] < 0;
                if (is_occupied == grid_->is_occupied[i]) continue;
                grid_->is_occupied[i] = is_occupied;
                if (is_occupied) {
                    grid_->distances.occupyCell(x, y, z);
                } else {
                    grid_->distances.clearCell(x, y, z);
                }
            }
        }
    }
    grid_->distances.update();
}

float GridModel::clearance_m(const Eigen::Vector3f& point_m) const {
    const Cells cell = grid_->cellOf(point_m);
    if (!grid_->isIn(cell)) return kReach_m;
    const INTPOINT3D nearest = grid_->distances.getClosestObstacle(cell.x(), cell.y(), cell.z());
    if (nearest.x == DynamicEDT3D::invalidObstData) return kReach_m;
    return std::min(
        kReach_m,
        distanceToCube_m(point_m, grid_->middleOf(nearest.x, nearest.y, nearest.z), grid_->edge_m));
}

bool GridModel::isKnown(const Eigen::Vector3f& point_m) const {
    const Cells c = grid_->cellOf(point_m);
    if (!grid_->isIn(c)) return false;
    return *grid_->map.m_grid.cellByIndex(static_cast<unsigned>(c.x()),
                                          static_cast<unsigned>(c.y()),
                                          static_cast<unsigned>(c.z())) != 0;
}

std::size_t GridModel::bytes() const {
    return sizeof(*this) + sizeof(Grid) + grid_->is_occupied.size() * (2 + kBytesOfCell);
}

WorldModel::Obstacles GridModel::obstacles() const {
    Obstacles obstacles;
    obstacles.edge_m = grid_->edge_m;
    std::size_t i = 0;
    for (int z = 0; z < grid_->size.z(); ++z) {
        for (int y = 0; y < grid_->size.y(); ++y) {
            for (int x = 0; x < grid_->size.x(); ++x, ++i) {
                if (grid_->is_occupied[i]) obstacles.middle_m.push_back(grid_->middleOf(x, y, z));
            }
        }
    }
    return obstacles;
}

}  // namespace hagen
