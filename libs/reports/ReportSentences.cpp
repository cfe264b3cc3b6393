#include <hagen/avoidance/WorldModel.h>
#include <hagen/reports/ReportSentences.h>

#include <set>

#include "Phrases.h"

namespace hagen::reports {

std::string unfinishedSentence(const trials::FlownRuns& flown) {
    if (flown.missing == 0) return "";
    return "Unfinished: " + std::to_string(flown.planned - flown.missing) + " of " +
           counted(flown.planned, "planned run") +
           (flown.planned - flown.missing == 1 ? " is" : " are") +
           " done. All figures may still change; do not stop the campaign early because of them.";
}

std::vector<std::string> flightSentences(const Report& report) {
    const Summary& summary = report.summary;
    std::vector<std::string> names;
    for (const trials::Contender& contender : summary.contenders)
        names.push_back(nameOf(contender));
    std::vector<std::string> conditions;
    for (const trials::Condition& condition : summary.conditions)
        conditions.push_back(nameOf(condition));
    std::set<std::uint64_t> seeds;
    for (const trials::Run& run : report.flown.runs) seeds.insert(run.seed);
    std::vector<std::string> sentences{
        counted(summary.runs, "run") + " in " +
            counted(static_cast<int>(summary.scenarios.size()), "scenario") + ": " +
            join(summary.scenarios, ", ") + ".",
        "Contenders (world model, guidance): " + join(names, "; ") + ".",
        "Conditions: " + join(conditions, "; ") + ".",
        "Settings hash " + join(summary.settings, ", ") + ", program version " +
            join(summary.versions, ", ") + "."};
    if (!seeds.empty()) {
        sentences.push_back(
            "Seeds " + std::to_string(*seeds.begin()) + " to " + std::to_string(*seeds.rbegin()) +
            ". A seed makes the same course for every contender; not every contender may have "
            "flown all of them.");
    }
    if (report.profile) {
        sentences.push_back("Latencies are drawn from a profile measured on " +
                            report.profile->machine + " (" + report.profile->made_by + ", " +
                            report.profile->date + ").");
    }
    return sentences;
}

namespace {

/// "With A*: both contenders flew the same 10 courses".
std::string whoFlew(const SharedCourses& shared) {
    const std::string guidance =
        shared.guidance == "astar" ? "With A*: " : "With straight guidance: ";
    const std::size_t count = shared.contenders.size();
    const std::string who = count == 1   ? avoidance::displayName(shared.contenders.front().model)
                            : count == 2 ? "both contenders"
                                         : "all " + std::to_string(count) + " contenders";
    if (shared.flown == 0) return guidance + "no course was flown by " + who;
    return guidance + who + " flew " + (count == 1 ? "" : "the same ") +
           counted(shared.flown, "course");
}

}  // namespace

std::string flownTogetherSentence(const SharedCourses& shared) { return whoFlew(shared) + "."; }

std::string sharedCoursesSentence(const SharedCourses& shared) {
    const std::size_t count = shared.contenders.size();
    if (shared.flown == 0) return whoFlew(shared) + ".";
    const std::string text = whoFlew(shared) + "; ";
    const std::string all = count == 1 ? "it" : count == 2 ? "both" : "all";
    if (shared.arrived == 0) {
        return text + (count == 1 ? "it never reached the goal."
                                  : "on none did " + all + " reach the goal.");
    }
    return text + all + " reached the goal on " + std::to_string(shared.arrived) + " of them" +
           (shared.reacted == shared.arrived
                ? "."
                : " and reacted to an obstacle on " + std::to_string(shared.reacted) + ".");
}

}  // namespace hagen::reports
