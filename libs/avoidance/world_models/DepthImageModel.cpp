#include "avoidance/world_models/DepthImageModel.h"

#include <algorithm>
#include <cmath>

namespace hagen::avoidance {

namespace {

// Log odds in units of 1/24, as in the rolling grid.
constexpr int kHitLogOdds = 20, kMissLogOdds = 10, kMaxLogOdds = 84;
constexpr float kHalfRow = 2.2f;  ///< one degree in image rows; VLP-16 rows are 2 degrees apart
// Cells are looked up in finer images than voxels, for a tighter outline. The image of a cell must
// not be finer than those of its voxels, so that its pixels contain theirs.
constexpr float kVoxelHalf = 1.25f, kCellHalf = 1.875f;
constexpr std::uint64_t kAll = ~std::uint64_t{0};

}  // namespace

DepthImageModel::DepthImageModel(float edge_m, const FlightPace& pace)
    : max_range_m_(windowSizeFor(pace).radius_m),
      box_(edge_m, rollingReachFor(pace)),
      unknown_(box_),
      occupied_(box_),
      log_odds_(box_.voxels(), 0),
      hit_(box_.blocks(), 0) {
    for (std::size_t block = 0; block < box_.blocks(); ++block) unknown_.setBlock(block, kAll);
}

void DepthImageModel::update(const observations::MappedScan& scan) {
    for (const std::uint32_t block : box_.moveTo(scan.origin_m)) {
        unknown_.setBlock(block, kAll);
        occupied_.setBlock(block, 0);
    }
    image_.project(scan.points_m, scan.origin_m);
    addHits(scan);
    clearSeenThrough(scan.origin_m);
    removeKnown(scan.origin_m);
    for (const std::uint32_t block : hits_) hit_[block] = 0;
}

void DepthImageModel::addHits(const observations::MappedScan& scan) {
    hits_.clear();
    for (const Eigen::Vector3f& point_m : scan.points_m) {
        if ((point_m - scan.origin_m).squaredNorm() > max_range_m_ * max_range_m_) continue;
        const Eigen::Array3f at = box_.inVoxels(point_m);
        if (!box_.holds(at)) continue;
        const std::uint32_t index = box_.indexOf(at.cast<int>()), block = index / 64;
        const std::uint64_t bit = std::uint64_t{1} << (index % 64);
        if (hit_[block] & bit) continue;
        if (hit_[block] == 0) hits_.push_back(block);
        hit_[block] |= bit;
        const int was = occupied_.has(index) ? log_odds_[index] : 0;
        log_odds_[index] = static_cast<std::int8_t>(std::min(was + kHitLogOdds, kMaxLogOdds));
        occupied_.setBlock(block, occupied_.block(block) | bit);
        unknown_.setBlock(block, unknown_.block(block) & ~bit);
    }
}

void DepthImageModel::clearSeenThrough(const Eigen::Vector3f& origin_m) {
    for (std::size_t group = 0; group < occupied_.groups(); ++group) {
        forEachBit(occupied_.group(group), [&](unsigned of_group) {
            const std::size_t block = 64 * group + of_group;
            std::uint64_t occupied = occupied_.block(block);
            const Eigen::Array3i first = box_.placeOf(static_cast<std::uint32_t>(block));
            const std::uint64_t seen_through =
                nearerVoxels(cornerOf(first, origin_m), occupied & ~hit_[block], 0);
            forEachBit(seen_through, [&](unsigned bit) {
                std::int8_t& log_odds = log_odds_[64 * block + bit];
                log_odds = static_cast<std::int8_t>(log_odds - kMissLogOdds);
                if (log_odds < 0) occupied &= ~(std::uint64_t{1} << bit);
            });
            if (occupied != occupied_.block(block)) occupied_.setBlock(block, occupied);
        });
    }
}

/// Descends into unknown space and removes what the scan shows to be free.
void DepthImageModel::removeKnown(const Eigen::Vector3f& origin_m) {
    constexpr int kGroup = RollingBox::kGroup, kBlock = RollingBox::kBlock;
    for (std::size_t group = 0; group < unknown_.groups(); ++group) {
        const std::uint64_t blocks = unknown_.group(group);
        if (blocks == 0) continue;
        // A group at the box's border has blocks at both ends of the box.
        const Eigen::Array3i corner = box_.placeOf(static_cast<std::uint32_t>(64 * group));
        const bool is_whole = (corner + kGroup <= box_.size()).all();
        if (is_whole && !mayHaveFree(cornerOf(corner, origin_m), kGroup)) continue;
        forEachBit(blocks, [&](unsigned of_group) {
            const std::size_t block = 64 * group + of_group;
            const Eigen::Array3i first = box_.placeOf(static_cast<std::uint32_t>(block));
            const Eigen::Vector3f to_corner = cornerOf(first, origin_m);
            if (!mayHaveFree(to_corner, kBlock)) return;
            const std::uint64_t unknown = unknown_.block(block);
            const std::uint64_t free = nearerVoxels(to_corner, unknown, kHalfRow);
            if (free != 0) unknown_.setBlock(block, unknown & ~free);
        });
    }
}

/// The middle of a cell's first voxel as seen from the sensor.
Eigen::Vector3f DepthImageModel::cornerOf(const Eigen::Array3i& first,
                                          const Eigen::Vector3f& origin_m) const {
    return box_.centre_m(first) - origin_m;
}

/// The outline of a cell with an edge of `voxels`, given by the middle of its first voxel.
DepthImageModel::Outline DepthImageModel::outlineOf(const Eigen::Vector3f& to_corner_m,
                                                    int voxels) const {
    Outline outline;
    const float half_m = 0.5f * box_.edge_m();
    outline.to_middle_m =
        to_corner_m + Eigen::Vector3f::Constant(half_m * static_cast<float>(voxels - 1));
    outline.spread_m = std::sqrt(3.0f) * half_m * static_cast<float>(voxels - 1) + 1e-3f;
    outline.min_away_m = std::max(outline.to_middle_m.norm() - outline.spread_m, half_m);
    outline.min_around_m =
        std::max(outline.to_middle_m.head<2>().norm() - outline.spread_m, half_m);
    outline.half_columns = DepthImage::kPixelsPerUnit * half_m / outline.min_around_m;
    outline.half_rows = DepthImage::kPixelsPerUnit * half_m / outline.min_away_m;
    return outline;
}

/// The requested voxels of a block that are nearer than all returns in their part of the image,
/// which must contain a return. A part is as large as the block's nearest voxel, and at least
/// `min_half_rows` up and down.
std::uint64_t DepthImageModel::nearerVoxels(const Eigen::Vector3f& to_corner_m,
                                            std::uint64_t voxels, float min_half_rows) const {
    const Outline outline = outlineOf(to_corner_m, RollingBox::kBlock);
    if (outline.min_away_m > max_range_m_) return 0;
    const DepthImage::Block block =
        DepthImage::block(to_corner_m, box_.edge_m(), outline.half_columns,
                          std::max(outline.half_rows, min_half_rows), kVoxelHalf);
    const float to_back_m = std::sqrt(0.75f) * box_.edge_m();
    std::uint64_t nearer = 0;
    forEachBit(voxels, [&](unsigned bit) {
        const bool is_nearer = block.away_m[bit] <= max_range_m_ &&
                               block.away_m[bit] + to_back_m < image_.depths(block, bit).nearest_m;
        nearer |= std::uint64_t{is_nearer} << bit;
    });
    return nearer;
}

/// Whether nearerVoxels() with kHalfRow may find voxels in a cell; false only if it finds none.
bool DepthImageModel::mayHaveFree(const Eigen::Vector3f& to_corner_m, int voxels) const {
    const Outline outline = outlineOf(to_corner_m, voxels);
    if (outline.min_away_m > max_range_m_) return false;
    // The centres of voxels are within the spread of the cell's centre. The gradient of a column is
    // at most 1 / (distance from the vertical axis), that of a row 1 / (distance).
    const float spread = DepthImage::kPixelsPerUnit * outline.spread_m;
    const DepthImage::Depths depths = image_.depthsAround(
        DepthImage::placeOf(outline.to_middle_m),
        outline.half_columns + spread / outline.min_around_m,
        std::max(outline.half_rows, kHalfRow) + spread / outline.min_away_m, kCellHalf);
    return outline.min_away_m < depths.farthest_m;
}

float DepthImageModel::clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const {
    return occupied_.distance_m(box_, point_m, std::min(limit_m, kReach_m));
}

bool DepthImageModel::isKnown(const Eigen::Vector3f& point_m) const {
    const Eigen::Array3f at = box_.inVoxels(point_m);
    return box_.holds(at) && !unknown_.has(box_.indexOf(at.cast<int>()));
}

std::size_t DepthImageModel::bytes() const {
    return sizeof(*this) + box_.bytes() + image_.bytes() + unknown_.bytes() + occupied_.bytes() +
           log_odds_.capacity() + hit_.capacity() * sizeof(std::uint64_t) +
           hits_.capacity() * sizeof(std::uint32_t);
}

WorldModel::Obstacles DepthImageModel::obstacles() const {
    return {occupied_.centres_m(box_), box_.edge_m()};
}

}  // namespace hagen::avoidance
