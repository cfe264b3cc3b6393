// The results in README.md.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "Measurement.h"
#include "selection/Record.h"

namespace hagen {

/// Returns the table of README.md: all methods on real scans with 16 beams and on simulated
/// flights, and the scores on drives that were left out.
std::string readmeBlock(const std::vector<Measured>& all,
                        const std::optional<selection::Record>& record);

/// Replaces what is between the lines "<!-- results: ... -->" and "<!-- end of results -->". Throws
/// std::runtime_error if there is not one of each, in this order.
std::string withBlock(const std::string& text, const std::string& block);

}  // namespace hagen
