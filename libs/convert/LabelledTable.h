#pragma once
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/mrpt/PointTable.h>
#include <mrpt/obs/CObservation.h>

#include <string>
#include <vector>

namespace hagen::convert {

struct LabelledTable {
    observations::PointTable table;
    std::vector<std::string> renamed;  ///< new names of renamed input fields

    /// Messages for the user about renamed fields.
    std::vector<std::string> remarks() const;
};

/// The points of a segmented scan with their labels: all fields of the observation's cloud, or x,
/// y, z, intensity, `time` [s] if known, and, for sensor packets, `ring`, counted from the lowest
/// beam; then `label` (uint8: 0 unclassified, 1 ROU, 2 RoI) and `obstacle` (uint32: the RoI
/// component; 0 if none). Contains all points of the input, in order; points that are not returns
/// have the label 0. Input fields with the same names become `input_label` and `input_obstacle`,
/// or, if these exist, `input_label_` and `input_obstacle_`.
LabelledTable labelledTable(const observations::ObservationSegmenter::Output& segmented,
                            const mrpt::obs::CObservation& observation);

/// Replaces the two clouds of a result with clouds that have all fields of the labelled table, and
/// `color_r`, `color_g`, `color_b` (uint8) in the colours of the results; see genericCloudOf().
/// `time` becomes `t`, as in MRPT.
void useCloudsWithFields(const mrpt::obs::CObservation& observation,
                         observations::ObservationSegmenter::Output& segmented);

}  // namespace hagen::convert
