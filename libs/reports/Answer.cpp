#include <hagen/reports/Answer.h>

#include <algorithm>

namespace hagen::reports {

Answer answerOf(const Pairing& pairing) {
    if (isSignificant(pairing)) {
        if (pairing.interval.low > 0) return Answer::MoreOften;
        if (pairing.interval.high < -kMargin) return Answer::LessByMargin;
        if (pairing.interval.high < 0) {
            return pairing.interval.low > -kMargin ? Answer::LessWithinMargin : Answer::LessOften;
        }
    }
    if (isSaturated(pairing)) return Answer::Saturated;
    return pairing.verdict == Verdict::NotInferior ? Answer::NotInferior : Answer::Undecided;
}

std::string nameOf(Answer answer) {
    switch (answer) {
        case Answer::MoreOften:
            return "more often";
        case Answer::LessByMargin:
            return "less often, by more than the margin";
        case Answer::LessOften:
            return "less often";
        case Answer::LessWithinMargin:
            return "less often, by less than the margin";
        case Answer::Saturated:
            return "saturated";
        case Answer::NotInferior:
            return "not inferior";
        default:
            return "undecided";
    }
}

bool isSaturated(const Pairing& pairing) {
    const int rarer = pairing.both + std::min(pairing.only_first, pairing.only_second);
    return pairing.discordant() == 0 || 100 * rarer >= kCeilingPercent * pairing.pairs();
}

bool excludesZero(const Pairing& pairing) {
    return pairing.interval.low > 0 || pairing.interval.high < 0;
}

bool isSignificant(const Pairing& pairing) { return pairing.p_holm < kLevel; }

bool isSameContest(const Pairing& a, const Pairing& b) {
    return a.condition == b.condition && a.first == b.first && a.second == b.second;
}

}  // namespace hagen::reports
