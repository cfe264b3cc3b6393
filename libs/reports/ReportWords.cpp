#include <hagen/reports/ReportWords.h>

#include <set>

#include "Phrases.h"

namespace hagen::reports {

std::string unfinishedWords(const trials::FlownRuns& flown) {
    if (flown.missing == 0) return "";
    return "Unfinished: " + std::to_string(flown.planned - flown.missing) + " of " +
           counted(flown.planned, "run") +
           " planned so far are flown. All figures may still change: do not stop early because of "
           "them.";
}

std::vector<std::string> flownWords(const Report& report) {
    const Summary& summary = report.summary;
    std::vector<std::string> names;
    for (const trials::Contender& contender : summary.contenders)
        names.push_back(nameOf(contender));
    std::vector<std::string> conditions;
    for (const trials::Condition& condition : summary.conditions)
        conditions.push_back(nameOf(condition));
    std::set<std::uint64_t> seeds;
    for (const trials::Run& run : report.flown.runs) seeds.insert(run.seed);
    std::vector<std::string> words{
        counted(summary.runs, "run") + " through " +
            counted(static_cast<int>(summary.scenarios.size()), "scenario") + ": " +
            join(summary.scenarios, ", ") + ".",
        "Contenders: " + join(names, "; ") + ".", "Conditions: " + join(conditions, "; ") + ".",
        "Settings " + join(summary.settings, ", ") + ", program version " +
            join(summary.versions, ", ") + "."};
    if (!seeds.empty()) {
        words.push_back(
            "Seeds " + std::to_string(*seeds.begin()) + " to " + std::to_string(*seeds.rbegin()) +
            "; a seed makes the same course for every contender, though not all may have "
            "flown it.");
    }
    if (report.profile) {
        words.push_back("Latencies are drawn from a profile measured on " +
                        report.profile->machine + " (" + report.profile->made_by + ", " +
                        report.profile->date + ").");
    }
    return words;
}

std::string sharedWords(const SharedCourses& shared) {
    const std::string guidance = shared.guidance == "astar" ? "With A*" : "Flown straight";
    const std::size_t count = shared.contenders.size();
    const std::string who = count == 1   ? nameOf(shared.contenders.front())
                            : count == 2 ? "both contenders"
                                         : "all " + std::to_string(count) + " contenders";
    std::string text = guidance + ": " + counted(shared.flown, "course") +
                       (shared.flown == 1 ? " was" : " were") + " flown by " + who;
    if (shared.flown == 0) return text + ", so there is nothing to compare.";
    if (shared.arrived == 0)
        return text + (count == 1 ? "; it arrived on none." : "; on none of these all arrived.");
    return text + "; on " + std::to_string(shared.arrived) + " of these all arrived" +
           (shared.reacted == shared.arrived
                ? "."
                : ", on " + std::to_string(shared.reacted) + " all reacted to something.");
}

}  // namespace hagen::reports
