#pragma once
#include <hagen/pictures/StagePictures.h>
#include <string>
#include <vector>

namespace hagen::pictures {

/// What a scan's stages made, as gnuplot's data blocks:
///
///     $title                               the view's title, also as the variable `title`
///     $depth $repaired $merged             images [m], a line a row from the lowest up
///     $angle $smoothed                     images [deg]
///     $maxima                              column, row
///     $bars                                rank, birth [m], death [m]; the longest, oldest first
///     $before $after                       row, angle [deg], of the column shown
///     $elementary                          row, value; one component after another
///     $labels                              image; 0 ROU, 1 + colour for RoI
///     $rou $unclassified $roi              x, y [m], colour of RoI; seen from above
///
/// NaN where there is nothing.
struct StageData {
    std::string blocks;
    int column = 0;                       ///< whose components are shown
    int bars = 0;                         ///< maxima in $bars
    std::vector<double> component_share;  ///< of variance, 0 to 1, one a component of $elementary;
                                          ///< empty: that block is missing
    float half_width_m = 0.0f;            ///< of the view from above
};

StageData stageDataOf(const StageView& view);

}  // namespace hagen::pictures
