#include "Summary.h"

namespace hagen {
namespace {

SummedGroup summed(const Group& group, const BootstrapOptions& options) {
    return {group.name, group.scans.size(), group.sum(), bootstrapIntervals(group.scans, options)};
}

std::vector<SummedGroup> summed(const std::vector<Group>& groups, const BootstrapOptions& options) {
    std::vector<SummedGroup> all;
    for (const Group& group : groups) all.push_back(summed(group, options));
    return all;
}

SummedScores summed(const std::vector<ScanScores>& scans, const Summary& summary) {
    const BootstrapOptions& options = summary.bootstrap;
    return {summed(wholeOf(scans), options), summed(byRange(scans, summary.range), options),
            summed(byAltitude(scans), options), summed(byKind(scans), options),
            summed(byFolder(scans, summary.folder_names), options)};
}

}  // namespace

void sumUp(const std::vector<MethodScores>& methods, const std::vector<SettingsRow>& rows,
           Summary& summary) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const MethodScores& method = methods[m];
        SummedMethod sum;
        sum.name = method.name;
        if (m < rows.size()) {  // the filter's rows come first
            sum.sweep_key = rows[m].sweep_key;
            sum.sweep_value = rows[m].sweep_value;
        }
        sum.latency = latencyOf(method.latency_ms);
        sum.returns = summed(method.returns, summary);
        if (!method.pixels.empty()) sum.pixels = summed(method.pixels, summary);
        summary.scans = method.returns.size();
        summary.methods.push_back(sum);
    }
}

}  // namespace hagen
