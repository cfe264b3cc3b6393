// Labels drawn into the view of a camera.
#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/evaluation/Evaluation.h>
#include <filesystem>

namespace hagen::evaluation {

/// A folder of overlay pictures (*_overlay.png), with or without subfolders.
extern const base::OutputKind kOverlays;

/// Draws the pixels of a labelled scan, with a colour for each outcome: correct RoI, correct ROU,
/// missed RoI and false RoI; pixels that are not scored are pale. The picture is
/// FOLDER/SOURCE_SCAN_overlay.png; with several methods, FOLDER/METHOD/... Throws
/// std::runtime_error like Drawing::draw().
void drawOverlay(const std::filesystem::path& folder, const std::string& source,
                 const MethodOutput& view, const EvaluationOptions& options);

}  // namespace hagen::evaluation
