// Charts of the scores.
#pragma once
#include <hagen/base/OutputPath.h>
#include <filesystem>

#include "evaluation/labelled_folders/Summary.h"

namespace hagen::evaluation {

/// A folder of these charts (by_*.svg, sweep_*.svg).
extern const base::OutputKind kCharts;

/// Draws SVG charts of scores over returns (docs/evaluation.md), with confidence intervals and up
/// to seven methods, into an existing folder. Charts without data are skipped. Throws
/// std::runtime_error like Drawing::draw().
void drawCharts(const std::filesystem::path& folder, const Summary& summary);

}  // namespace hagen::evaluation
