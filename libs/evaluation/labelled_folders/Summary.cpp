#include "evaluation/labelled_folders/Summary.h"

namespace hagen::evaluation {
namespace {

GroupTotals summed(const Group& group, const BootstrapOptions& options) {
    return {group.name, group.scans.size(), group.sum(), bootstrapIntervals(group.scans, options)};
}

std::vector<GroupTotals> summed(const std::vector<Group>& groups, const BootstrapOptions& options) {
    std::vector<GroupTotals> all;
    for (const Group& group : groups) all.push_back(summed(group, options));
    return all;
}

ScoreTotals summed(const std::vector<ScanScores>& scans, const Summary& summary) {
    const BootstrapOptions& options = summary.bootstrap;
    return {summed(overallScores(scans), options), summed(byRange(scans, summary.range), options),
            summed(byAltitude(scans), options), summed(byKind(scans), options),
            summed(byFolder(scans, summary.folder_names), options)};
}

}  // namespace

DroneTotals totalsOf(const std::vector<DroneScores>& scans, const RangeBands& bands) {
    DroneTotals totals;
    for (const DroneScores& scan : scans) totals.all += scan;
    for (std::size_t band = 0; band < totals.all.tall_by_range.size(); ++band) {
        const Missed& missed = totals.all.tall_by_range[band];
        if (missed.all > 0) totals.by_range.push_back({bands.nameOf(band), missed});
    }
    for (const auto& [name, missed] : totals.all.tall_by_kind)
        totals.by_kind.push_back({name, missed});
    return totals;
}

void addScores(const std::vector<MethodScores>& methods, const std::vector<SweepPoint>& rows,
               Summary& summary) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const MethodScores& method = methods[m];
        MethodTotals sum;
        sum.name = method.name;
        if (m < rows.size()) {  // the filter's rows come first
            sum.sweep_key = rows[m].sweep_key;
            sum.sweep_value = rows[m].sweep_value;
        }
        sum.latency = latencyOf(method.latency_ms);
        sum.returns = summed(method.returns, summary);
        if (!method.pixels.empty()) sum.pixels = summed(method.pixels, summary);
        sum.drone = totalsOf(method.drone, summary.range);
        summary.scans = method.returns.size();
        summary.methods.push_back(sum);
    }
}

void addHardSets(const std::vector<HardSet>& sets, Summary& summary) {
    BootstrapOptions without_intervals = summary.bootstrap;
    without_intervals.resamples = 0;
    for (const HardSet& set : sets) {
        HardSetTotals totals{set.name, {}};
        for (const MethodScores& method : set.methods) {
            MethodTotals& sum = totals.methods.emplace_back();
            sum.name = method.name;
            sum.returns.all = summed(overallScores(method.returns), without_intervals);
            sum.drone = totalsOf(method.drone, summary.range);
        }
        summary.hard_sets.push_back(totals);
    }
}

double changeInPoints(double degraded, double recorded) { return 100 * (degraded - recorded); }

}  // namespace hagen::evaluation
