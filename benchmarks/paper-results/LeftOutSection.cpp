#include "LeftOutSection.h"

#include <algorithm>
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

/// Whether the record's scores of `default` equal the measured scores.
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

/// The file of a table, such as "choices_from_a_plain_start.csv".
std::string fileOf(const std::string& table, const selection::Search& search) {
    std::string name = table + "_from_" + search.start + ".csv";
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

std::string linkTo(const std::string& words, const std::string& file) {
    return "[" + words + "](results/" + file + ")";
}

}  // namespace

std::string leftOutSection(const std::vector<Measured>& all,
                           const std::optional<selection::Record>& record) {
    const std::string head = "## Held-out drives\n\n";
    if (!record) {
        return head +
               "There is no `docs/selection.json`: `scripts/select-settings` was not run. **All "
               "figures of `default` on real scans are in-sample.**\n\n";
    }
    std::string text = head;
    if (!isCurrent(all, *record)) {
        text += "**The filter, its presets or the real scans have changed since the selection at " +
                record->revision + ". Run `scripts/select-settings` again.**\n\n";
    }
    text +=
        "Each SemanticKITTI drive is scored with settings chosen without it, on the other drives, "
        "simulated flights and degraded copies of both (" +
        listed(record->hard_sets) +
        "; [method](evaluation.md#choosing-settings)). The first search starts from the presets, "
        "which were tuned on all drives, and often ends there. The search from a plain start is "
        "the stricter test. The stages themselves were developed on these drives. Intervals are "
        "Student's t over the drives.\n\n" +
        selection::scoreTable(*record);
    for (const selection::Search& search : record->searches) {
        text += "From " + search.start + ": " + linkTo("chosen values", fileOf("choices", search)) +
                ", " + linkTo("objective and missed returns", fileOf("searches", search)) + ".\n\n";
    }
    return text;
}

CsvTables leftOutTables(const std::optional<selection::Record>& record) {
    CsvTables tables;
    if (!record) return tables;
    for (const selection::Search& search : record->searches) {
        tables[fileOf("choices", search)] = selection::choiceTable(*record, search).csv();
        tables[fileOf("searches", search)] = selection::foldTable(search).csv();
    }
    return tables;
}

}  // namespace hagen
