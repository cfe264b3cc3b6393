// The scores as charts.
#pragma once
#include <hagen/base/OutputPath.h>
#include <filesystem>

#include "Summary.h"

namespace hagen::labelled_scans {

/// A folder of such charts (by_*.svg, sweep_*.svg).
extern const base::OutputKind kCharts;

/// Draws SVG charts into a folder that exists, of scores over returns with their intervals:
///
///     by_range.svg, by_altitude.svg   F1 of RoI and ROU, a line a method (of up to seven methods)
///     by_kind.svg                     recall of each kind of object
///     sweep_KEY.svg                   F1 of RoI and ROU over the values of a sweep
///
/// Charts of what is not known are left out. Throws std::runtime_error as runGnuplot() does.
void drawCharts(const std::filesystem::path& folder, const Summary& summary);

}  // namespace hagen::labelled_scans
