#pragma once
#include <string>

#include "Summary.h"

namespace hagen::reports {

/// What a comparison says of its first contender's success.
enum class Answer {
    MoreOften,
    LessByMargin,      ///< less often, by more than kMargin
    LessOften,         ///< less often, but whether by more than kMargin is open
    LessWithinMargin,  ///< less often, by less than kMargin
    Saturated,         ///< too easy or too hard to tell the two apart
    NotInferior,       ///< a loss of kMargin is excluded
    Undecided
};

/// "More" and "less" only if the interval and McNemar's corrected test agree. A saturated pairing
/// is never called not inferior: that would credit the contender with the ease of the courses. As
/// it depends on the pairing alone, summaries of two sets of runs can be compared answer by answer.
Answer answerOf(const Pairing& pairing);

/// "more often", "less often, by more than the margin", ..., "saturated", "not inferior",
/// "undecided".
std::string nameOf(Answer answer);

/// Success [%] from which on a contender is at the ceiling of a scenario.
constexpr int kCeilingPercent = 99;

/// Whether the two differ on no course, or both are at the ceiling on the courses that both flew.
bool isSaturated(const Pairing& pairing);

/// Whether the interval excludes a difference of zero.
bool excludesZero(const Pairing& pairing);

/// Whether the corrected test excludes a difference of zero. Never if the pairing was left out of
/// the correction.
bool isSignificant(const Pairing& pairing);

/// Whether both compare the same two contenders under one condition, in any scenario.
bool isSameContest(const Pairing& a, const Pairing& b);

}  // namespace hagen::reports
