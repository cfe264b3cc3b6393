#pragma once
#include <string>
#include <vector>
#include "convert/pictures/StagePictures.h"

namespace hagen::convert {

/// The results of a scan's stages as gnuplot data blocks:
///
///     $title                               the view's title, also as the variable `title`
///     $depth $repaired $merged             images [m], one line per row, lowest first
///     $angle $smoothed                     images [deg]
///     $maxima                              column, row
///     $bars                                rank, birth [m], death [m]; the longest, oldest first
///     $before $after                       row, angle [deg], of the selected column
///     $elementary                          row, value; component by component
///     $labels                              image; 0 ROU, 1 + colour for RoI
///     $rou $unclassified $roi              x, y [m], colour of RoI; top view
///
/// NaN for missing values.
struct StageData {
    std::string blocks;
    int column = 0;                       ///< column whose components are shown
    int bars = 0;                         ///< number of maxima in $bars
    std::vector<double> component_share;  ///< fraction of variance, 0 to 1, one entry per component
                                          ///< of $elementary; empty without that block
    float half_width_m = 0.0f;            ///< half width of the top view
};

StageData stageDataOf(const StageView& view);

}  // namespace hagen::convert
