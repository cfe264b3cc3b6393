#include "Descent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace hagen::selection {
namespace {

bool isTraining(const ScanSet& set, const std::string& left_out) {
    return set.drive.empty() || set.drive != left_out;
}

std::int64_t excessOf(const MissedByGroup& missed, const MissedByGroup& limit) {
    std::int64_t excess = 0;
    for (std::size_t group = 0; group < kGroups; ++group)
        excess += std::max<std::int64_t>(0, missed[group] - limit[group]);
    return excess;
}

/// The score of a choice.
struct Seen {
    std::int64_t excess;
    double objective;

    bool isBetterThan(const Seen& other, double min_gain) const {
        if (excess != other.excess) return excess < other.excess;
        return objective > other.objective + min_gain;
    }
};

}  // namespace

const char* nameOf(Group group) {
    return group == Group::Real ? "real" : group == Group::Simulated ? "simulated" : "hard";
}

Counts& Counts::operator+=(const Counts& other) {
    scores += other.scores;
    missed += other.missed;
    return *this;
}

const std::vector<Counts>& CachedMeasure::operator()(const Choice& choice) {
    const auto found = cache_.find(choice);
    if (found != cache_.end()) return found->second;
    return cache_.emplace(choice, measure_(choice)).first->second;
}

std::vector<std::string> drivesOf(const std::vector<ScanSet>& sets) {
    std::set<std::string> drives;
    for (const ScanSet& set : sets) {
        if (!set.drive.empty()) drives.insert(set.drive);
    }
    return {drives.begin(), drives.end()};
}

double objectiveOf(const std::vector<ScanSet>& sets, const std::vector<Counts>& counts,
                   const std::string& left_out) {
    std::map<std::string, evaluation::Scores> votes;
    for (std::size_t s = 0; s < sets.size(); ++s) {
        if (isTraining(sets[s], left_out)) votes[sets[s].vote] += counts[s].scores;
    }
    double sum = 0;
    int count = 0;
    for (const auto& [name, scores] : votes) {
        const double f1 = (scores.roi.f1() + scores.rou.f1()) / 2;
        if (std::isnan(f1)) continue;
        sum += f1;
        ++count;
    }
    return sum / count;
}

MissedByGroup missedOf(const std::vector<ScanSet>& sets, const std::vector<Counts>& counts,
                       const std::string& left_out) {
    MissedByGroup missed{};
    for (std::size_t s = 0; s < sets.size(); ++s) {
        if (!sets[s].counts_missed || !isTraining(sets[s], left_out)) continue;
        missed[static_cast<std::size_t>(sets[s].group)] += counts[s].missed.missed;
    }
    return missed;
}

Descended descend(const std::vector<Setting>& settings, const Choice& start,
                  const MissedByGroup& limit, const std::vector<ScanSet>& sets,
                  CachedMeasure& measure, const std::string& left_out, int max_rounds) {
    const auto see = [&](const Choice& choice) {
        const std::vector<Counts>& counts = measure(choice);
        return Seen{excessOf(missedOf(sets, counts, left_out), limit),
                    objectiveOf(sets, counts, left_out)};
    };
    Descended d;
    d.choice = start;
    Seen best = see(start);
    d.start = best.objective;
    d.missed_start = missedOf(sets, measure(start), left_out);
    bool has_changed = true;
    while (has_changed && d.rounds < max_rounds) {
        has_changed = false;
        ++d.rounds;
        for (std::size_t s = 0; s < settings.size(); ++s) {
            const Choice before = d.choice;
            const Seen seen_before = best;
            for (std::size_t value = 0; value < settings[s].values.size(); ++value) {
                Choice tried = before;
                tried[s] = value;
                const Seen seen = see(tried);
                if (!seen.isBetterThan(seen_before, kMinGain) || !seen.isBetterThan(best, 0))
                    continue;
                d.choice = tried;
                best = seen;
            }
            has_changed = has_changed || d.choice != before;
        }
    }
    d.objective = best.objective;
    d.missed = missedOf(sets, measure(d.choice), left_out);
    return d;
}

MeanInterval meanOverDrives(const std::vector<double>& values) {
    // 97.5 % quantiles of Student's t for 1, 2, ... degrees of freedom.
    constexpr std::array<double, 30> kStudent{
        12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
        2.201,  2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086,
        2.080,  2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042};
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const auto n = static_cast<double>(values.size());
    double sum = 0, squares = 0;
    for (const double value : values) sum += value;
    const double mean = sum / n;
    for (const double value : values) squares += (value - mean) * (value - mean);
    if (values.size() < 2 || values.size() > kStudent.size() + 1) return {mean, kNone, kNone};
    const double half = kStudent[values.size() - 2] * std::sqrt(squares / (n - 1) / n);
    return {mean, mean - half, mean + half};
}

}  // namespace hagen::selection
