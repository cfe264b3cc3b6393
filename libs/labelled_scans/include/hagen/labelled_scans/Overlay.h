// Pictures of what a camera sees of the labels.
#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/evaluation/Evaluation.h>
#include <filesystem>

namespace hagen::labelled_scans {

/// A folder of such pictures (*_overlay.png), or of folders of them.
extern const base::OutputKind kOverlays;

/// Draws the pixels of a labelled scan as they were scored: RoI and ROU found, RoI missed, ROU
/// taken for RoI, each in a colour; pixels that are not scored pale. The picture is
/// FOLDER/<source>_<scan>_overlay.png; of several methods FOLDER/<method>/...
/// Throws std::runtime_error as runGnuplot() does.
void drawOverlay(const std::filesystem::path& folder, const evaluation::ScanSource& source,
                 const evaluation::LabelledView& view,
                 const evaluation::EvaluationOptions& options);

}  // namespace hagen::labelled_scans
