#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "avoidance/world_models/Maps.h"
#include "avoidance/world_models/RollingBox.h"
#include "avoidance/world_models/VoxelSet.h"

namespace hagen::avoidance {
namespace {

constexpr std::uint16_t kMax_mm = 65535;

/// The nearest and the farthest return of a scan in each pixel of an image around the sensor, and
/// in a pyramid of coarser images, each half the size of the previous one.
///
/// A pixel is about half a degree: 512 columns, 256 rows. Its coordinates grow with azimuth and
/// elevation but need no inverse trigonometric functions.
class DepthImage {
 public:
    /// A position in the image in pixels: column in [0, 512), row in [0, 256).
    struct Place {
        float column, row;
    };
    struct Depths {
        float nearest_m, farthest_m;  ///< 0: no return
    };
    static constexpr float kPixelsPerUnit = 128;  ///< a unit is about one radian ahead

    DepthImage() {
        std::size_t pixels = 0;
        for (int level = 0; level < kLevels; ++level) {
            first_[level] = pixels;
            pixels += static_cast<std::size_t>((kColumns >> level) * (kRows >> level));
        }
        pixels_.assign(pixels, {kMax_mm, 0});
    }

    /// Columns run around a square whose corners lie on the axes, rows likewise from pole to pole.
    static Place placeOf(const Eigen::Vector3f& ray) {
        const float x = ray.x(), y = ray.y(), z = ray.z();
        const float flat = std::max(std::abs(x) + std::abs(y), 1e-9f);
        const float across = y / flat;
        const float around = x >= 0 ? (y >= 0 ? across : 4 + across) : 2 - across;
        const float rho = std::sqrt(x * x + y * y);
        const float up = z / std::max(rho + std::abs(z), 1e-9f);
        return {around * kPixelsPerUnit, (up + 1) * kPixelsPerUnit};
    }
    void project(const std::vector<Eigen::Vector3f>& points_m, const Eigen::Vector3f& origin_m) {
        std::fill(pixels_.begin(), pixels_.end(), Pixel{kMax_mm, 0});
        for (const Eigen::Vector3f& point_m : points_m) {
            const Eigen::Vector3f ray = point_m - origin_m;
            const float range_mm = std::clamp(1000 * ray.norm(), 1.0f, 65534.0f);
            const Place place = placeOf(ray);
            const int column = static_cast<int>(place.column) & (kColumns - 1);
            const int row = std::clamp(static_cast<int>(place.row), 0, kRows - 1);
            Pixel& pixel = pixels_[indexOf(0, column, row)];
            pixel.nearest_mm = std::min(pixel.nearest_mm, static_cast<std::uint16_t>(range_mm));
            pixel.farthest_mm = std::max(pixel.farthest_mm, static_cast<std::uint16_t>(range_mm));
        }
        for (int level = 1; level < kLevels; ++level) {
            for (int row = 0; row < kRows >> level; ++row) {
                const Pixel* below = &pixels_[indexOf(level - 1, 0, 2 * row)];
                const Pixel* above = &pixels_[indexOf(level - 1, 0, 2 * row + 1)];
                Pixel* pixel = &pixels_[indexOf(level, 0, row)];
                for (int column = 0; column < kColumns >> level; ++column, below += 2, above += 2) {
                    const auto nearer = [](const Pixel* two) {
                        return std::min(two[0].nearest_mm, two[1].nearest_mm);
                    };
                    const auto farther = [](const Pixel* two) {
                        return std::max(two[0].farthest_mm, two[1].farthest_mm);
                    };
                    *pixel++ = {std::min(nearer(below), nearer(above)),
                                std::max(farther(below), farther(above))};
                }
            }
        }
    }

    /// Depths within a rectangle of pixels around a place. It is enlarged to whole pixels of the
    /// finest image in which half of it spans at most `max_half` rows and 16 times as many columns
    /// (columns are narrow near the poles).
    Depths depthsAround(const Place& place, float half_columns, float half_rows,
                        float max_half) const {
        const int level = levelFor(half_columns, half_rows, max_half);
        const float scale = 1 / static_cast<float>(1 << level);
        const int columns = kColumns >> level, rows = kRows >> level;
        const auto pixelOf = [&](float at) { return static_cast<int>(std::floor(at * scale)); };
        const int left = pixelOf(place.column - half_columns);
        return depthsIn(level, left,
                        std::min(pixelOf(place.column + half_columns), left + columns - 1),
                        std::clamp(pixelOf(place.row - half_rows), 0, rows - 1),
                        std::clamp(pixelOf(place.row + half_rows), 0, rows - 1));
    }

    /// 4 x 4 x 4 places, processed at once in the order of a block of RollingBox, and the rectangle
    /// of pixels around each place in the image of one level.
    using Values = Eigen::Array<float, 64, 1>;
    using Pixels = Eigen::Array<int, 64, 1>;
    struct Block {
        Values away_m;
        Pixels left, right, low, high;
        int level;
    };
    static Block block(const Eigen::Vector3f& to_first_m, float step_m, float half_columns,
                       float half_rows, float max_half) {
        static const Values kX = Values::NullaryExpr([](Eigen::Index i) { return float(i & 3); });
        static const Values kY =
            Values::NullaryExpr([](Eigen::Index i) { return float(i >> 2 & 3); });
        static const Values kZ = Values::NullaryExpr([](Eigen::Index i) { return float(i >> 4); });
        const Values x = to_first_m.x() + step_m * kX, y = to_first_m.y() + step_m * kY,
                     z = to_first_m.z() + step_m * kZ;
        Block block;
        const Values around2 = x.square() + y.square();
        block.away_m = (around2 + z.square()).sqrt();
        // Like placeOf(), without branches.
        const Values across = y / (x.abs() + y.abs()).max(1e-9f);
        const Values column = (x >= 0).select((y >= 0).select(across, 4 + across), 2 - across);
        const Values row = z / (around2.sqrt() + z.abs()).max(1e-9f);
        block.level = levelFor(half_columns, half_rows, max_half);
        const float scale = 1 / static_cast<float>(1 << block.level);
        const float per_unit = kPixelsPerUnit * scale;
        const int columns = kColumns >> block.level, rows = kRows >> block.level;
        // Adding whole turns keeps columns positive, so that truncation rounds down.
        const float turns = static_cast<float>(2 * columns);
        const float wide = std::min(half_columns * scale, 0.5f * static_cast<float>(columns - 1));
        block.left = (column * per_unit + (turns - wide)).cast<int>();
        block.right = (column * per_unit + (turns + wide)).cast<int>();
        const Values middle = (row + 1) * per_unit;
        block.low = (middle - half_rows * scale).max(0.0f).cast<int>().min(rows - 1);
        block.high = (middle + half_rows * scale).max(0.0f).cast<int>().min(rows - 1);
        return block;
    }
    Depths depths(const Block& block, unsigned place) const {
        return depthsIn(block.level, block.left[place], block.right[place], block.low[place],
                        block.high[place]);
    }

    std::size_t bytes() const { return pixels_.capacity() * sizeof(Pixel); }

 private:
    static constexpr int kColumns = 512, kRows = 256, kLevels = 9;
    struct Pixel {
        std::uint16_t nearest_mm, farthest_mm;
    };
    static int levelFor(float half_columns, float half_rows, float max_half) {
        constexpr float kMoreColumns = 16;
        int level = 0;
        float half = std::max(half_columns / kMoreColumns, half_rows);
        for (; half > max_half && level < kLevels - 1; half /= 2) ++level;
        return level;
    }
    Depths depthsIn(int level, int left, int right, int low, int high) const {
        const int columns = kColumns >> level;
        std::uint16_t nearest_mm = kMax_mm, farthest_mm = 0;
        for (int row = low; row <= high; ++row) {
            for (int column = left; column <= right; ++column) {
                const Pixel& pixel = pixels_[indexOf(level, column & (columns - 1), row)];
                nearest_mm = std::min(nearest_mm, pixel.nearest_mm);
                farthest_mm = std::max(farthest_mm, pixel.farthest_mm);
            }
        }
        if (farthest_mm == 0) return {0, 0};
        return {1e-3f * static_cast<float>(nearest_mm), 1e-3f * static_cast<float>(farthest_mm)};
    }
    std::size_t indexOf(int level, int column, int row) const {
        return first_[level] + static_cast<std::size_t>((row << (9 - level)) + column);
    }

    std::size_t first_[kLevels];  ///< index of each level's first pixel
    std::vector<Pixel> pixels_;
};

// Log odds in units of 1/24, as in the rolling grid.
constexpr int kHitLogOdds = 20, kMissLogOdds = 10, kMaxLogOdds = 84;
constexpr float kHalfRow = 2.2f;  ///< one degree in image rows; VLP-16 rows are 2 degrees apart
// Cells are looked up in finer images than voxels, for a tighter outline. The image of a cell must
// not be finer than those of its voxels, so that its pixels contain theirs.
constexpr float kVoxelHalf = 1.25f, kCellHalf = 1.875f;
constexpr std::uint64_t kAll = ~std::uint64_t{0};

/// A map that casts no rays, after D-Map (Cai et al. 2023, arXiv 2307.08493), in a box that moves
/// with the vehicle.
///
/// From the paper: a scan becomes a depth image, into which a cell of space is projected: cells
/// nearer than its depths are free, farther ones remain unknown. A tree of unknown space is
/// descended only where it contains unknown cells, and not into cells behind all depths of their
/// part of the image, or without rays.
///
/// Not from the paper: the box; three levels of 64 children, in bit masks, instead of an octree.
/// Free space is decided voxel by voxel, because the rows of a VLP-16 are 2 degrees apart: a voxel
/// is seen if a row passes within a degree of it. If all depths around an occupied voxel, which is
/// final in the paper, lie beyond it, its log odds fall as in OctoMap, so that movers disappear.
class DepthImageModel : public WorldModel {
 public:
    DepthImageModel(float edge_m, const FlightPace& pace)
        : max_range_m_(windowSizeFor(pace).radius_m),
          box_(edge_m, rollingReachFor(pace)),
          unknown_(box_),
          occupied_(box_),
          log_odds_(box_.voxels(), 0),
          hit_(box_.blocks(), 0) {
        for (std::size_t block = 0; block < box_.blocks(); ++block) unknown_.setBlock(block, kAll);
    }

    void update(const observations::MappedScan& scan) override {
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
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override {
        return occupied_.distance_m(box_, point_m, std::min(limit_m, kReach_m));
    }
    bool isKnown(const Eigen::Vector3f& point_m) const override {
        const Eigen::Array3f at = box_.inVoxels(point_m);
        return box_.holds(at) && !unknown_.has(box_.indexOf(at.cast<int>()));
    }
    std::size_t bytes() const override {
        return sizeof(*this) + box_.bytes() + image_.bytes() + unknown_.bytes() +
               occupied_.bytes() + log_odds_.capacity() + hit_.capacity() * sizeof(std::uint64_t) +
               hits_.capacity() * sizeof(std::uint32_t);
    }
    Obstacles obstacles() const override { return {occupied_.centres_m(box_), box_.edge_m()}; }

 private:
    void addHits(const observations::MappedScan& scan) {
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
    void clearSeenThrough(const Eigen::Vector3f& origin_m) {
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
    void removeKnown(const Eigen::Vector3f& origin_m) {
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
    /// A cell as seen by the sensor: distances of its nearest voxel from the sensor and from the
    /// vertical axis through it, and half that voxel's extent in the image.
    struct Outline {
        Eigen::Vector3f to_middle_m;
        float spread_m;  ///< distance from the cell's centre to the farthest voxel's centre
        float min_away_m, min_around_m, half_columns, half_rows;
    };
    /// The middle of a cell's first voxel as seen from the sensor.
    Eigen::Vector3f cornerOf(const Eigen::Array3i& first, const Eigen::Vector3f& origin_m) const {
        return box_.centre_m(first) - origin_m;
    }
    /// The outline of a cell with an edge of `voxels`, given by the middle of its first voxel.
    Outline outlineOf(const Eigen::Vector3f& to_corner_m, int voxels) const {
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
    std::uint64_t nearerVoxels(const Eigen::Vector3f& to_corner_m, std::uint64_t voxels,
                               float min_half_rows) const {
        const Outline outline = outlineOf(to_corner_m, RollingBox::kBlock);
        if (outline.min_away_m > max_range_m_) return 0;
        const DepthImage::Block block =
            DepthImage::block(to_corner_m, box_.edge_m(), outline.half_columns,
                              std::max(outline.half_rows, min_half_rows), kVoxelHalf);
        const float to_back_m = std::sqrt(0.75f) * box_.edge_m();
        std::uint64_t nearer = 0;
        forEachBit(voxels, [&](unsigned bit) {
            const bool is_nearer =
                block.away_m[bit] <= max_range_m_ &&
                block.away_m[bit] + to_back_m < image_.depths(block, bit).nearest_m;
            nearer |= std::uint64_t{is_nearer} << bit;
        });
        return nearer;
    }
    /// Whether nearerVoxels() with kHalfRow may find voxels in a cell; false only if it finds none.
    bool mayHaveFree(const Eigen::Vector3f& to_corner_m, int voxels) const {
        const Outline outline = outlineOf(to_corner_m, voxels);
        if (outline.min_away_m > max_range_m_) return false;
        // The centres of voxels are within the spread of the cell's centre. The gradient of a
        // column is at most 1 / (distance from the vertical axis), that of a row 1 / (distance).
        const float spread = DepthImage::kPixelsPerUnit * outline.spread_m;
        const DepthImage::Depths depths = image_.depthsAround(
            DepthImage::placeOf(outline.to_middle_m),
            outline.half_columns + spread / outline.min_around_m,
            std::max(outline.half_rows, kHalfRow) + spread / outline.min_away_m, kCellHalf);
        return outline.min_away_m < depths.farthest_m;
    }

    float max_range_m_;
    RollingBox box_;
    DepthImage image_;
    VoxelSet unknown_, occupied_;
    std::vector<std::int8_t> log_odds_;  ///< per voxel; valid if occupied
    std::vector<std::uint64_t> hit_;     ///< voxels hit in the scan, one mask per block
    std::vector<std::uint32_t> hits_;    ///< blocks hit in the scan
};

}  // namespace

std::unique_ptr<WorldModel> makeDepthImageModel(float edge_m, const FlightPace& pace) {
    return std::make_unique<DepthImageModel>(edge_m, pace);
}

}  // namespace hagen::avoidance
