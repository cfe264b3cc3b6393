#pragma once
#include <hagen/reports/Summary.h>

#include <cstdint>
#include <string>
#include <utility>

namespace hagen::reports {

/// A course is named by its scenario and its seed.
using CourseKey = std::pair<std::string, std::uint64_t>;

/// The course of the same layout that a total counts instead: thin wires hang where the wires of
/// the same seed do. The course itself if there is none.
inline CourseKey firstOfLayout(const CourseKey& course) {
    return course.first == kThinWires ? CourseKey{kWires, course.second} : course;
}

}  // namespace hagen::reports
