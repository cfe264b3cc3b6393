#pragma once
#include <string>
#include <vector>

#include "Summary.h"

namespace hagen::reports {

/// How contenders of one guidance flew the very same courses: medians of different courses
/// would compare courses, not contenders.
struct SharedCourses {
    trials::Condition condition;
    std::string guidance;
    int flown = 0;    ///< courses that all of them flew
    int arrived = 0;  ///< of these, courses on which all arrived
    int reacted = 0;  ///< of these, courses on which all reacted to something
    /// A contender each, of the `arrived` courses alone; its first reaction of the `reacted` ones.
    /// None where there is no such course.
    std::vector<Cell> cells;
    /// Of all `flown` courses, whatever came out: least clearances by contender, in the order of
    /// `contenders`. [m]
    std::vector<std::vector<double>> min_clearances_m;
    std::vector<trials::Contender> contenders;
};

/// For each guidance that was flown under the condition: of the contenders that flew most courses;
/// then, where others flew fewer by a tenth or more, of these as well, and so on.
std::vector<SharedCourses> sharedCourses(const std::vector<trials::Run>& runs,
                                         const Summary& summary,
                                         const trials::Condition& condition);

}  // namespace hagen::reports
