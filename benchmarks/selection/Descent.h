// Chooses settings by leaving one drive out: the logic, without scans.
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

/// A setting and the values that are tried, as texts of a settings file.
struct Setting {
    std::string key;
    std::vector<std::string> values;
};

/// The index of the value of each setting.
using Choice = std::vector<std::size_t>;

/// What the filter made of a set of scans.
struct Counts {
    evaluation::Scores scores;
    evaluation::Missed missed;  ///< obstacle returns above 0.5 m

    Counts& operator+=(const Counts& other);
};

enum class Group { Real, Simulated, Hard };
constexpr std::size_t kGroups = 3;
const char* nameOf(Group group);

/// Scans that are counted together and left out together.
struct ScanSet {
    std::string vote;   ///< sets of one vote are summed before F1
    std::string drive;  ///< that they are left out with; empty: never left out
    Group group = Group::Real;
    /// False: the same scans as in another set, whose missed returns must not count twice.
    bool counts_missed = true;
};

/// Returns the counts of each set with a choice.
using Measure = std::function<std::vector<Counts>(const Choice&)>;

/// Calls another measure once per choice, so that folds share what they have in common.
class CachedMeasure {
 public:
    explicit CachedMeasure(Measure measure) : measure_(std::move(measure)) {}
    const std::vector<Counts>& operator()(const Choice& choice);
    std::size_t measured() const { return cache_.size(); }  ///< number of choices

 private:
    Measure measure_;
    std::map<Choice, std::vector<Counts>> cache_;
};

/// The drives of these sets, sorted, each once.
std::vector<std::string> drivesOf(const std::vector<ScanSet>& sets);

/// What is maximised: the mean over the votes of (F1 of RoI + F1 of ROU) / 2, without the sets of
/// `left_out` (a drive; empty: with all). Votes without F1, because nothing belongs to a class, are
/// skipped; NaN without votes.
double objectiveOf(const std::vector<ScanSet>& sets, const std::vector<Counts>& counts,
                   const std::string& left_out);

/// The limit that must not get worse: missed obstacle returns above 0.5 m of each group, without
/// the sets of `left_out`.
using MissedByGroup = std::array<std::int64_t, kGroups>;
MissedByGroup missedOf(const std::vector<ScanSet>& sets, const std::vector<Counts>& counts,
                       const std::string& left_out);

/// Smaller improvements of the objective do not change a value.
constexpr double kMinGain = 1e-4;

/// A choice, and what led to it.
struct Descended {
    Choice choice;
    double start = 0, objective = 0;  ///< objective before and after
    MissedByGroup missed_start{}, missed{};
    int rounds = 0;  ///< including the last one, in which nothing changed
};

/// Coordinate descent from `start` over all sets but those of `left_out`: takes one setting after
/// the other, tries all of its values, and keeps the best one. A choice that misses more than
/// `limit` in a group is worse than any that does not; of two such, the one with the smaller excess
/// (summed over groups) is better. Otherwise the objective decides. Ends after a round without
/// change, or after `most_rounds`.
Descended descend(const std::vector<Setting>& settings, const Choice& start,
                  const MissedByGroup& limit, const std::vector<ScanSet>& sets,
                  CachedMeasure& measure, const std::string& left_out, int most_rounds);

/// A mean over drives with its 95 % confidence interval, by Student's t; no interval for fewer than
/// two values or more than 31.
struct MeanInterval {
    double mean, low, high;
};
MeanInterval meanOverDrives(const std::vector<double>& values);

}  // namespace hagen::selection
