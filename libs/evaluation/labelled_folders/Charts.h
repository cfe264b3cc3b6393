// Charts of the scores.
#pragma once
#include <hagen/base/OutputPath.h>
#include <filesystem>

#include "evaluation/labelled_folders/Summary.h"

namespace hagen::evaluation {

/// A folder of these charts (by_*.svg, sweep_*.svg).
extern const base::OutputKind kCharts;

/// Draws SVG charts of scores over returns, with confidence intervals, into an existing folder:
///
///     by_range.svg, by_altitude.svg   F1 of RoI and ROU, one line per method (up to seven)
///     by_kind.svg                     recall of each object class
///     sweep_KEY.svg                   F1 of RoI and ROU over the values of a sweep
///
/// Charts without data are skipped. Throws std::runtime_error like Drawing::draw().
void drawCharts(const std::filesystem::path& folder, const Summary& summary);

}  // namespace hagen::evaluation
