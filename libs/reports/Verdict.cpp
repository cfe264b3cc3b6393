#include <hagen/reports/Verdict.h>

#include <algorithm>
#include <set>

#include <hagen/reports/Figures.h>
#include "Phrases.h"

namespace hagen::reports {
namespace {

std::string placeOf(const std::string& scenario) {
    if (scenario == kAllButWires) return "where no wires are";
    return scenario == kWires ? "among wires" : scenario.empty() ? "" : "in " + scenario;
}

enum Answer { MoreOften, LessByMargin, LessOften, LessWithinMargin, WithinMargin, Undecided };

/// "More" and "less" only where the interval and McNemar's test, corrected, both say so.
Answer answerOf(const Pairing& pairing) {
    if (pairing.p_holm < 0.05) {
        if (pairing.interval.low > 0) return MoreOften;
        if (pairing.interval.high < -kMargin) return LessByMargin;
        if (pairing.interval.high < 0) {
            return pairing.interval.low > -kMargin ? LessWithinMargin : LessOften;
        }
    }
    return pairing.verdict == Verdict::NotInferior ? WithinMargin : Undecided;
}

std::string differenceOf(const Pairing& pairing) {
    const double n = pairing.pairs();
    const bool same_guidance = pairing.first.guidance == pairing.second.guidance;
    std::string who = spoken(pairing.first) + " against " +
                      (same_guidance ? pairing.second.model : spoken(pairing.second));
    const std::string place = placeOf(pairing.scenario);
    return capital(place) + (place.empty() ? "" : ", ") + who + ": success " +
           percent((pairing.both + pairing.only_first) / n) + " % against " +
           percent((pairing.both + pairing.only_second) / n) + " % of the same " +
           counted(pairing.pairs(), "course") + ", " + points(pairing.difference) +
           " points (95 % interval " + pointsOf(pairing.interval) + "; p by Holm " +
           pText(pairing.p_holm) + ")";
}

std::string marginText() { return pages::figure(100 * kMargin, 0) + " points"; }

/// Whether both are of the same two contenders under one condition, wherever.
bool isSameContest(const Pairing& a, const Pairing& b) {
    return a.condition == b.condition && a.first == b.first && a.second == b.second;
}

/// Where both were flown, if not in all scenarios of the condition: "u-trap and gap".
std::string scopeOf(const Summary& summary, const Pairing& overall) {
    std::vector<std::string> names;
    for (const Pairing& one : summary.pairings) {
        if (isSameContest(one, overall)) names.push_back(one.scenario);
    }
    std::set<std::string> flown;
    for (const Cell& cell : summary.cells) {
        if (cell.condition == overall.condition && !cell.scenario.empty()) {
            flown.insert(cell.scenario);
        }
    }
    return names.size() < flown.size() ? listed(names) : "";
}

/// What the verdict tells of: all scenarios together, but W-RoI against W-Full with wires apart.
std::vector<Pairing> told(const Summary& summary, const trials::Condition& condition) {
    std::vector<Pairing> all;
    for (const Pairing& pairing : summary.overall) {
        if (!(pairing.condition == condition)) continue;
        const std::vector<Pairing> apart = wiresApart(summary, pairing);
        if (apart.empty()) {
            all.push_back(pairing);
            all.back().scenario = scopeOf(summary, pairing);
        } else {
            all.insert(all.end(), apart.begin(), apart.end());
        }
    }
    return all;
}

/// Losses in single scenarios, chance or not, of which a wider comparison alone is told.
std::vector<Pairing> hiddenBy(const std::vector<Pairing>& told, const Summary& summary) {
    std::vector<Pairing> hidden;
    for (const Pairing& loss : lossesOf(summary)) {
        if (loss.interval.high >= 0) continue;
        bool is_told = false, goes_under = false;
        for (const Pairing& one : told) {
            if (!isSameContest(one, loss)) continue;
            is_told = is_told || one.scenario == loss.scenario;
            // Who is told of such a loss in the whole needs not be told of its parts.
            goes_under =
                goes_under || (one.pairs() > loss.pairs() && answerOf(one) != LessByMargin);
        }
        if (goes_under && !is_told) hidden.push_back(loss);
    }
    return hidden;
}

/// Against whom, and where: "G-Full (in movers)".
std::string rivalOf(const Pairing& pairing) {
    const bool same_guidance = pairing.second.guidance == pairing.first.guidance;
    const std::string place = placeOf(pairing.scenario);
    return (same_guidance ? pairing.second.model : spoken(pairing.second)) +
           (place.empty() ? "" : " (" + place + ")");
}

/// The answer before the figures.
std::string headlineOf(const std::vector<Pairing>& pairings, const std::vector<Pairing>& hidden,
                       const trials::Condition& reference, const std::string& guidance) {
    std::vector<std::string> of[Undecided + 1], but;
    bool is_on_the_whole = false;
    for (const Pairing& pairing : pairings) {
        if (pairing.first.guidance != guidance || pairing.second.model == pairing.first.model ||
            pairing.second.model == "oracle") {
            continue;
        }
        of[answerOf(pairing)].push_back(rivalOf(pairing));
        is_on_the_whole = is_on_the_whole || pairing.scenario.empty();
    }
    for (const Pairing& loss : hidden) {
        if (loss.first.guidance == guidance && answerOf(loss) != Undecided) {
            but.push_back(rivalOf(loss));
        }
    }
    const std::string margin = marginText();
    const std::string before[] = {"arrives more often than ", "arrives less often than ",
                                  "arrives less often than ", "arrives less often than ",
                                  "loses less than " + margin + ", if any, to "};
    const std::string after[] = {"", ", by more than " + margin, ", by how much is open",
                                 ", by less than " + margin, ""};
    const std::string subject = spoken({"W-RoI", guidance}) + " at " + nameOf(reference);
    std::string text;
    for (int answer = MoreOften; answer < Undecided; ++answer) {
        if (of[answer].empty()) continue;
        text += (text.empty() ? subject + (is_on_the_whole ? ", on the whole," : "") : " It") +
                " " + before[answer] + listed(of[answer]) + after[answer] + ".";
    }
    if (text.empty() && !of[Undecided].empty()) text = subject + ": nothing is decided yet.";
    if (!but.empty()) text += " But it arrives less often than " + listed(but) + ".";
    if (!of[Undecided].empty()) text += " Open: " + join(of[Undecided], ", ") + ".";
    return text;
}

/// Where they were matters more than how many: scenarios are not equally hard.
std::string collisionWords(const Summary& summary, const Cell& all) {
    std::vector<std::string> places;
    for (const std::string& scenario : summary.scenarios) {
        const Cell* cell = find(summary, scenario, all.condition, all.contender);
        if (cell == nullptr || cell->collisions == 0) continue;
        places.push_back(scenario + " " + std::to_string(cell->collisions) + " of " +
                         std::to_string(cell->runs));
    }
    return capital(spoken(all.contender)) + ": " +
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

}  // namespace

std::vector<Pairing> wiresApart(const Summary& summary, const Pairing& overall) {
    std::vector<Pairing> apart;
    for (const Pairing& one : summary.without_wires) {
        if (isSameContest(one, overall)) apart.push_back(one);
    }
    if (apart.empty()) return apart;
    for (const Pairing& one : summary.pairings) {
        if (one.scenario == kWires && isSameContest(one, overall)) apart.push_back(one);
    }
    return apart;
}

std::vector<Pairing> lossesOf(const Summary& summary) {
    std::vector<Pairing> losses;
    for (const Pairing& pairing : summary.pairings) {
        if (pairing.difference < 0 && pairing.second.model != "oracle") losses.push_back(pairing);
    }
    std::stable_sort(losses.begin(), losses.end(), [](const Pairing& a, const Pairing& b) {
        return a.difference < b.difference;
    });
    return losses;
}

std::string differenceText(const Pairing& pairing) {
    switch (answerOf(pairing)) {
        case WithinMargin:
            return differenceOf(pairing) + ". Not inferior: a loss of " + marginText() +
                   " is excluded.";
        case Undecided:
            return "Open: " + differenceOf(pairing) +
                   (pairing.verdict == Verdict::Inferior
                        ? ". With so many comparisons this may be chance."
                        : ".");
        default:
            return differenceOf(pairing) + ".";
    }
}

std::vector<std::string> verdictOf(const Summary& summary) {
    if (summary.conditions.empty()) return {"Nothing was flown: the table has no runs."};
    const trials::Condition& reference = summary.conditions.front();
    std::vector<Pairing> pairings = told(summary, reference);
    const std::vector<Pairing> hidden = hiddenBy(pairings, summary);
    std::vector<std::string> words;
    for (const char* guidance : {"astar", "straight"}) {
        const std::string headline = headlineOf(pairings, hidden, reference, guidance);
        if (!headline.empty()) words.push_back(headline);
    }
    std::stable_partition(pairings.begin(), pairings.end(),
                          [](const Pairing& pairing) { return answerOf(pairing) != Undecided; });
    pairings.insert(pairings.end(), hidden.begin(), hidden.end());
    for (const Pairing& pairing : pairings) words.push_back(differenceText(pairing));
    if (std::any_of(pairings.begin(), pairings.end(),
                    [](const Pairing& pairing) { return answerOf(pairing) == Undecided; })) {
        words.push_back("What is open needs more courses to be decided.");
    }
    for (const trials::Contender& contender : contendersUnder(summary, reference)) {
        words.push_back(collisionWords(summary, *find(summary, "", reference, contender)));
    }
    const int runs = mostRuns(summary, reference);
    words.push_back("This is no proof of safety: 0 collisions in " + counted(runs, "run") +
                    " of a scenario" + (runs == 1 ? " still allows" : " still allow") +
                    " a true share of " + percent(trials::wilsonInterval(0, runs).high) +
                    " % (Wilson, 95 %).");
    return words;
}

}  // namespace hagen::reports
