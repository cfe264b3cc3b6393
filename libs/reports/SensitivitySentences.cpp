#include "SensitivitySentences.h"

#include <hagen/reports/Answer.h>

#include "Phrases.h"

namespace hagen::reports {
namespace {

using trials::Condition;

/// Two values of one entry of a condition.
struct Doubt {
    const char *usual, *other;  ///< "with unbiased distances"
    bool (*is_usual)(const Condition&);
    Condition (*to_other)(Condition usual);
};

const std::vector<Doubt>& doubts() {
    static const std::vector<Doubt> all{
        {"with unbiased distances", "with distances as stored",
         [](const Condition& c) { return c.distance == trials::ModelDistance::Unbiased; },
         [](Condition c) {
             c.distance = trials::ModelDistance::AsStored;
             return c;
         }},
        {"in dusty air", "in clear air",
         [](const Condition& c) { return c.air == trials::Air::Dusty; },
         [](Condition c) {
             c.air = trials::Air::Clear;
             return c;
         }}};
    return all;
}

enum class Side { Better, NotInferior, Worse, WorseByMargin, Undecided };

Side sideOf(const Pairing& pairing) {
    switch (answerOf(pairing)) {
        case Answer::MoreOften:
            return Side::Better;
        case Answer::NotInferior:
            return Side::NotInferior;
        case Answer::LessWithinMargin:
        case Answer::LessOften:
            return Side::Worse;
        case Answer::LessByMargin:
            return Side::WorseByMargin;
        default:
            return Side::Undecided;
    }
}

/// Whether both answers cannot be true.
bool areOpposite(Side a, Side b) {
    const auto isOneWay = [](Side x, Side y) {
        return (x == Side::Better && (y == Side::Worse || y == Side::WorseByMargin)) ||
               (x == Side::NotInferior && y == Side::WorseByMargin);
    };
    return isOneWay(a, b) || isOneWay(b, a);
}

std::string wordsOf(Side side) {
    return side == Side::Better        ? "succeeds more often"
           : side == Side::NotInferior ? "is not inferior"
                                       : "succeeds less often";
}

const Pairing* findPairing(const Summary& summary, const Pairing& like,
                           const Condition& condition) {
    for (const Pairing& one : summary.pairings) {
        if (one.scenario == like.scenario && one.condition == condition &&
            one.first == like.first && one.second == like.second) {
            return &one;
        }
    }
    return nullptr;
}

std::string flipSentence(const Doubt& doubt, const Pairing& usual, const Pairing& other) {
    return "Open: " + placeOf(usual.scenario) + " at " + nameOf(usual.condition) + ", " +
           withGuidance(usual.first) + " vs. " + rivalOf(usual) + ". " + capital(doubt.usual) +
           " it " + wordsOf(sideOf(usual)) + " (" + figuresOf(usual) + "), " + doubt.other +
           " it " + wordsOf(sideOf(other)) + " (" + figuresOf(other) + ").";
}

void addSentences(const Summary& summary, const Doubt& doubt, std::vector<std::string>& sentences) {
    int both = 0, opposite = 0, alike = 0, only_usual = 0, only_other = 0, neither = 0;
    for (const Pairing& usual : summary.pairings) {
        if (!doubt.is_usual(usual.condition)) continue;
        const Pairing* other = findPairing(summary, usual, doubt.to_other(usual.condition));
        if (other == nullptr) continue;
        ++both;
        const Side a = sideOf(usual), b = sideOf(*other);
        if (areOpposite(a, b)) {
            ++opposite;
            sentences.push_back(flipSentence(doubt, usual, *other));
        } else {
            const bool is_a = a != Side::Undecided, is_b = b != Side::Undecided;
            ++(is_a && is_b ? alike : is_a ? only_usual : is_b ? only_other : neither);
        }
    }
    if (both == 0) return;
    std::string text = "Of " + counted(both, "comparison") + " flown " + doubt.usual + " and " +
                       doubt.other + ", " +
                       (opposite == 0 ? "none has the opposite answer"
                                      : std::to_string(opposite) +
                                            (opposite == 1 ? " has the opposite answer and is"
                                                           : " have opposite answers and are") +
                                            " open");
    const auto append = [&](int count, const std::string& what) {
        if (count > 0) text += ", " + std::to_string(count) + " " + what;
    };
    append(alike, "decided in both without a contradiction");
    append(only_usual, std::string("decided only ") + doubt.usual);
    append(only_other, std::string("decided only ") + doubt.other);
    append(neither, "decided neither way");
    sentences.push_back(text + ".");
}

}  // namespace

std::vector<std::string> sensitivitySentences(const Summary& summary) {
    std::vector<std::string> sentences;
    for (const Doubt& doubt : doubts()) addSentences(summary, doubt, sentences);
    return sentences;
}

}  // namespace hagen::reports
