#include <hagen/mrpt/ScanMap.h>
#include <octomap/OcTreeKey.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <sstream>
#include <string>

namespace hagen::observations {
namespace {

/// A set of OctoMap keys within a box, one bit per key. Much faster than OctoMap's key set for
/// nearby keys.
class KeyBitset {
 public:
    struct Corners {
        octomap::OcTreeKey min, max;  ///< inclusive
    };

    void reset(const Corners& box) {
        min_ = box.min;
        std::size_t bits = 1;
        for (unsigned i = 0; i < 3; ++i) {
            size_[i] = static_cast<std::size_t>(box.max[i] - box.min[i]) + 1;
            bits *= size_[i];
        }
        words_.assign(bits / 64 + 1, 0);
    }

    /// Inserts a key, which must lie in the box; returns true if it is new.
    bool add(const octomap::OcTreeKey& key) {
        const std::size_t i = indexOf(key);
        const std::uint64_t bit = std::uint64_t{1} << (i % 64);
        const bool is_new = (words_[i / 64] & bit) == 0;
        words_[i / 64] |= bit;
        return is_new;
    }
    bool has(const octomap::OcTreeKey& key) const {
        const std::size_t i = indexOf(key);
        return (words_[i / 64] >> (i % 64)) & 1;
    }

    std::size_t bytes() const { return words_.capacity() * sizeof(std::uint64_t); }

 private:
    std::size_t indexOf(const octomap::OcTreeKey& key) const {
        return (static_cast<std::size_t>(key[2] - min_[2]) * size_[1] +
                static_cast<std::size_t>(key[1] - min_[1])) *
                   size_[0] +
               static_cast<std::size_t>(key[0] - min_[0]);
    }

    octomap::OcTreeKey min_;
    std::size_t size_[3] = {0, 0, 0};
    std::vector<std::uint64_t> words_;
};

octomap::point3d pointOf(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

// Memory limits: for the voxels around the sensor, with one bit per voxel in three sets (512 MiB
// per set), and for the map (about 3 GiB, or half of the process's limit).
constexpr double kMaxVoxelsInReach = 4294967296.0;
constexpr std::size_t kMaxNodes = 50'000'000, kBytesPerNode = 64;

std::size_t mostNodes() {
    rlimit limit{};
    if (getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kMaxNodes;
    return std::min<std::size_t>(kMaxNodes, limit.rlim_cur / 2 / kBytesPerNode);
}

void checkReach(const ScanMapOptions& options) {
    const double voxels = std::pow(2 * options.max_range_m / options.resolution_m + 4, 3);
    if (voxels <= kMaxVoxelsInReach) return;
    const double side = std::cbrt(kMaxVoxelsInReach) - 5;
    throw std::invalid_argument(
        "an OctoMap with voxels of " + std::to_string(options.resolution_m) + " m has more than " +
        "4 billion voxels within its range of " + std::to_string(std::lround(options.max_range_m)) +
        " m; use voxels of at least " + std::to_string(2 * options.max_range_m / side) + " m");
}

/// State of a voxel after a scan. A hit overrides a ray that passes through.
struct ScanVoxels {
    std::vector<octomap::OcTreeKey> free, occupied;
};

void check(const char* what, double value) {
    if (value > 0 && std::isfinite(value)) return;
    throw std::invalid_argument(std::string("the ") + what + " of an OctoMap is " +
                                std::to_string(value) + " m; it must be positive");
}

void checkProbabilities(const ScanMapOptions& options) {
    const double min = options.min_probability, max = options.greatest_probability;
    const double hit = options.hit_probability, miss = options.miss_probability;
    if (0 < min && min < miss && miss < 0.5 && 0.5 < hit && hit < max && max < 1) return;
    throw std::invalid_argument(
        "the probabilities of an OctoMap must be in the order 0 < min < miss < 0.5 < hit < max "
        "< 1, but are " +
        std::to_string(min) + ", " + std::to_string(miss) + ", " + std::to_string(hit) + ", " +
        std::to_string(max));
}

}  // namespace

/// Traverses rays and marks each voxel once.
class ScanMap::RayTraversal {
 public:
    void start(const octomap::OcTree& tree, const Eigen::Vector3f& origin_m, double max_range_m) {
        tree_ = &tree;
        if (!origin_m.allFinite()) throw std::runtime_error("the pose is not finite");
        origin_m_ = origin_m;
        max_range_m_ = static_cast<float>(max_range_m);
        voxels_.free.clear();
        voxels_.occupied.clear();
        const auto reach = static_cast<float>(max_range_m + 2 * tree.getResolution());
        const Eigen::Vector3f corner = Eigen::Vector3f::Constant(reach);
        KeyBitset::Corners box;
        if (!tree.coordToKeyChecked(pointOf(origin_m - corner), box.min) ||
            !tree.coordToKeyChecked(pointOf(origin_m + corner), box.max)) {
            throw std::runtime_error("a scan at " + std::to_string(std::lround(origin_m.x())) +
                                     ", " + std::to_string(std::lround(origin_m.y())) + ", " +
                                     std::to_string(std::lround(origin_m.z())) +
                                     " m lies outside an OctoMap with voxels of " +
                                     std::to_string(tree.getResolution()) +
                                     " m; use poses closer to the origin");
        }
        passed_.reset(box);
        hit_.reset(box);
        ends_.reset(box);
    }

    void hit(const Eigen::Vector3f& point_m) {
        if (!((point_m - origin_m_).norm() <= max_range_m_)) return;  // true if not finite
        const octomap::OcTreeKey key = tree_->coordToKey(pointOf(point_m));
        if (hit_.add(key)) voxels_.occupied.push_back(key);
    }

    /// Marks the voxels before the point's voxel as free, up to the maximum range. Rays that end in
    /// the same voxel are merged into a ray to its centre.
    void pass(const Eigen::Vector3f& point_m) {
        const Eigen::Vector3f ray = point_m - origin_m_;
        const float range_m = ray.norm();
        if (!std::isfinite(range_m)) return;
        const Eigen::Vector3f end_m =
            range_m > max_range_m_ ? origin_m_ + ray * (max_range_m_ / range_m) : point_m;
        const octomap::OcTreeKey end = tree_->coordToKey(pointOf(end_m));
        if (!ends_.add(end)) return;
        if (!tree_->computeRayKeys(pointOf(origin_m_), tree_->keyToCoord(end), ray_)) return;
        for (const octomap::OcTreeKey& key : ray_) {
            if (passed_.add(key) && !hit_.has(key)) voxels_.free.push_back(key);
        }
    }

    const ScanVoxels& voxels() const { return voxels_; }
    std::size_t bytes() const {
        return sizeof(*this) + passed_.bytes() + hit_.bytes() + ends_.bytes() +
               (ray_.sizeMax() + voxels_.free.capacity() + voxels_.occupied.capacity()) *
                   sizeof(octomap::OcTreeKey);
    }

 private:
    const octomap::OcTree* tree_ = nullptr;
    Eigen::Vector3f origin_m_{0, 0, 0};
    float max_range_m_ = 0;
    KeyBitset passed_, hit_, ends_;
    octomap::KeyRay ray_;  // reused across scans because it is large
    ScanVoxels voxels_;
};

ScanMap::ScanMap(const ScanMapOptions& options) : options_(options) {
    check("resolution", options.resolution_m);
    check("maximum range", options.max_range_m);
    checkProbabilities(options);
    checkReach(options);
    if (options.insertion != RayInsertion::OneRayPerVoxel && options.content != MapContent::Full) {
        throw std::invalid_argument("OctoMap's own insertion requires all returns as hits");
    }
    max_nodes_ = mostNodes();
    tree_ = std::make_unique<octomap::OcTree>(options.resolution_m);
    tree_->setProbHit(options.hit_probability);
    tree_->setProbMiss(options.miss_probability);
    tree_->setClampingThresMin(options.min_probability);
    tree_->setClampingThresMax(options.greatest_probability);
    walk_ = std::make_unique<RayTraversal>();
}
ScanMap::~ScanMap() = default;
ScanMap::ScanMap(ScanMap&&) noexcept = default;
ScanMap& ScanMap::operator=(ScanMap&&) noexcept = default;

std::size_t ScanMap::bytes() const { return tree_->memoryUsage() + walk_->bytes(); }

void ScanMap::insert(const MappedScan& scan) {
    if (tree_->size() > max_nodes_) {
        std::ostringstream millions;
        millions << std::setprecision(3) << 1e-6 * static_cast<double>(max_nodes_);
        throw MapFull("the map has more than " + millions.str() +
                      " million nodes; use larger voxels" +
                      (max_nodes_ < kMaxNodes ? ", or a higher --memory-limit" : ""));
    }
    const MapContent content = options_.content;
    const auto is_hit = [&](std::size_t i) {
        return content == MapContent::Full || scan.labels[i] == Label::Roi;
    };
    if (options_.insertion != RayInsertion::OneRayPerVoxel) {
        octomap::Pointcloud cloud;
        cloud.reserve(scan.points_m.size());
        for (const Eigen::Vector3f& point_m : scan.points_m) cloud.push_back(pointOf(point_m));
        constexpr bool lazily = true;
        tree_->insertPointCloud(cloud, pointOf(scan.origin_m), options_.max_range_m, lazily,
                                options_.insertion == RayInsertion::OctoMapDiscrete);
        return;
    }
    RayTraversal& walk = *walk_;
    walk.start(*tree_, scan.origin_m, options_.max_range_m);
    for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
        if (is_hit(i)) walk.hit(scan.points_m[i]);
    }
    for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
        if (content == MapContent::RoiAndRays || is_hit(i)) walk.pass(scan.points_m[i]);
    }
    // Inner nodes are updated, and equal leaves merged, when the map is saved.
    const auto update = [&](const octomap::OcTreeKey& key, bool is_occupied) {
        constexpr bool lazily = true;
        if (!tree_->bbxSet() || tree_->inBBX(key)) tree_->updateNode(key, is_occupied, lazily);
    };
    for (const auto& key : walk.voxels().free) update(key, false);
    for (const auto& key : walk.voxels().occupied) update(key, true);
}

}  // namespace hagen::observations
