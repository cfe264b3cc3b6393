#include <hagen/evaluation/DroneScores.h>
#include <algorithm>
#include "evaluation/TrueHeights.h"

#include "evaluation/PlanTree.h"

namespace hagen::evaluation {
namespace {

/// The returns of each numbered obstacle that has enough of them.
std::vector<std::vector<std::size_t>> numberedObstacles(const GroundTruthScan& scan,
                                                        float max_range_m) {
    std::map<std::uint32_t, std::vector<std::size_t>> by_number;
    for (std::size_t i = 0; i < scan.objects.size(); ++i) {
        const bool is_counted = scan.objects[i] != 0 && scan.truth[i] == Label::Roi &&
                                scan.input.scan.range_m[i] <= max_range_m;
        if (is_counted) by_number[scan.objects[i]].push_back(i);
    }
    std::vector<std::vector<std::size_t>> obstacles;
    for (auto& [number, returns] : by_number) {
        if (returns.size() >= kObstacleReturns) obstacles.push_back(std::move(returns));
    }
    return obstacles;
}

std::vector<Eigen::Vector2f> plansOfObstacles(const GroundTruthScan& scan,
                                              const std::vector<Eigen::Vector3f>& points_m) {
    std::vector<Eigen::Vector2f> plans_m;
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        if (scan.truth[i] == Label::Roi && !std::isnan(points_m[i].x()))
            plans_m.push_back(points_m[i].head<2>());
    }
    return plans_m;
}

void checkTruth(const GroundTruthScan& scan) {
    const std::size_t returns = scan.input.scan.size();
    checkSizes(returns, scan.truth.size(), "ground-truth labels");
    if (!scan.kinds.empty()) checkSizes(returns, scan.kinds.size(), "kinds");
    if (!scan.objects.empty()) checkSizes(returns, scan.objects.size(), "objects");
    if (!scan.heights_m.empty()) checkSizes(returns, scan.heights_m.size(), "heights");
}

}  // namespace

struct DroneTruth::Plan {
    std::vector<Eigen::Vector3f> points_m;  ///< positions in the level frame
    PlanTree obstacles;

    Plan(const GroundTruthScan& scan, std::vector<Eigen::Vector3f> level_m)
        : points_m(std::move(level_m)), obstacles(plansOfObstacles(scan, points_m)) {}
};

double Missed::share() const { return static_cast<double>(missed) / static_cast<double>(all); }

Missed& Missed::operator+=(const Missed& other) {
    missed += other.missed;
    all += other.all;
    return *this;
}

double DroneScores::falseOnBareGroundPerScan() const {
    return static_cast<double>(false_on_bare_ground) / static_cast<double>(scans);
}

DroneScores& DroneScores::operator+=(const DroneScores& other) {
    scans += other.scans;
    tall += other.tall;
    tall_by_range.resize(std::max(tall_by_range.size(), other.tall_by_range.size()));
    for (std::size_t band = 0; band < other.tall_by_range.size(); ++band)
        tall_by_range[band] += other.tall_by_range[band];
    for (const auto& [name, missed] : other.tall_by_kind) tall_by_kind[name] += missed;
    obstacles += other.obstacles;
    false_on_bare_ground += other.false_on_bare_ground;
    return *this;
}

DroneTruth::DroneTruth(const GroundTruthScan& scan, const RangeBands& bands)
    : scan_(scan), bands_(bands) {
    checkTruth(scan);
    plan_ = std::make_unique<Plan>(scan, levelPoints(scan));
    const std::vector<float> heights_m =
        scan.heights_m.empty() ? heightsAboveTrueGround(scan, plan_->points_m, bands.max_range_m)
                               : scan.heights_m;
    for (std::size_t i = 0; i < heights_m.size(); ++i) {
        const bool is_counted = scan.truth[i] == Label::Roi &&
                                scan.input.scan.range_m[i] <= bands.max_range_m &&
                                heights_m[i] > kTall_m;  // false for NaN
        if (is_counted) tall_.push_back(i);
    }
    obstacles_ = numberedObstacles(scan, bands.max_range_m);
}

DroneTruth::~DroneTruth() = default;

bool DroneTruth::isBareGround(std::size_t i) const {
    return scan_.truth[i] == Label::Rou && scan_.input.scan.range_m[i] <= bands_.max_range_m &&
           !plan_->obstacles.isAnyWithin(plan_->points_m[i].head<2>(),
                                         kBareGround_m * kBareGround_m);
}

DroneScores DroneTruth::score(const std::vector<Label>& found, const LabelMap& kinds) const {
    checkSizes(scan_.truth.size(), found.size(), "found labels");
    DroneScores scores;
    scores.scans = 1;
    scores.tall_by_range.resize(bands_.count());
    for (const std::size_t i : tall_) {
        const Missed one{found[i] != Label::Roi, 1};
        scores.tall += one;
        scores.tall_by_range[bands_.bandOf(scan_.input.scan.range_m[i])] += one;
        if (!scan_.kinds.empty()) scores.tall_by_kind[kinds.at(scan_.kinds[i]).name] += one;
    }
    for (const std::vector<std::size_t>& obstacle : obstacles_) {
        const bool is_found = std::any_of(obstacle.begin(), obstacle.end(),
                                          [&](std::size_t i) { return found[i] == Label::Roi; });
        scores.obstacles += {!is_found, 1};
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] == Label::Roi && isBareGround(i)) ++scores.false_on_bare_ground;
    }
    return scores;
}

}  // namespace hagen::evaluation
