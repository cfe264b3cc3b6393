#include "ScenarioSentences.h"

#include <hagen/reports/Answer.h>
#include <hagen/reports/Saturation.h>

#include <algorithm>
#include <map>
#include <utility>

#include "Phrases.h"

namespace hagen::reports {
namespace {

std::string withFigures(const Pairing& pairing) {
    return rivalOf(pairing) + " (" + figuresOf(pairing) + ")";
}

/// The rivals of one contender in one scenario, by answer. Where nothing can be said they are only
/// named: the table of comparisons has the figures.
std::string answersText(const std::string& subject, const std::vector<Pairing>& pairings) {
    std::map<Answer, std::vector<std::string>> rivals;
    std::vector<std::string> chance;  // undecided ones whose interval contains zero
    for (const Pairing& pairing : pairings) {
        const Answer answer = answerOf(pairing);
        if (answer == Answer::Saturated) {
            rivals[answer].push_back(rivalOf(pairing));
        } else if (answer == Answer::Undecided && !excludesZero(pairing)) {
            chance.push_back(rivalOf(pairing));
        } else {
            rivals[answer].push_back(withFigures(pairing));
        }
    }
    const std::string margin = marginText();
    const std::pair<Answer, std::string> statements[] = {
        {Answer::MoreOften, "succeeds more often than "},
        {Answer::LessByMargin, "succeeds less often, by more than " + margin + ", than "},
        {Answer::LessOften,
         "succeeds less often, whether by more than " + margin + " is undecided, than "},
        {Answer::LessWithinMargin, "succeeds less often, by less than " + margin + ", than "},
        {Answer::NotInferior, "is not inferior, with a margin of " + margin + ", to "}};
    std::string text;
    for (const auto& [answer, statement] : statements) {
        if (rivals[answer].empty()) continue;
        text += (text.empty() ? subject : " It") + " " + statement + listed(rivals[answer]) + ".";
    }
    if (text.empty()) {
        const bool is_open = !chance.empty() || !rivals[Answer::Undecided].empty();
        text = subject + (is_open ? ": no comparison is decided yet." : ": nothing to tell apart.");
    }
    const auto append = [&](const std::string& what, const std::vector<std::string>& of) {
        if (!of.empty()) text += " " + what + ": " + listed(of) + ".";
    };
    append("Undecided", rivals[Answer::Undecided]);
    append("Undecided, may be chance", chance);
    append("Saturated", rivals[Answer::Saturated]);
    return text;
}

/// The pairings of one first contender in one scenario under one condition: with other models, or
/// with itself under another guidance.
std::vector<Pairing> pairingsOf(const Summary& summary, const Saturation& of, bool with_itself) {
    std::vector<Pairing> chosen;
    for (const Pairing& one : summary.pairings) {
        const bool is_itself = one.second.model == one.first.model;
        if (one.scenario == of.scenario && one.condition == of.condition && one.first == of.first &&
            is_itself == with_itself) {
            chosen.push_back(one);
        }
    }
    return chosen;
}

std::string scenarioSentence(const Summary& summary, const Saturation& of) {
    return answersText(capital(placeOf(of.scenario)) + " at " + nameOf(of.condition) + ", " +
                           withGuidance(of.first),
                       pairingsOf(summary, of, false));
}

std::string guidanceSentence(const Pairing& pairing) {
    return answersText(capital(placeOf(pairing.scenario)) + " at " + nameOf(pairing.condition) +
                           ", " + withGuidance(pairing.first),
                       {pairing});
}

/// Saturations under one condition of one contender.
std::vector<Saturation> of(const std::vector<Saturation>& all, const trials::Condition& condition,
                           const trials::Contender& first) {
    std::vector<Saturation> chosen;
    std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [&](const Saturation& one) {
        return one.condition == condition && one.first == first;
    });
    return chosen;
}

std::vector<trials::Contender> firstsUnder(const std::vector<Saturation>& all,
                                           const trials::Condition& condition) {
    std::vector<trials::Contender> firsts;
    for (const Saturation& one : all) {
        if (one.condition == condition && (firsts.empty() || !(firsts.back() == one.first))) {
            firsts.push_back(one.first);
        }
    }
    return firsts;
}

/// Whether a scenario was flown at a speed other than that of the saturation.
bool isFlownAtOtherSpeeds(const std::vector<Saturation>& all, const Saturation& one) {
    return std::any_of(all.begin(), all.end(), [&](const Saturation& other) {
        trials::Condition condition = other.condition;
        condition.speed_m_s = one.condition.speed_m_s;
        return other.scenario == one.scenario && other.first == one.first &&
               condition == one.condition && other.condition.speed_m_s != one.condition.speed_m_s;
    });
}

/// Of one contender under one condition.
std::string saturationSentence(const std::vector<Saturation>& all,
                               const std::vector<Saturation>& here) {
    std::vector<std::string> names, faster, at_all_speeds, at_one_speed;
    for (const Saturation& one : here) {
        if (!one.is_saturated) continue;
        names.push_back(one.scenario);
        const std::optional<Saturation> other = unsaturated(all, one);
        if (other) {
            faster.push_back(one.scenario + " at " + nameOf(other->condition));
        } else {
            (isFlownAtOtherSpeeds(all, one) ? at_all_speeds : at_one_speed).push_back(one.scenario);
        }
    }
    const std::string count =
        here.size() == 1
            ? std::string("the only scenario is") + (names.empty() ? " not" : "")
            : (names.empty() ? "none" : std::to_string(names.size())) + " of " +
                  std::to_string(here.size()) + " scenarios" + (names.size() < 2 ? " is" : " are");
    std::string text = "At " + nameOf(here.front().condition) + ", for " +
                       withGuidance(here.front().first) + ", " + count + " saturated" +
                       (names.empty() ? "" : ": " + listed(names)) + ".";
    if (!faster.empty()) text += " Not saturated: " + listed(faster) + ".";
    if (!at_all_speeds.empty()) {
        text += " Saturated at every speed flown: " + listed(at_all_speeds) + ".";
    }
    if (!at_one_speed.empty()) text += " Flown at no other speed: " + listed(at_one_speed) + ".";
    return text;
}

}  // namespace

std::vector<std::string> scenarioSentences(const Summary& summary,
                                           const trials::Condition& reference) {
    const std::vector<Saturation> all = saturationsOf(summary);
    std::vector<std::string> sentences;
    for (const trials::Contender& first : firstsUnder(all, reference)) {
        const std::vector<Saturation> here = of(all, reference, first);
        std::vector<Saturation> elsewhere;
        for (const Saturation& one : here) {
            if (!one.is_saturated) {
                sentences.push_back(scenarioSentence(summary, one));
            } else if (const std::optional<Saturation> other = unsaturated(all, one)) {
                elsewhere.push_back(*other);
            }
        }
        sentences.push_back(saturationSentence(all, here));
        for (const Saturation& one : elsewhere) sentences.push_back(scenarioSentence(summary, one));
    }
    for (const Pairing& pairing : summary.pairings) {
        if (pairing.condition == reference && pairing.second.model == pairing.first.model) {
            sentences.push_back(guidanceSentence(pairing));
        }
    }
    return sentences;
}

std::vector<std::string> saturationSentences(const Summary& summary,
                                             const trials::Condition& condition) {
    const std::vector<Saturation> all = saturationsOf(summary);
    std::vector<std::string> sentences;
    for (const trials::Contender& first : firstsUnder(all, condition)) {
        sentences.push_back(saturationSentence(all, of(all, condition, first)));
    }
    return sentences;
}

}  // namespace hagen::reports
