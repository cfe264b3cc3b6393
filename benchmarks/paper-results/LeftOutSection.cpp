#include "LeftOutSection.h"

#include <tuple>

#include "Rows.h"
#include "Sums.h"
#include "selection/SelectionTables.h"

namespace hagen {
namespace {

auto countsOf(const evaluation::Scores& s) {
    return std::tuple(s.roi.hits, s.roi.misses, s.roi.false_alarms, s.rou.hits, s.rou.misses,
                      s.rou.false_alarms);
}

/// Whether the record's scores of `default` are those measured now.
bool isCurrent(const std::vector<Measured>& all, const selection::Record& record) {
    for (const Measured& measured : all) {
        if (!measured.set.flights.empty()) continue;
        const std::vector<evaluation::Scores> sums = folderSums(measured, kDefault);
        for (std::size_t f = 0; f < sums.size(); ++f) {
            const selection::DriveScores* then =
                record.find(measured.set.name, measured.folders[f]);
            if (then == nullptr || countsOf(then->present.scores) != countsOf(sums[f]))
                return false;
        }
    }
    return true;
}

std::string listed(const std::vector<std::string>& texts) {
    std::string list;
    for (const std::string& text : texts) list += (list.empty() ? "`" : ", `") + text + "`";
    return list;
}

}  // namespace

std::string leftOutSection(const std::vector<Measured>& all,
                           const std::optional<selection::Record>& record) {
    const std::string head = "## Scores on drives that were left out\n\n";
    if (!record) {
        return head +
               "There are none: `scripts/select-settings` was not run, so `docs/selection.json` is "
               "missing. **All figures of `default` on real scans are in-sample.**\n\n";
    }
    std::string text = head;
    if (!isCurrent(all, *record)) {
        text +=
            "**The filter, its presets or the real scans have changed since: the selection is "
            "that of " +
            record->revision + ". Run `scripts/select-settings` again.**\n\n";
    }
    text +=
        "Each drive of SemanticKITTI is scored with the settings that were chosen without it, at "
        "16 and at 64 beams: on the other drives, simulated flights and degraded copies of both "
        "(" +
        listed(record->hard_sets) +
        "). [evaluation.md](evaluation.md#choosing-settings) says how. The intervals are "
        "Student's t over the drives. The values were left out, not the ideas: the stages "
        "themselves were developed on these drives. Nor was the start: the search begins with the "
        "presets, which were tuned on all drives, and often stays there. A second search begins "
        "with a plain start of values that nobody tuned: the stricter test.\n\n" +
        selection::scoreTable(*record) +
        "What was chosen, bold where it differs from `default`; and on what was not left out, the "
        "objective and the missed obstacle returns above 0.5 m, before and after. No choice may "
        "miss more than the limit, which is what the presets miss.\n\n";
    for (const selection::Search& search : record->searches) {
        text += "From " + search.start + ":\n\n" + selection::choiceTable(*record, search) +
                selection::foldTable(search);
    }
    return text;
}

}  // namespace hagen
