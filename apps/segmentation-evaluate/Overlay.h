// Pictures of what a camera sees of the labels.
#pragma once
#include <hagen/evaluation/Evaluation.h>
#include <filesystem>
#include <string>

namespace hagen {

/// Draws the pixels of a labelled scan as they were scored: RoI and ROU found, RoI missed, ROU
/// taken for RoI, each in a colour; pixels that are not scored pale. `picture` is a PNG to be.
/// Throws std::runtime_error as runGnuplot() does.
void drawOverlay(const std::filesystem::path& picture, const std::string& title,
                 const LabelledView& view, const PinholeCamera& camera, float max_range_m);

}  // namespace hagen
