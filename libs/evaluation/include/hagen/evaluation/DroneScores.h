#pragma once
#include <hagen/evaluation/ScanScores.h>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// The number of missed items, and of all items.
struct Missed {
    std::int64_t missed = 0, all = 0;

    double share() const;  ///< NaN if there are no items
    Missed& operator+=(const Missed& other);
};

/// Scores that matter to a drone, for one scan or summed over several scans.
struct DroneScores {
    std::size_t scans = 0;
    /// Returns of obstacles more than kTall_m above the true ground (TrueHeights.h) that are not
    /// labelled RoI: in total, by range band, and by class name (if classes are known).
    Missed tall;
    std::vector<Missed> tall_by_range;
    std::map<std::string, Missed> tall_by_kind;
    /// Obstacles with at least kObstacleReturns returns in range, none of which is labelled RoI.
    /// Zero if the ground truth does not number obstacles.
    Missed obstacles;
    /// Ground returns labelled RoI that have no true obstacle within kBareGround_m horizontally.
    std::int64_t false_on_bare_ground = 0;

    double falseOnBareGroundPerScan() const;  ///< NaN without scans
    DroneScores& operator+=(const DroneScores& other);
};

constexpr float kTall_m = 0.5f, kBareGround_m = 2.0f;
constexpr std::size_t kObstacleReturns = 5;

/// The ground truth of one scan, shared by all methods. Keeps a reference to the scan.
class DroneTruth {
 public:
    DroneTruth(const GroundTruthScan& scan, const RangeBands& bands);
    ~DroneTruth();
    DroneTruth(const DroneTruth&) = delete;
    DroneTruth& operator=(const DroneTruth&) = delete;

    /// Scores the labels `found`, one per return; `kinds` names all classes of obstacles.
    DroneScores score(const std::vector<Label>& found, const LabelMap& kinds) const;

 private:
    struct Plan;
    bool isBareGround(std::size_t i) const;

    const GroundTruthScan& scan_;
    RangeBands bands_;
    std::vector<std::size_t> tall_;                    ///< indices of tall returns
    std::vector<std::vector<std::size_t>> obstacles_;  ///< returns of each obstacle
    std::unique_ptr<Plan> plan_;
};

}  // namespace hagen::evaluation
