#include <hagen/reports/Answer.h>
#include <hagen/reports/Verdict.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <hagen/reports/Figures.h>
#include "OracleSentences.h"
#include "Phrases.h"
#include "ScenarioSentences.h"
#include "SensitivitySentences.h"

namespace hagen::reports {
namespace {

/// Whether all courses of thin wires are left out.
bool isWithoutThinWires(const Pairing& total) {
    return total.repeated > 0 &&
           std::find(total.of.begin(), total.of.end(), kThinWires) == total.of.end();
}

/// The scenarios of a total, if not all of the condition: "u-trap and gap".
std::string scopeOf(const Summary& summary, const Pairing& overall) {
    std::set<std::string> flown;
    for (const Cell& cell : summary.cells) {
        if (cell.condition == overall.condition && !cell.scenario.empty()) {
            flown.insert(cell.scenario);
        }
    }
    if (isWithoutThinWires(overall)) flown.erase(kThinWires);
    return overall.of.size() < flown.size() ? listed(overall.of) : "";
}

/// The pairings of the verdict over several scenarios; W-RoI against W-Full without wires. What
/// both flew in a single scenario is told there.
std::vector<Pairing> pooledPairings(const Summary& summary, const trials::Condition& condition) {
    std::vector<Pairing> pooled;
    for (const Pairing& pairing : summary.overall) {
        if (!(pairing.condition == condition)) continue;
        const std::vector<Pairing> apart = splitByWires(summary, pairing);
        Pairing one = apart.empty() ? pairing : apart.front();
        if (one.scenarios < 2) continue;
        if (one.scenario.empty()) one.scenario = scopeOf(summary, one);
        pooled.push_back(one);
    }
    return pooled;
}

/// The scenario that a total has most of. Empty if all scenarios have as many courses.
std::string largestText(const Pairing& pooled) {
    if (pooled.largest_pairs * pooled.scenarios == pooled.pairs()) return "";
    return " " + std::to_string(pooled.largest_pairs) + " of the " +
           std::to_string(pooled.pairs()) + " courses are of " + pooled.largest_scenario + ".";
}

/// Where some courses of thin wires are counted and others are not.
std::string repeatedText(const Pairing& pooled) {
    if (pooled.repeated == 0 || isWithoutThinWires(pooled)) return "";
    return " " + counted(pooled.repeated, "course") +
           " of thin wires with the layout of counted wires " +
           (pooled.repeated == 1 ? "is" : "are") + " left out.";
}

/// How much of a total is saturated.
std::string alikeText(const Pairing& pooled) {
    if (pooled.alike_scenarios == 0) {
        return "In each of the " + std::to_string(pooled.scenarios) +
               " scenarios there are courses on which the two differ.";
    }
    return std::to_string(pooled.alike_scenarios) + " of " + std::to_string(pooled.scenarios) +
           " scenarios " + (pooled.alike_scenarios == 1 ? "has" : "have") +
           " no course on which the two differ.";
}

std::string saturatedText(const Pairing& pairing) {
    return pairing.discordant() == 0 ? "Saturated: they differ on no course."
                                     : "Saturated: both succeed on at least " +
                                           std::to_string(kCeilingPercent) + " % of the courses.";
}

/// With counts by scenario, since scenarios are not equally hard.
std::string collisionSentence(const Summary& summary, const Cell& all) {
    std::vector<std::string> places;
    for (const std::string& scenario : summary.scenarios) {
        const Cell* cell = find(summary, scenario, all.condition, all.contender);
        if (cell == nullptr || cell->collisions == 0) continue;
        places.push_back(scenario + " " + std::to_string(cell->collisions) + " of " +
                         std::to_string(cell->runs));
    }
    return capital(withGuidance(all.contender)) + ": " +
           (places.empty() ? "no collision" : counted(all.collisions, "collision")) + " in " +
           counted(all.runs, "run") + (places.empty() ? "" : " (" + join(places, ", ") + ")") + ".";
}

/// The most runs of one contender in one scenario.
int mostRuns(const Summary& summary, const trials::Condition& condition) {
    int most = 0;
    for (const Cell& cell : summary.cells) {
        if (!cell.scenario.empty() && cell.condition == condition) most = std::max(most, cell.runs);
    }
    return most;
}

/// The RoI window against another model, not against itself with another guidance.
bool isOfRoiWindow(const Pairing& pairing) {
    return pairing.first.model == kMappingFree && pairing.second.model != kMappingFree;
}

}  // namespace

std::vector<Pairing> splitByWires(const Summary& summary, const Pairing& overall) {
    std::vector<Pairing> apart;
    for (const Pairing& one : summary.without_wires) {
        if (isSameContest(one, overall)) apart.push_back(one);
    }
    if (apart.empty()) return apart;
    for (const Pairing& one : summary.pairings) {
        if (isWires(one.scenario) && isSameContest(one, overall)) apart.push_back(one);
    }
    return apart;
}

std::vector<Pairing> lossesOf(const Summary& summary) {
    std::vector<Pairing> losses;
    for (const Pairing& pairing : summary.pairings) {
        if (isOfRoiWindow(pairing) && pairing.difference < 0) losses.push_back(pairing);
    }
    std::stable_sort(losses.begin(), losses.end(), [](const Pairing& a, const Pairing& b) {
        return a.difference < b.difference;
    });
    return losses;
}

std::string differenceText(const Pairing& pairing) {
    const Answer answer = answerOf(pairing);
    const double n = pairing.pairs();
    std::string text =
        "at " + nameOf(pairing.condition) + ", " + withGuidance(pairing.first) + " vs. " +
        rivalOf(pairing) + ": success " + percent((pairing.both + pairing.only_first) / n) +
        " % vs. " + percent((pairing.both + pairing.only_second) / n) + " % on the same " +
        counted(pairing.pairs(), "course") + ", " + points(pairing.difference) +
        " points (95 % interval " + pointsOf(pairing.interval) + "; " +
        (std::isnan(pairing.p_holm) ? "" : "Holm-corrected ") + testText(pairing) + ").";
    const std::string place = placeOf(pairing.scenario);
    if (!place.empty())
        text = place + " " + text;
    else if (pairing.scenarios > 1)
        text = (isWithoutThinWires(pairing) ? "over all scenarios but thin wires "
                                            : "over all scenarios ") +
               text;
    text = (answer == Answer::Undecided ? "Undecided: " : "") + capital(text);
    if (pairing.scenarios > 1) {
        text += largestText(pairing) + repeatedText(pairing) + " " + alikeText(pairing);
    }
    if (answer == Answer::Saturated) text += " " + saturatedText(pairing);
    if (answer == Answer::NotInferior) {
        text += std::string(" Not inferior") + (pairing.scenarios > 1 ? " in total" : "") +
                ": the interval excludes a loss of " + marginText() + ".";
    }
    const std::string disagreement = disagreementText(pairing);
    if (!disagreement.empty()) return text + " " + capital(disagreement) + ".";
    if (answer == Answer::Undecided) {
        text += " The interval contains zero, so the difference may be chance.";
    }
    return text;
}

std::string lossesSentence(const Summary& summary) {
    const std::vector<Pairing> losses = lossesOf(summary);
    int significant = 0, disputed = 0, chance = 0;
    for (const Pairing& loss : losses) {
        ++(!excludesZero(loss) ? chance : isSignificant(loss) ? significant : disputed);
    }
    const auto comparisons =
        std::count_if(summary.pairings.begin(), summary.pairings.end(), isOfRoiWindow);
    std::string text = "Of " + counted(static_cast<int>(comparisons), "comparison") +
                       " in single scenarios, the RoI window succeeds less often in " +
                       std::to_string(losses.size()) + ".";
    if (losses.empty()) return text;
    text += " Interval and corrected test exclude a difference of zero (p < 0.05) in " +
            std::to_string(significant) + " of them";
    if (disputed > 0) {
        text += ", in " + std::to_string(disputed) +
                " the interval does and the corrected test does not";
    }
    if (chance > 0) {
        text += "; " + std::to_string(chance) + " may be chance, the interval contains zero";
    }
    return text + ". Largest loss first.";
}

std::string leftOutSentence(const std::vector<Pairing>& pairings, const std::string& which) {
    int least = 0;
    while (trials::leastMcNemar(least) >= kLevel) ++least;
    const auto left_out =
        std::count_if(pairings.begin(), pairings.end(),
                      [](const Pairing& pairing) { return std::isnan(pairing.p_holm); });
    if (left_out == 0) return "No comparison " + which + " is left out of the correction.";
    return std::to_string(left_out) + " of " +
           counted(static_cast<int>(pairings.size()), "comparison") + " " + which +
           " could not be significant, because fewer than " + std::to_string(least) +
           " courses differ, and " + (left_out == 1 ? "is" : "are") +
           " left out of the correction.";
}

std::vector<std::string> verdictOf(const Summary& summary) {
    if (summary.conditions.empty()) return {"There are no runs."};
    const trials::Condition& reference = summary.conditions.front();
    std::vector<std::string> sentences = scenarioSentences(summary, reference);
    const auto append = [&](const std::vector<std::string>& more) {
        sentences.insert(sentences.end(), more.begin(), more.end());
    };
    if (!summary.pairings.empty()) {
        append(
            {"In brackets: success on the courses that both flew; the difference and its 95 % "
             "interval; McNemar's exact p with Holm's correction. What may be chance and what is "
             "saturated is named only; the tables of paired comparisons have the figures.",
             "Saturated: two contenders differ on no course, or both succeed on at least " +
                 std::to_string(kCeilingPercent) +
                 " %. Such a scenario does not say which is better.",
             leftOutSentence(summary.pairings, "in single scenarios") + " " +
                 leftOutSentence(summary.overall, "over all scenarios")});
    }
    append(sensitivitySentences(summary));
    append(oracleSentences(summary, reference));
    std::vector<Pairing> pooled = pooledPairings(summary, reference);
    std::stable_partition(pooled.begin(), pooled.end(), [](const Pairing& pairing) {
        return answerOf(pairing) != Answer::Undecided;
    });
    for (const Pairing& pairing : pooled) append({differenceText(pairing)});
    const auto hasUndecided = [](const std::vector<Pairing>& pairings) {
        return std::any_of(pairings.begin(), pairings.end(), [](const Pairing& pairing) {
            return answerOf(pairing) == Answer::Undecided;
        });
    };
    if (hasUndecided(summary.pairings) || hasUndecided(summary.to_oracle) || hasUndecided(pooled)) {
        append({"Undecided comparisons need more courses."});
    }
    for (const trials::Contender& contender : contendersUnder(summary, reference)) {
        append({collisionSentence(summary, *find(summary, "", reference, contender))});
    }
    const int runs = mostRuns(summary, reference);
    append({"This does not prove safety: after 0 collisions in " + counted(runs, "run") +
            " of a scenario, the true collision rate can still be up to " +
            percent(trials::wilsonInterval(0, runs).high) + " % (Wilson, 95 %)."});
    return sentences;
}

}  // namespace hagen::reports
