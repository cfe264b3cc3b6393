// Leave-one-drive-out selection of settings: the logic, without scans.
#pragma once
#include <hagen/evaluation/DroneScores.h>
#include <hagen/evaluation/Scores.h>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace hagen::selection {

/// A setting and its candidate values, in settings-file syntax.
struct Setting {
    std::string key;
    std::vector<std::string> values;
};

/// The index of the value of each setting.
using Choice = std::vector<std::size_t>;

/// The filter's results for a set of scans.
struct Counts {
    evaluation::Scores scores;
    evaluation::Missed missed;  ///< missed obstacle returns above 0.5 m

    Counts& operator+=(const Counts& other);
};

enum class Group { Real, Simulated, Hard };
constexpr std::size_t kGroups = 3;
const char* nameOf(Group group);

/// Scans that are scored and held out together.
struct ScanSet {
    std::string vote;   ///< sets with the same vote are summed before F1
    std::string drive;  ///< held out with this drive; empty: never held out
    Group group = Group::Real;
    /// False if the scans are also in another set, so that missed returns are not counted twice.
    bool counts_missed = true;
};

/// Returns the counts of each set for a choice.
using Measure = std::function<std::vector<Counts>(const Choice&)>;

/// Caches another measure by choice, so that folds share results.
class CachedMeasure {
 public:
    explicit CachedMeasure(Measure measure) : measure_(std::move(measure)) {}
    const std::vector<Counts>& operator()(const Choice& choice);
    std::size_t measured() const { return cache_.size(); }  ///< number of measured choices

 private:
    Measure measure_;
    std::map<Choice, std::vector<Counts>> cache_;
};

/// The drives of these sets, sorted and unique.
std::vector<std::string> drivesOf(const std::vector<ScanSet>& sets);

/// The objective to maximise: the mean over the votes of (F1 of RoI + F1 of ROU) / 2, without the
/// sets of the drive `left_out`, if any. Skips votes with undefined F1; NaN without votes.
double objectiveOf(const std::vector<ScanSet>& sets, const std::vector<Counts>& counts,
                   const std::string& left_out);

/// The constraint: missed obstacle returns above 0.5 m per group, without the sets of `left_out`.
using MissedByGroup = std::array<std::int64_t, kGroups>;
MissedByGroup missedOf(const std::vector<ScanSet>& sets, const std::vector<Counts>& counts,
                       const std::string& left_out);

/// Minimum improvement of the objective for changing a value.
constexpr double kMinGain = 1e-4;

/// The result of a descent.
struct Descended {
    Choice choice;
    double start = 0, objective = 0;  ///< objective before and after
    MissedByGroup missed_start{}, missed{};
    int rounds = 0;  ///< including the last round, which changed nothing
};

/// Coordinate descent from `start` over all sets except those of `left_out`: tries all values of
/// each setting in turn and keeps the best. A choice that misses more than `limit` in a group is
/// worse than any choice within the limits; of two such choices, the one with the smaller excess
/// (summed over groups) is better. Otherwise the objective decides. Ends after a round without
/// change, or after `max_rounds`.
Descended descend(const std::vector<Setting>& settings, const Choice& start,
                  const MissedByGroup& limit, const std::vector<ScanSet>& sets,
                  CachedMeasure& measure, const std::string& left_out, int max_rounds);

/// A mean over drives with its 95 % confidence interval (Student's t); no interval for fewer than 2
/// or more than 31 values.
struct MeanInterval {
    double mean, low, high;
};
MeanInterval meanOverDrives(const std::vector<double>& values);

}  // namespace hagen::selection
