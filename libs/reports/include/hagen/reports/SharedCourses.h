#pragma once
#include <string>
#include <vector>

#include "Summary.h"

namespace hagen::reports {

/// Flights of contenders with one guidance on the same courses. Medians over different courses
/// would compare courses, not contenders. Thin wires are left out where all flew the wires of the
/// same layout, too.
struct SharedCourses {
    trials::Condition condition;
    std::string guidance;
    int flown = 0;    ///< courses that all contenders flew
    int arrived = 0;  ///< of these, courses on which all reached the goal
    int reacted = 0;  ///< of these, courses on which all reacted to an obstacle
    /// One per contender, over the `arrived` courses; first reactions over the `reacted` ones.
    /// Empty if there is no such course.
    std::vector<Cell> cells;
    std::vector<Cell> flown_cells;  ///< the same over all `flown` courses; empty if there are none
    /// Minimum clearances [m] of all `flown` courses, whatever the outcome; one list per contender,
    /// in the order of `contenders`.
    std::vector<std::vector<double>> min_clearances_m;
    std::vector<trials::Contender> contenders;
};

/// For each guidance under a condition: first of the contenders that flew the most courses, then
/// including those that flew at least a tenth fewer, and so on.
std::vector<SharedCourses> sharedCourses(const std::vector<trials::Run>& runs,
                                         const Summary& summary,
                                         const trials::Condition& condition);

}  // namespace hagen::reports
