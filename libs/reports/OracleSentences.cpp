#include "OracleSentences.h"

#include <hagen/avoidance/WorldModel.h>
#include <hagen/reports/Answer.h>

#include <algorithm>

#include <hagen/reports/Figures.h>
#include "Phrases.h"

namespace hagen::reports {
namespace {

/// The true scene with motion against this one, if it flew the same courses; else null.
const Pairing* withMotion(const Summary& summary, const Cell& oracle) {
    for (const Pairing& one : summary.motion_to_oracle) {
        if (one.scenario == oracle.scenario && one.condition == oracle.condition &&
            one.second == oracle.contender && one.pairs() == oracle.runs) {
            return &one;
        }
    }
    return nullptr;
}

/// What the true scene does not reach is lost by the planner and the guidance, whatever the model;
/// some of it because they take the world to stand still.
std::string ceilingText(const Summary& summary, const Cell& oracle) {
    const std::string who = capital(placeOf(oracle.scenario)) + " at " + nameOf(oracle.condition) +
                            ", the " + withGuidance(oracle.contender) + " succeeds on ";
    if (oracle.successes == oracle.runs) {
        return who + "all " + counted(oracle.runs, "course") + ": planner and guidance lose none.";
    }
    const double share = static_cast<double>(oracle.successes) / oracle.runs;
    const std::string lost = who + percent(share) + " % of " + counted(oracle.runs, "course") +
                             ": the other " + percent(1 - share) +
                             " points are lost by planner and guidance";
    const Pairing* motion = withMotion(summary, oracle);
    if (motion == nullptr) return lost + ", which take the world to stand still.";
    const double then = static_cast<double>(motion->both + motion->only_first) / oracle.runs;
    return lost + ". Where it is known how obstacles move, they succeed on " + percent(then) +
           " % of the same courses: that is worth " + points(then - share) + " points, and " +
           percent(1 - then) + " points are lost all the same.";
}

std::string gapText(const Summary& summary, const Cell& oracle, const std::vector<Pairing>& gaps) {
    std::vector<std::string> below, above, undecided, chance, close, saturated, alike;
    for (const Pairing& gap : gaps) {
        const std::string text =
            avoidance::displayName(gap.first.model) + " (" + figuresOf(gap) + ")";
        switch (answerOf(gap)) {
            case Answer::MoreOften:
                above.push_back(text);
                break;
            case Answer::LessByMargin:
            case Answer::LessOften:
            case Answer::LessWithinMargin:
                below.push_back(text);
                break;
            case Answer::Saturated:
                (gap.discordant() == 0 ? alike : saturated).push_back(text);
                break;
            case Answer::NotInferior:
                close.push_back(text);
                break;
            default:
                (excludesZero(gap) ? undecided : chance).push_back(text);
        }
    }
    std::string text = ceilingText(summary, oracle);
    const auto append = [&](const std::string& what, const std::vector<std::string>& who) {
        if (!who.empty()) text += " " + what + ": " + listed(who) + ".";
    };
    append("The model loses more", below);
    append("Better than the true scene", above);
    append("Not inferior to the true scene, with a margin of " + marginText(), close);
    append("Undecided", undecided);
    append("Undecided, may be chance", chance);
    append("Saturated, both succeed on at least " + std::to_string(kCeilingPercent) + " %",
           saturated);
    append("No gap", alike);
    return text;
}

std::string guidanceText(const std::string& guidance) {
    return guidance == "astar" ? "with A*" : "with " + guidance + " guidance";
}

}  // namespace

std::vector<std::string> oracleSentences(const Summary& summary,
                                         const trials::Condition& condition) {
    std::vector<std::string> sentences;
    for (const trials::Contender& contender : contendersUnder(summary, condition)) {
        if (contender.model != kOracle) continue;
        std::vector<std::string> without_gap, at_ceiling;
        for (const std::string& scenario : summary.scenarios) {
            std::vector<Pairing> gaps;
            for (const Pairing& gap : summary.to_oracle) {
                if (gap.scenario == scenario && gap.condition == condition &&
                    gap.second == contender) {
                    gaps.push_back(gap);
                }
            }
            if (gaps.empty()) continue;
            if (std::all_of(gaps.begin(), gaps.end(), [](const Pairing& gap) {
                    return answerOf(gap) == Answer::Saturated;
                })) {
                const bool is_alike = std::all_of(gaps.begin(), gaps.end(), [](const Pairing& gap) {
                    return gap.discordant() == 0;
                });
                (is_alike ? without_gap : at_ceiling).push_back(scenario);
            } else {
                sentences.push_back(
                    gapText(summary, *find(summary, scenario, condition, contender), gaps));
            }
        }
        const std::string at =
            "At " + nameOf(condition) + " " + guidanceText(contender.guidance) + ", ";
        if (!without_gap.empty()) {
            sentences.push_back(at + "no model differs from the true scene on any course of " +
                                listed(without_gap) + ".");
        }
        if (!at_ceiling.empty()) {
            sentences.push_back(at + "all comparisons with the true scene are saturated in " +
                                listed(at_ceiling) + ": both succeed on at least " +
                                std::to_string(kCeilingPercent) + " %, or differ on no course.");
        }
    }
    return sentences;
}

std::vector<std::string> oracleSentencesAtOtherSpeeds(const Summary& summary,
                                                      const trials::Condition& reference) {
    std::vector<std::string> sentences;
    for (const trials::Condition& condition : summary.conditions) {
        trials::Condition at_reference = condition;
        at_reference.speed_m_s = reference.speed_m_s;
        if (!(at_reference == reference) || condition == reference) continue;
        for (std::string& sentence : oracleSentences(summary, condition)) {
            sentences.push_back(std::move(sentence));
        }
    }
    return sentences;
}

}  // namespace hagen::reports
