// The results in README.md.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "Measurement.h"
#include "selection/Record.h"

namespace hagen {

/// Returns the table of README.md: all methods on real scans with 16 beams and on simulated
/// flights, and the scores on held-out drives.
std::string readmeBlock(const std::vector<Measured>& all,
                        const std::optional<selection::Record>& record);

/// Replaces the text between the lines "<!-- results: ... -->" and "<!-- end of results -->".
/// Throws std::runtime_error unless there is one of each, in this order.
std::string withBlock(const std::string& text, const std::string& block);

}  // namespace hagen
