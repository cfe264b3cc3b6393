#include <hagen/avoidance/WorldModel.h>
#include <hagen/reports/Verdict.h>

#include <algorithm>
#include <set>

#include <hagen/reports/Figures.h>
#include "Phrases.h"

namespace hagen::reports {
namespace {

std::string placeOf(const std::string& scenario) {
    if (scenario == kAllButWires) return "without wires";
    return scenario == kWires ? "on wires" : scenario.empty() ? "" : "in " + scenario;
}

enum Answer { MoreOften, LessByMargin, LessOften, LessWithinMargin, WithinMargin, Undecided };

/// "More" and "less" only if the interval and McNemar's corrected test agree.
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
    std::string who = withGuidance(pairing.first) + " vs. " +
                      (same_guidance ? avoidance::displayName(pairing.second.model)
                                     : withGuidance(pairing.second));
    const std::string place = placeOf(pairing.scenario);
    return capital(place) + (place.empty() ? "" : ", ") + who + ": success " +
           percent((pairing.both + pairing.only_first) / n) + " % vs. " +
           percent((pairing.both + pairing.only_second) / n) + " % on the same " +
           counted(pairing.pairs(), "course") + ", " + points(pairing.difference) +
           " points (95 % interval " + pointsOf(pairing.interval) + "; Holm-corrected p " +
           pText(pairing.p_holm) + ")";
}

std::string marginText() { return pages::figure(100 * kMargin, 0) + " points"; }

/// Whether both compare the same two contenders under one condition, in any scenario.
bool isSameContest(const Pairing& a, const Pairing& b) {
    return a.condition == b.condition && a.first == b.first && a.second == b.second;
}

/// The scenarios that both flew, if not all of the condition: "u-trap and gap".
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

/// The pairings of the verdict: all scenarios together, but W-RoI against W-Full split by wires.
std::vector<Pairing> reportedPairings(const Summary& summary, const trials::Condition& condition) {
    std::vector<Pairing> all;
    for (const Pairing& pairing : summary.overall) {
        if (!(pairing.condition == condition)) continue;
        const std::vector<Pairing> apart = splitByWires(summary, pairing);
        if (apart.empty()) {
            all.push_back(pairing);
            all.back().scenario = scopeOf(summary, pairing);
        } else {
            all.insert(all.end(), apart.begin(), apart.end());
        }
    }
    return all;
}

/// Losses in single scenarios that the reported pairings, of more scenarios, do not show.
std::vector<Pairing> hiddenBy(const std::vector<Pairing>& reported, const Summary& summary) {
    std::vector<Pairing> hidden;
    for (const Pairing& loss : lossesOf(summary)) {
        if (loss.interval.high >= 0) continue;
        bool is_reported = false, is_hidden = false;
        for (const Pairing& one : reported) {
            if (!isSameContest(one, loss)) continue;
            is_reported = is_reported || one.scenario == loss.scenario;
            // A reported loss of this size in the total need not be repeated for its parts.
            is_hidden = is_hidden || (one.pairs() > loss.pairs() && answerOf(one) != LessByMargin);
        }
        if (is_hidden && !is_reported) hidden.push_back(loss);
    }
    return hidden;
}

/// The second contender and where: "occupancy grid 0.2 m (in movers)".
std::string rivalOf(const Pairing& pairing) {
    const bool same_guidance = pairing.second.guidance == pairing.first.guidance;
    const std::string place = placeOf(pairing.scenario);
    return (same_guidance ? avoidance::displayName(pairing.second.model)
                          : withGuidance(pairing.second)) +
           (place.empty() ? "" : " (" + place + ")");
}

/// The answer, without figures.
std::string headlineOf(const std::vector<Pairing>& pairings, const std::vector<Pairing>& hidden,
                       const trials::Condition& reference, const std::string& guidance) {
    std::vector<std::string> of[Undecided + 1], but;
    bool covers_all = false;
    for (const Pairing& pairing : pairings) {
        if (pairing.first.guidance != guidance || pairing.second.model == pairing.first.model ||
            pairing.second.model == "oracle") {
            continue;
        }
        of[answerOf(pairing)].push_back(rivalOf(pairing));
        covers_all = covers_all || pairing.scenario.empty();
    }
    for (const Pairing& loss : hidden) {
        if (loss.first.guidance == guidance && answerOf(loss) != Undecided) {
            but.push_back(rivalOf(loss));
        }
    }
    const std::string margin = marginText();
    const std::string before[] = {"succeeds more often than ", "succeeds less often than ",
                                  "succeeds less often than ", "succeeds less often than ",
                                  "is not inferior, with a margin of " + margin + ", to "};
    const std::string after[] = {"", ", by more than " + margin,
                                 ", but whether by more than " + margin + " is undecided",
                                 ", by less than " + margin, ""};
    const std::string subject = withGuidance({"W-RoI", guidance}) + " at " + nameOf(reference);
    std::string text;
    for (int answer = MoreOften; answer < Undecided; ++answer) {
        if (of[answer].empty()) continue;
        text += (text.empty() ? subject + (covers_all ? ", over all scenarios," : "") : " It") +
                " " + before[answer] + listed(of[answer]) + after[answer] + ".";
    }
    if (text.empty() && !of[Undecided].empty()) text = subject + ": no comparison is decided yet.";
    if (!but.empty()) text += " But it succeeds less often than " + listed(but) + ".";
    if (!of[Undecided].empty()) text += " Undecided: " + join(of[Undecided], ", ") + ".";
    return text;
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

}  // namespace

std::vector<Pairing> splitByWires(const Summary& summary, const Pairing& overall) {
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
            return differenceOf(pairing) + ". Not inferior: the interval excludes a loss of " +
                   marginText() + ".";
        case Undecided:
            return "Undecided: " + differenceOf(pairing) +
                   (pairing.verdict == Verdict::Inferior
                        ? ". With this many comparisons, the difference may be chance."
                        : ".");
        default:
            return differenceOf(pairing) + ".";
    }
}

std::vector<std::string> verdictOf(const Summary& summary) {
    if (summary.conditions.empty()) return {"There are no runs."};
    const trials::Condition& reference = summary.conditions.front();
    std::vector<Pairing> pairings = reportedPairings(summary, reference);
    const std::vector<Pairing> hidden = hiddenBy(pairings, summary);
    std::vector<std::string> sentences;
    for (const char* guidance : {"astar", "straight"}) {
        const std::string headline = headlineOf(pairings, hidden, reference, guidance);
        if (!headline.empty()) sentences.push_back(headline);
    }
    std::stable_partition(pairings.begin(), pairings.end(),
                          [](const Pairing& pairing) { return answerOf(pairing) != Undecided; });
    pairings.insert(pairings.end(), hidden.begin(), hidden.end());
    for (const Pairing& pairing : pairings) sentences.push_back(differenceText(pairing));
    if (std::any_of(pairings.begin(), pairings.end(),
                    [](const Pairing& pairing) { return answerOf(pairing) == Undecided; })) {
        sentences.push_back("Undecided comparisons need more courses.");
    }
    for (const trials::Contender& contender : contendersUnder(summary, reference)) {
        sentences.push_back(collisionSentence(summary, *find(summary, "", reference, contender)));
    }
    const int runs = mostRuns(summary, reference);
    sentences.push_back("This does not prove safety: after 0 collisions in " +
                        counted(runs, "run") +
                        " of a scenario, the true collision rate can still be up to " +
                        percent(trials::wilsonInterval(0, runs).high) + " % (Wilson, 95 %).");
    return sentences;
}

}  // namespace hagen::reports
